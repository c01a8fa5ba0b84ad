"""The head of the partial view: buttons for the SBs, names of the columns, and the full map."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFontMetrics, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QToolButton, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import row
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.paint.ink import Type
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.features.supervise.columns import Columns
from smsl_studio.studio.features.supervise.wires import draw_dots
from smsl_studio.studio.running.frames import tool

HIGH, LOW = 64, 40
"""The height with the names of the columns, and without them (pixels)."""
TOP = 40


class PartialHead(QWidget):
    """The head. With several SBs each has a button.

    The SB in which an operation runs is selected by itself, until a person selects one.
    """

    branch_wanted = Signal(str)
    map_wanted = Signal(bool)

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._columns: Columns | None = None
        self._previous = False
        self._shift = 0
        self._names: tuple[str, ...] = ()
        self._shown = self._live = ""
        self._mapped: tuple[bool, bool] | None = None
        self.setFixedHeight(HIGH)
        self.map = tool("Show full map, logged", "map", "", tokens)
        self.map.setCheckable(True)
        self.map.clicked.connect(lambda on: self.map_wanted.emit(on))
        self.map.setProperty("role", "mapTool")
        self.map.setFixedHeight(28)
        inner = QWidget()
        self._buttons = QHBoxLayout(inner)
        self._buttons.setContentsMargins(0, 0, 0, 0)
        self._buttons.setSpacing(2)
        self._branches: list[QToolButton] = []
        top = row(inner, None, self.map)
        top.setContentsMargins(6, 6, 12, 0)
        top.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.setLayout(top)

    def branches(self) -> list[QToolButton]:
        """The buttons of the SBs in order."""
        return [button for button in self._branches if not button.isHidden()]

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self._dress_map()
        self.update()

    def show_columns(self, columns: Columns | None, previous: bool, shift: int) -> None:
        """Show the names of the columns; None shows none.

        ``shift`` is how far the board is scrolled to the right (pixels). ``previous`` says whether
        there is a previous state.
        """
        told = (columns, previous, shift)
        if told != (self._columns, self._previous, self._shift):
            self._columns, self._previous, self._shift = told
            self.update()

    def show_branches(self, names: Sequence[str], shown: str, live: str) -> None:
        """Show a button for each SB; ``shown`` is selected, and in ``live`` an operation runs."""
        told = (tuple(names), shown, live)
        if told == (self._names, self._shown, self._live):
            return
        self._names, self._shown, self._live = told
        self._fill()

    def show_map(self, on: bool, possible: bool) -> None:
        """Show whether the full map is on, and whether it can be switched on."""
        if (on, possible) == self._mapped:
            self.map.setChecked(on)
            return
        self._mapped = (on, possible)
        self.map.setChecked(on)
        self.map.setText("Back to the partial view" if on else "Show full map, logged")
        self.map.setEnabled(possible)
        self.map.setToolTip(
            "Every state and operation of this State Branch. The record notes that it was "
            "shown." if possible else "It is logged in a run's record, and no run is there."
        )  # fmt: skip
        self.map.setAccessibleName(plain_text(self.map.text().strip()))
        self._dress_map()

    def _dress_map(self) -> None:
        colour = self._tokens.acc if self.map.isChecked() else self._tokens.tx2
        self.map.setIcon(icon("map", self._tokens, 16, colour))

    def _fill(self) -> None:
        while len(self._branches) < len(self._names):
            button = QToolButton()
            button.setProperty("role", "branch")
            button.setCheckable(True)
            at = len(self._branches)
            button.clicked.connect(lambda _=False, at=at: self._choose(at))
            self._branches.append(button)
            self._buttons.addWidget(button)
        middle = Qt.TextElideMode.ElideMiddle
        metrics = QFontMetrics(text_font(13, 600))
        share = (self.width() - 220) // max(len(self._names), 1) - 14
        for at, found in enumerate(self._branches):
            found.setVisible(at < len(self._names))
            if at < len(self._names):
                name = self._names[at]
                words = metrics.elidedText(plain_text(name), middle, max(share, 30))
                found.setText(as_it_is(words))
                found.setToolTip(tip_text(f"Show {name}"))
                found.setAccessibleName(plain_text(name))
                found.setChecked(name == self._shown)
                live = name == self._live and len(self._names) > 1
                if bool(found.property("live")) != live:
                    found.setProperty("live", live)
                    found.style().unpolish(found)
                    found.style().polish(found)

    def _choose(self, at: int) -> None:
        self._fill()
        self.branch_wanted.emit(self._names[at])

    def sizeHint(self) -> QSize:
        """600 pixels wide."""
        return QSize(600, HIGH)

    def minimumSizeHint(self) -> QSize:
        """No minimum width, because names can be shortened."""
        return QSize(0, HIGH)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the buttons of the SBs into the new width."""
        super().resizeEvent(event)
        if self._names:
            self._fill()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the background and the names of the columns."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), self._tokens.canvas)
        draw_dots(painter, self.rect(), self._tokens)
        found = self._columns
        if found is not None:
            painter.setRenderHint(QPainter.RenderHint.TextAntialiasing)
            kind = Type(text_font(12))
            painter.setFont(kind.font)
            painter.setPen(self._tokens.tx2)
            long = "Operations from here: risk, cost, who acts, needs"
            cards = long if kind.width(long) < found.cards[1] + 60 else "Operations from here"
            before = "Previous" if self._previous else ""
            both = f"{before}, current" if before else "Current"
            for (x, wide), words in (
                (found.previous, "" if found.stacked else before),
                (found.current, both if found.stacked else "Current"),
                (found.cards, cards),
                (found.neighbours, "Neighbours"),
            ):
                room = QRectF(x - 40 - self._shift, TOP, wide + 80, 18)
                painter.drawText(room, Qt.AlignmentFlag.AlignCenter, plain_text(words))
        painter.end()
