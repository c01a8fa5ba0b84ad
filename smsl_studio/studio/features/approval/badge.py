"""The badge of trust in the top row of the window, and the card with the reasons."""

from __future__ import annotations

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QPaintEvent
from PySide6.QtWidgets import QFrame, QVBoxLayout, QWidget

from smsl_studio.front.approval_badge import UNINSPECTED, ApprovalWords
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.badge import Badge
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.theme import Tokens

LOOKING = ApprovalWords("Looking at the record", ("Signatures are being verified.",))
WIDE = 420
"""The width of the card (pixels)."""


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
        self.setAccessibleDescription(plain_text(" ".join((*said.reasons, said.advice))))
        self.setFixedSize(self.sizeHint())
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the icon, the words and the border: a full green one if approved, else a dashed
        one.
        """
        tokens, good = self._tokens, self.said.is_good
        ink, ground = (tokens.ok, tokens.oks) if good else (tokens.risk, tokens.risks)
        self.paint_box("shield", ink, ground, inset=0.5, dashed=not good)


class ReasonCard(QFrame):
    """The reasons for what the badge says.

    The card closes if the person clicks elsewhere or presses Escape.
    """

    def __init__(self, parent: QWidget, said: ApprovalWords) -> None:
        super().__init__(parent, Qt.WindowType.Popup)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setProperty("role", "float")
        self.setFixedWidth(WIDE)
        self.setAccessibleName(plain_text(said.words))
        column = QVBoxLayout(self)
        column.setContentsMargins(14, 12, 14, 12)
        column.setSpacing(8)
        self.lines = (said.words, *said.reasons, *((said.advice,) if said.advice else ()))
        for number, text in enumerate(self.lines):
            line = label(text, "" if number == 0 else "second")
            line.setWordWrap(True)
            column.addWidget(line)

    def open_below(self, badge: QWidget) -> None:
        """Show the card below a badge, inside the window."""
        self.adjustSize()
        corner = badge.mapToGlobal(QPoint(badge.width() - self.width(), badge.height() + 6))
        self.move(corner)
        self.show()
