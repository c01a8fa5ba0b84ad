"""The head of a task card: who decides, which of how many tasks it is, and the time left."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QVBoxLayout, QWidget

from smsl_studio.front.views.card_view import CardView
from smsl_studio.studio.base.controls import Label, label
from smsl_studio.studio.base.icons import pixmap
from smsl_studio.studio.base.small_button import SmallButton
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.people.time_left import TimeLeft

HEIGHT, PAD = 38, 14


class CardHead(QWidget):
    """A line of words above a bar for the time left."""

    turned = Signal(int)
    """int: show the next task (1) or the one before (-1)."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._hand = Label()
        self.heading, self.left = label("", "strong"), label("", "strong")
        self.count = label("", "small")
        self.before = SmallButton("The task before this one", "chevron-left", tokens)
        self.after = SmallButton("The next task", "chevron-right", tokens)
        self.before.clicked.connect(lambda: self.turned.emit(-1))
        self.after.clicked.connect(lambda: self.turned.emit(1))
        self._bar = TimeLeft(tokens)
        line = QFrame()
        line.setObjectName("taskHead")
        line.setFixedHeight(HEIGHT)
        across = QHBoxLayout(line)
        across.setContentsMargins(PAD, 0, PAD, 0)
        across.setSpacing(6)
        across.addWidget(self._hand)
        across.addWidget(self.heading)
        turning = QHBoxLayout()
        turning.setSpacing(2)
        for part in (self.before, self.count, self.after):
            turning.addWidget(part)
        across.addLayout(turning)
        across.addStretch(1)
        across.addWidget(self.left)
        across.addWidget(label("left", "small"))
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(line)
        column.addWidget(self._bar)
        self.set_tokens(tokens)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        ratio = self.devicePixelRatioF()
        self._hand.setPixmap(pixmap("hand", tokens.acc, tokens.surf, 16, ratio))
        for part in (self.before, self.after, self._bar):
            part.set_tokens(tokens)

    def show_card(self, card: CardView, place: int, count: int) -> None:
        """Show a card; it is task ``place`` (counted from 1) of ``count`` open ones."""
        self.heading.setText(card.heading)
        self.left.setText(card.left)
        self._bar.show_share(card.share, card.escalation)
        self.count.setText(f"{place} of {count}")
        for part in (self.count, self.before, self.after):
            part.setVisible(count > 1)
