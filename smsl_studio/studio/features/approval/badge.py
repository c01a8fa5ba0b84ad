"""The badge of trust in the top row of the window."""

from __future__ import annotations

from PySide6.QtGui import QPaintEvent

from smsl_studio.front.approval_badge import UNINSPECTED, ApprovalWords
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.badge import Badge
from smsl_studio.studio.base.theme import Tokens


class ApprovalBadge(Badge):
    """Says in a few words whether the blueprint is approved. A click shows the reasons.

    A dashed border means that the blueprint is not approved, or that this is not known yet.
    """

    def __init__(self, tokens: Tokens) -> None:
        super().__init__(tokens)
        self.said = UNINSPECTED
        self.setToolTip("Whether people have inspected and signed this blueprint. Show the reasons")
        self.show_words(UNINSPECTED)

    def show_words(self, said: ApprovalWords) -> None:
        """Show the words for another state of the approval."""
        if said == self.said and self.text() == said.words:
            return
        self.said = said
        self.setText(said.words)
        self.setAccessibleName(plain_text(said.words))
        self.setAccessibleDescription(plain_text(" ".join(said.lines[1:])))
        self.setFixedSize(self.sizeHint())
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the icon, the words and the border: a full green one if approved, else a dashed
        one.
        """
        tokens, good = self._tokens, self.said.is_good
        ink, ground = (tokens.ok, tokens.oks) if good else (tokens.risk, tokens.risks)
        self.paint_box("shield", ink, ground, inset=0.5, dashed=not good)
