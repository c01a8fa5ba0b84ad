"""The row of the mode bar in Review: who reads, and the way to the next line.

In a narrow window a button in front of it opens the contents.
"""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QPushButton, QWidget

from smsl_studio.studio.base.controls import Elided, row
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text


class ReviewBar(QWidget):
    """Name and role of the reader, and the buttons."""

    contents_wanted = Signal()

    previous_wanted = Signal()
    next_wanted = Signal()
    person_wanted = Signal()

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.contents = QPushButton("Contents")
        self.contents.setCheckable(True)
        self.contents.setToolTip(tip_text("Show the parts of the reading, and your progress"))
        self.contents.clicked.connect(self.contents_wanted)
        self.contents.hide()
        self.who = Elided()
        self.change = QPushButton("Change…")
        self.change.setToolTip(tip_text("Choose who reads here, with name and role"))
        self.previous, self.next = QPushButton("Previous line"), QPushButton("Next open line")
        self.previous.setToolTip(tip_text("Go one line back (Up)"))
        self.next.setToolTip(tip_text("Go to the next line without an answer (Right)"))
        self.next.setLayoutDirection(Qt.LayoutDirection.RightToLeft)
        self.previous.clicked.connect(self.previous_wanted)
        self.next.clicked.connect(self.next_wanted)
        self.change.clicked.connect(self.person_wanted)
        layout = row(self.contents, self.who, self.change, self.previous, self.next)
        layout.setStretch(1, 1)
        self.setLayout(layout)
        self.set_tokens(tokens)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.previous.setIcon(icon("chevron-left", tokens, 14, tokens.tx))
        self.next.setIcon(icon("chevron-right", tokens, 14, tokens.tx))

    def show_person(self, person: str, role: str) -> None:
        """Show who reads."""
        self.who.setText(f"Reviewing as {person}, {role}" if role else f"Reviewing as {person}")
