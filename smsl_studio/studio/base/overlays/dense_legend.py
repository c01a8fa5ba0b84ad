"""The legend of a dense drawing: what is collapsed, and the button that shows all of it."""

from __future__ import annotations

from PySide6.QtCore import QSize, Signal
from PySide6.QtGui import QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QHBoxLayout, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.overlays.card import GAP, ICON, Card, IconButton
from smsl_studio.studio.base.paint.ink import Type
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.base.tips import tip_text

THICK = (
    "A thick line stands for so many operations between two states. Its number counts them. "
    "A click lists those of the next one (L)."
)
COULD_BE = "So many lines would stand for several operations between two states each."
BACK = (
    "Operations that lead far back to the initial state share the lane with the house. ↵ below a "
    "state: one leads from there. A click lists them."
)
MIXED = "They change several facts at once, or load a sub-SB."
WIDEST = 10_000
"""A width that is more than the legend ever needs (pixels)."""
ROOM = 24
"""The room at the sides of a button with words (pixels)."""


class DenseLegend(Card):
    """Says how many bundles a drawing has, and what they are.

    Its last button shows all operations, or collapses them again.
    """

    collapse_wanted = Signal(bool)
    """Whether operations shall be collapsed."""
    lane_wanted = Signal()
    """List the operations that lead back to the start."""
    bundle_wanted = Signal()
    """The person wants a list of the operations in the next bundle."""

    def __init__(self, parent: QWidget, tokens: Tokens) -> None:
        super().__init__(parent, tokens)
        self._type = Type(text_font(13, 500))
        self._collapsed, self.empty = False, True
        self._room, self._words = WIDEST, dict[IconButton, str]()
        self._fitted: tuple[object, ...] = ()
        self._widest = ""
        """The longest words of the first button in this drawing. It has their width from the
        beginning, so that a selection, which opens bundles, moves no other button."""
        self.bundles = IconButton(self, tokens, "bundle", "Bundles")
        self.bundles.clicked.connect(self.bundle_wanted)
        self.back = IconButton(self, tokens, "house", "Back to start")
        self.back.clicked.connect(self.lane_wanted)
        self.mixed = IconButton(self, tokens, "mixed", "Load and mixed")
        self.mixed.hide()
        self.all = IconButton(self, tokens, "", "Show all")
        self.all.accent = True
        self.all.clicked.connect(lambda: self.collapse_wanted.emit(not self._collapsed))
        row = QHBoxLayout(self)
        row.setContentsMargins(3, 1, 3, 1)
        row.setSpacing(8)
        row.addWidget(self.bundles)
        row.addWidget(self.back)
        row.addWidget(self.mixed)
        row.addWidget(self.all)
        self.set_tokens(tokens)
        self.hide()

    def show_counts(self, collapsed: bool, bundles: int, opened: int, back: int = 0) -> None:
        """Tell how many bundles there can be, how many of them are open now, and how many
        operations lead ``back`` to the start by the lane.

        With nothing to collapse the legend is empty.
        """
        self._collapsed, self.empty = collapsed, not bundles and not back
        words = f"Back to start {back:,}"
        self._say(self.back, words, BACK)
        self.back.setVisible(bool(back))
        self.back.setEnabled(collapsed)
        words = f"Bundles {bundles:,}"
        self._widest = f"{words}, {bundles:,} open" if collapsed else ""
        if collapsed and opened:
            words += f", {opened:,} open"
        self._say(self.bundles, words, THICK if collapsed else COULD_BE)
        self.bundles.setEnabled(collapsed)
        button = "Show all" if collapsed else "Collapse"
        tip = "Draw every operation by itself" if collapsed else (
            "Draw operations between the same two states as one line")  # fmt: skip
        self._say(self.all, button, tip)
        self.setAccessibleName(plain_text(words))
        self.fit(self._room)
        self.update()

    def show_mixed(self, count: int, dimmed: bool) -> None:
        """Tell how many operations change several facts at once or load a sub-SB, and whether they
        are dimmed. Its button is hidden if there are none."""
        words = f"Load and mixed {count:,}{', dimmed' if dimmed else ''}"
        tip = f"{MIXED} {'Show them as all others.' if dimmed else 'Dim them.'}"
        self._say(self.mixed, words, tip)
        self.mixed.accent = dimmed
        self.mixed.setVisible(bool(count))
        self.fit(self._room)

    def _say(self, button: IconButton, words: str, tip: str) -> None:
        """Set the words of a button, its tooltip, and its name for screen readers."""
        self._words[button] = words
        button.setAccessibleName(plain_text(words))
        button.setToolTip(tip_text(tip))

    def fit(self, room: int) -> None:
        """Take at most this width (pixels). If needed, hide the words beside the icons."""
        self._room = room
        key = room, self._widest, *self._words.values(), self.mixed.isHidden(), self.back.isHidden()
        if key == self._fitted:
            return
        self._fitted = key
        for brief in (False, True):
            for button, words in self._words.items():
                widest = self._widest if button is self.bundles else ""
                cut = _number(words) if brief else 0
                self._write(button, words[cut:], widest[cut:])
            if self.sizeHint().width() <= room:
                break
        self.resize(self.sizeHint())

    def _write(self, button: IconButton, words: str, widest: str) -> None:
        """Set the words of a button, and the width that they need, or its widest words."""
        button.setText(words)
        icon = 0 if button is self.all else round(ICON + GAP / 2)
        wide = max(self._type.width(words), self._type.width(widest))
        button.setFixedSize(round(wide) + ROOM + icon, 30)

    def sizeHint(self) -> QSize:
        """As wide as its words, 32 high."""
        shown = [one for one in (self.back, self.mixed, self.all) if not one.isHidden()]
        wide = self.bundles.width() + sum(one.width() + 8 for one in shown)
        return QSize(wide + 6, 32)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the card, and a line before the button."""
        super().paintEvent(event)
        painter = QPainter(self)
        painter.setPen(QPen(self.tokens.line, 1.0))
        for button in (self.back, self.mixed, self.all):
            if not button.isHidden():
                painter.drawLine(button.x() - 4, 8, button.x() - 4, self.height() - 9)
        painter.end()


def _number(words: str) -> int:
    """The place in the text where the number begins. 0 if there is none."""
    return next((at for at, letter in enumerate(words) if letter.isdigit()), 0)
