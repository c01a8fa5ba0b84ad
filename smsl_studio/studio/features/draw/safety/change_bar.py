"""The bar across the window for a file with unsaved work that another program has changed."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QPushButton

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Label, label
from smsl_studio.studio.base.icons import pixmap
from smsl_studio.studio.base.keys_back import KeysBack
from smsl_studio.studio.base.theme import Tokens


class ChangeBar(QFrame):
    """Names the file and asks which text to keep. There is no time limit.

    Its three signals tell which button was pressed: “Show difference”, “Take theirs”, “Keep mine”.
    """

    difference_wanted, theirs_wanted, mine_wanted = Signal(), Signal(), Signal()

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.setObjectName("change_bar")
        self._mark = Label()
        self.said = label("", "heading")
        self.difference = QPushButton("Show difference")
        self.theirs = QPushButton("Take theirs")
        self.mine = QPushButton("Keep mine")
        self.theirs.setToolTip("Show what the other program wrote; undo brings yours back")
        self.mine.setToolTip("Keep your text; saving overwrites theirs")
        layout = QHBoxLayout(self)
        layout.setContentsMargins(14, 5, 12, 5)
        layout.setSpacing(8)
        layout.addWidget(self._mark)
        layout.addWidget(self.said, 1)
        for button, wanted in (
            (self.difference, self.difference_wanted),
            (self.theirs, self.theirs_wanted),
            (self.mine, self.mine_wanted),
        ):
            button.setProperty("role", "row")
            button.clicked.connect(wanted)
            layout.addWidget(button)
        KeysBack(self)
        self.set_tokens(tokens)
        self.hide()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        ratio = self.devicePixelRatioF()
        self._mark.setPixmap(pixmap("warning", tokens.risk, tokens.risks, 16, ratio))

    def show_files(self, names: list[str]) -> None:
        """Ask about the first of these files; hide the bar if there are none."""
        self.setVisible(bool(names))
        if names:
            more = f" (and {len(names) - 1} more)" if len(names) > 1 else ""
            self.said.setText(f"{names[0]} was changed outside this window{more}.")
            self.setAccessibleName(plain_text(self.said.text()))
