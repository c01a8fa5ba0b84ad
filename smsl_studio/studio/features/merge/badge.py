"""A badge in the top row that says how many conflicts of a merge are open."""

from __future__ import annotations

from PySide6.QtGui import QPaintEvent

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.badge import Badge
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted


class ConflictBadge(Badge):
    """Visible in every mode while conflicts are open. A click shows the page Merge."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__(tokens)
        self.setFixedHeight(22)
        self.setToolTip("A merge left conflicts open. Show the page Merge")
        self.setAccessibleName("Open conflicts")
        self.hide()

    def show_number(self, number: int) -> None:
        """Show the number of open conflicts; 0 hides the badge."""
        self.setText(f"{counted(number, 'conflict')} open")
        self.setAccessibleName(plain_text(self.text()))
        self.setFixedWidth(self.sizeHint().width())
        self.setVisible(number > 0)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint a dashed box with icon and words."""
        self.paint_box("error", self._tokens.bad, self._tokens.bads, inset=1, dashed=True)
