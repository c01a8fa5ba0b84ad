"""Possible now: every operation of the active states, with the reason if it is not possible."""

from __future__ import annotations

from PySide6.QtCore import Qt, QTimer, Signal, SignalInstance
from PySide6.QtGui import QFontMetrics, QFontMetricsF, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QFrame,
    QHBoxLayout,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.front.views.possible_rows import PossibleRow
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Label, label, row_button
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.icons import icon, pixmap
from smsl_studio.studio.base.theme import Tokens, mono_font, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.running.choice_button import ChoiceButton, DoublePress

ROW = 35
SOON = 20
"""Milliseconds from a change of the run to new rows."""

REASONED = ("refused", "pruned")
PRUNABLE = ("running", "route", "possible", "waits")
WIDEST = (160, 80)
"""Largest width of the names of operations and of targets (pixels)."""
PADDING = 24
"""Pixels that a button needs beside its words."""


BESIDE = 2 * 12 + 16 + 5 * 8 + 30 + 26
"""Pixels of a row without names and words: edges, mark, gaps, cost and scissors."""
ENOUGH = 110
"""Pixels in which the beginning of a sentence is understandable; the tooltip has the rest."""


class PossibleList(QScrollArea):
    """A list with a widget for each row, so that each can have the focus.

    Permitted operations are buttons.
    """

    chosen = Signal(object)
    """Address: the person chose this permitted operation."""
    restore_wanted = Signal(object)
    """Address: the person wants to restore this pruned or risky operation."""

    prune_wanted = Signal(object)
    """Address: the person wants to prune this operation."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setAccessibleName("Possible now")
        FocusLine(self)
        self._rows: tuple[PossibleRow, ...] = ()
        self._by_hand = False
        self._presses = DoublePress()
        self._empty = "Starts with the run"
        self._narrow = False
        self._late = QTimer(self)
        self._late.setSingleShot(True)
        self._late.setInterval(SOON)
        self._late.timeout.connect(self._rebuild)
        self._rebuild()

    def show_rows(self, rows: tuple[PossibleRow, ...], by_hand: bool, empty: str) -> None:
        """Replace the rows, unless nothing changed, so that the focus stays.

        ``empty`` is shown without rows. The widgets are made a moment later, because the state of
        the run must be visible first.
        """
        if (rows, by_hand, empty) == (self._rows, self._by_hand, self._empty):
            return
        self._rows, self._by_hand, self._empty = rows, by_hand, empty
        if not self._late.isActive():
            self._late.start()

    def row_widgets(self) -> list[QWidget]:
        """The widgets of the rows in order, for tests."""
        if self._late.isActive():
            self._rebuild()
        inner = self.widget()
        return list(inner.findChildren(QFrame, "possibleRow")) if inner else []

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Make the rows again when the list becomes narrow or wide."""
        super().resizeEvent(event)
        if self._is_narrow() != self._narrow:
            self._rebuild()

    def _is_narrow(self) -> bool:
        """Whether the words of a row have too little room beside its name, so that they stand
        below."""
        words = [row.words for row in self._rows if row.kind not in REASONED]
        metrics = QFontMetricsF(text_font(12))
        longest = max((metrics.horizontalAdvance(one) for one in words), default=0.0)
        needed = min(longest, ENOUGH)
        columns = sum(self._column_width(column) for column in (0, 1)) if words else 0
        return columns + needed + BESIDE > self.viewport().width()

    def _rebuild(self) -> None:
        self._late.stop()
        self._narrow = self._is_narrow()
        bar = self.verticalScrollBar().value()
        focused = self._focused()
        inner = QWidget()
        inner.setProperty("role", "panel")
        column = QVBoxLayout(inner)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        group = ""
        for row in self._rows:
            if row.group != group:
                group = row.group
                column.addWidget(self._group(group, row.note))
            column.addWidget(self._line(row))
        if not self._rows:
            empty = label(self._empty, "hint")
            empty.setContentsMargins(12, 8, 12, 8)
            column.addWidget(empty)
        column.addStretch(1)
        if focused is not None:
            # The list keeps the focus while its buttons are made again. Otherwise Tab would begin
            # at the start of the window after every step.
            self.setFocus()
        self.setWidget(inner)
        self.verticalScrollBar().setValue(bar)
        if focused:
            self._focus_again(focused)

    def _focused(self) -> str | None:
        """The accessible name of the button with the focus.

        It is empty if another part of the rows has the focus, and None if no part of them has it.
        """
        inner, focus = self.widget(), QApplication.focusWidget()
        if inner is None or focus is None or not inner.isAncestorOf(focus):
            return None
        return focus.accessibleName()

    def _focus_again(self, name: str) -> None:
        """Give the focus to the new button of the same name, if there is one."""
        inner = self.widget()
        for button in inner.findChildren(QAbstractButton) if inner else ():
            if button.accessibleName() == name:
                button.setFocus()
                return

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self._rebuild()

    @staticmethod
    def _group(words: str, note: str) -> QWidget:
        line = QFrame()
        line.setObjectName("possibleGroup")
        line.setFixedHeight(28)
        across = QHBoxLayout(line)
        across.setContentsMargins(12, 0, 12, 0)
        across.addWidget(label(words, "small"))
        across.addStretch(1)
        across.addWidget(label(note, "small"))
        return line

    def _line(self, row: PossibleRow) -> QWidget:
        line = QFrame()
        line.setObjectName("possibleRow")
        line.setProperty("kind", row.kind)
        whole = QVBoxLayout(line)
        whole.setContentsMargins(12, 0, 12, 0)
        whole.setSpacing(0)
        across = QHBoxLayout()
        across.setSpacing(8)
        across.addStrut(ROW)
        whole.addLayout(across)
        across.addWidget(self._mark(row.kind))
        if row.kind in ("route", "possible") and self._by_hand:
            hint = f"Carry out {row.address}"
            button = ChoiceButton(row.name, hint, self._presses)
            button.clicked.connect(lambda _=False: self.chosen.emit(row.address))
            across.addWidget(self._fixed(button, 0))
            room = button.maximumWidth() - PADDING
            button.setText(as_it_is(_shortened(row.name, 500, room)))
            button.setAccessibleName(plain_text(row.name))
        else:
            plain = row.kind in ("waits", "pruned", "refused", "later")
            words = _shortened(row.name, 600, self._column_width(0) - 2)
            across.addWidget(self._fixed(label(words, "medium" if plain else "strong"), 0))
        across.addWidget(self._fixed(label(row.target, "mono"), 1))
        if row.kind in REASONED or self._narrow:
            # The reason why an operation is not possible is never cut. It stands below and wraps.
            across.addStretch(1)
            reason = label(row.words, "hint")
            reason.setContentsMargins(24, 0, 0, 9)
            whole.addWidget(reason)
        else:
            across.addWidget(_Words(row.words), 1)
        if row.kind == "pruned":
            hint = f"Let the route use {row.address} again"
            restore = self._button("Restore", hint, self.restore_wanted, row)
            restore.setAccessibleName(plain_text(f"Restore {row.name}"))
            across.addWidget(restore)
        else:
            across.addWidget(label(row.cost, "mono"))
            if row.kind in PRUNABLE:
                across.addWidget(self._scissors(row))
        line.setToolTip(tip_text(f"{row.address} to {row.target}: {row.words}"))
        cost = f", cost {row.cost}" if row.cost else ""
        line.setAccessibleName(plain_text(f"{row.name} to {row.target}, {row.words}{cost}"))
        return line

    def _fixed(self, widget: QWidget, column: int) -> QWidget:
        """The widget with the width of its column."""
        widget.setFixedWidth(self._column_width(column))
        return widget

    def _column_width(self, column: int) -> int:
        fonts = text_font(13, 600), mono_font(12)
        metrics = QFontMetricsF(fonts[column])
        texts = ((row.name, row.target)[column] for row in self._rows)
        pad = PADDING if column == 0 and self._by_hand else 4
        widest = max(metrics.horizontalAdvance(text) for text in texts) + pad
        return round(min(widest, WIDEST[column]))

    def _mark(self, kind: str) -> QWidget:
        name, colour = {
            "running": ("play", self._tokens.acc),
            "route": ("chevron-right", self._tokens.acc),
            "possible": ("chevron-right", self._tokens.tx2),
            "waits": ("clock", self._tokens.tx2),
            "pruned": ("barred", self._tokens.tx2),
            "next": ("chevron-right", self._tokens.acc),
            "later": ("chevron-right", self._tokens.acc),
        }.get(kind, ("minus", self._tokens.tx3))
        mark = Label()
        ratio = self.devicePixelRatioF()
        mark.setPixmap(pixmap(name, colour, self._tokens.surf, 14, ratio))
        mark.setFixedWidth(16)
        return mark

    def _scissors(self, row: PossibleRow) -> QToolButton:
        prune = QToolButton()
        prune.setProperty("role", "small")
        command = COMMANDS["prune"]
        words = command.doing(row.name)
        prune.setIcon(icon(command.icon, self._tokens, 14))
        prune.setFixedSize(26, 26)
        prune.setToolTip(tip_text(f"{words}…: exclude it until it is restored"))
        prune.setAccessibleName(plain_text(words))
        prune.clicked.connect(lambda _=False: self.prune_wanted.emit(row.address))
        return prune

    @staticmethod
    def _button(words: str, hint: str, signal: SignalInstance, row: PossibleRow) -> QPushButton:
        button = row_button(words, hint)
        button.clicked.connect(lambda _=False: signal.emit(row.address))
        return button


def _shortened(name: str, weight: int, room: int) -> str:
    """Return a name that fits into so many pixels. Names of operations often begin alike, so their
    middle is left out; the tooltip has it.
    """
    metrics = QFontMetrics(text_font(13, weight))
    return metrics.elidedText(plain_text(name), Qt.TextElideMode.ElideMiddle, room)


class _Words(Label):
    """A sentence that ends in an ellipsis if there is no room; the tooltip has all of it."""

    def __init__(self, words: str) -> None:
        super().__init__(words)
        self.setToolTip(tip_text(words))
        self.setProperty("role", "small")
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the sentence, with an ellipsis if it is too long."""
        painter = QPainter(self)
        painter.setPen(self.palette().windowText().color())
        right = Qt.TextElideMode.ElideRight
        shown = self.fontMetrics().elidedText(plain_text(self.text()), right, self.width())
        painter.drawText(self.rect(), Qt.AlignmentFlag.AlignVCenter, shown)
        painter.end()
