"""The head of a task card: who decides, which of how many tasks it is, and the time left."""

from __future__ import annotations

from PySide6.QtCore import QSize, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QSizePolicy, QVBoxLayout, QWidget

from smsl_studio.front.views.card_view import CardView
from smsl_studio.studio.base.controls import Label, label
from smsl_studio.studio.base.icons import pixmap
from smsl_studio.studio.base.small_button import SmallButton
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.people.time_left import TimeLeft

HEIGHT, PAD = 38, 14
LOWER = 26
"""The height of the second line in a narrow card (pixels)."""


class CardHead(QWidget):
    """A line of words above a bar for the time left; in a narrow card there are two lines."""

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
        self._line = line = QFrame()
        line.setObjectName("taskHead")
        line.setFixedHeight(HEIGHT)
        self._upper, self._lower, self._low = QHBoxLayout(), QHBoxLayout(), False
        lines = QVBoxLayout(line)
        lines.setContentsMargins(PAD, 0, PAD, 0)
        lines.setSpacing(0)
        for across in (self._upper, self._lower):
            across.setSpacing(6)
            lines.addLayout(across)
        fixed = QSizePolicy.Policy.Fixed
        self._hand.setSizePolicy(fixed, fixed)
        self._upper.addWidget(self._hand)
        self._upper.addWidget(self.heading)
        self._rest = QWidget()
        rest = QHBoxLayout(self._rest)
        rest.setContentsMargins(0, 0, 0, 0)
        rest.setSpacing(2)
        for part in (self.before, self.count, self.after):
            rest.addWidget(part)
        rest.addStretch(1)
        rest.addWidget(self.left)
        rest.addSpacing(4)
        rest.addWidget(label("left", "small"))
        self._upper.addWidget(self._rest, 1)
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

    def minimumSizeHint(self) -> QSize:
        """As wide as the longer of two lines."""
        first = self._hand.sizeHint().width() + 6 + self.heading.sizeHint().width()
        wide = max(first, self._rest.minimumSizeHint().width()) + 2 * PAD
        return QSize(wide, super().minimumSizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Use a second line if the card is narrow."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        first = self._hand.sizeHint().width() + 6 + self.heading.sizeHint().width()
        low = first + 6 + self._rest.minimumSizeHint().width() + 2 * PAD > self.width()
        if low != self._low:
            self._low = low
            (self._lower if low else self._upper).addWidget(self._rest, 1)
            self._line.setFixedHeight(HEIGHT + LOWER if low else HEIGHT)

    def show_card(self, card: CardView, place: int, count: int) -> None:
        """Show a card; it is task ``place`` (counted from 1) of ``count`` open ones."""
        self.heading.setText(card.heading)
        self.left.setText(card.left)
        self._bar.show_share(card.share, card.escalation)
        self.count.setText(f"{place} of {count}")
        for part in (self.count, self.before, self.after):
            part.setVisible(count > 1)
        self._fit()
