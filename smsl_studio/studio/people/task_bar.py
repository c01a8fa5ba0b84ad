"""A line across the window that says that people are asked something, where no card is in view."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton

from smsl_studio.studio.controls import Elided, label
from smsl_studio.studio.icons import pixmap
from smsl_studio.studio.people.task_card import TaskCard
from smsl_studio.studio.theme import Tokens

HEIGHT = 40


class TaskBar(QFrame):
    """Tasks are never out of sight: what is asked, the time that is left, and how many more."""

    open_wanted = Signal()

    def __init__(self, card: TaskCard, tokens: Tokens) -> None:
        super().__init__()
        self.setObjectName("task_bar")
        self.setFixedHeight(HEIGHT)
        self._card = card
        self._hand = QLabel()
        self.words = Elided()
        self.left = label("", "strong")
        self.more = label("", "small")
        self.open = QPushButton("Open")
        self.open.setProperty("role", "row")
        self.open.setToolTip("Show the task in Supervise")
        self.open.setCursor(Qt.CursorShape.PointingHandCursor)
        self.open.clicked.connect(self.open_wanted)
        across = QHBoxLayout(self)
        across.setContentsMargins(12, 0, 12, 0)
        across.setSpacing(10)
        for part in (self._hand, self.words, self.more, self.left, self.open):
            across.addWidget(part, 1 if part is self.words else 0)
        self.set_tokens(tokens)
        card.changed.connect(self.refresh)
        self.refresh()

    def set_tokens(self, tokens: Tokens) -> None:
        picture = pixmap("hand", tokens.acc, tokens.surf, 16, self.devicePixelRatioF())
        self._hand.setPixmap(picture)

    def refresh(self) -> None:
        """Say what is asked, unless the card says it."""
        card = self._card.card
        self.setVisible(card is not None and not self._card.isVisible())
        if card is None:
            return
        said = f"{card.heading}: {card.question}"
        self.words.setText(said)
        self.words.setToolTip(said)
        self.left.setText(f"{card.left} left")
        others = len(self._card.tasks) - 1
        self.more.setText(f"{others} more" if others else "")
        self.setAccessibleName(said)
