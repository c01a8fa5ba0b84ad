"""The table of a fact's values: the meaning of each, which one is on, which mean failure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent, QPalette, QPen
from PySide6.QtWidgets import QAbstractButton, QGridLayout, QWidget

from smsl_studio.blueprint.annotations import FactNote
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Field, label
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.tag import Tag
from smsl_studio.studio.base.theme import CONTROL_ROW, Tokens
from smsl_studio.studio.base.tips import tip_text

MOST = 64
Role = QPalette.ColorRole


class TickBox(QAbstractButton):
    """A box with a tick, or a ring with a dot.

    ``default`` paints a choice that is not written pale.
    """

    def __init__(self, round_: bool = False) -> None:
        super().__init__()
        self._round, self.default = round_, False
        self.setCheckable(True)
        self.setFixedSize(26, 26)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    def sizeHint(self) -> QSize:
        """26 by 26 pixels."""
        return QSize(26, 26)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the box or ring, with the tick or dot if it is checked."""
        palette, painter = self.palette(), QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        on, box = self.isChecked(), QRectF(5.5, 5.5, 15, 15)
        strong = on and not self.default
        edge = palette.color(Role.Accent if strong or self.hasFocus() else Role.Dark)
        painter.setPen(QPen(edge, 1.6 if self.hasFocus() else 1.2))
        painter.setBrush(palette.color(Role.Accent if strong else Role.Base))
        radius = 7.5 if self._round else 4
        painter.drawRoundedRect(box, radius, radius)
        ink = palette.color(Role.BrightText if strong else Role.Dark)
        if on and self._round:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(ink)
            painter.drawEllipse(box.adjusted(4.5, 4.5, -4.5, -4.5))
        elif on:
            draw(painter, "check", box.adjusted(2.5, 2.5, -2.5, -2.5), ink, edge)


@dataclass
class ValueRow:
    """The widgets of one value."""

    chip: Tag
    meaning: Field
    on: TickBox
    failure: TickBox


class ValueTable(QWidget):
    """A row for each value. It emits what the person wants and changes nothing itself."""

    meant = Signal(str, object)
    """(value, meaning): the person typed this meaning; None if the field is empty."""
    turned_on = Signal(object)
    """str | None: the person chose this value as on; None for the default."""
    failed = Signal(object)
    """list | None: the values that mean failure now; None if there are none."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self.rows: dict[str, ValueRow] = {}
        self._failures: tuple[str, ...] = ()
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 4, 0, 0)
        self._grid.setHorizontalSpacing(6)
        self._grid.setVerticalSpacing(4)
        self._grid.setColumnStretch(1, 1)
        for column, words in enumerate(("Value", "Meaning", "On", "Failure")):
            self._grid.addWidget(label(words, "small"), 0, column)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for one in self.rows.values():
            one.chip.set_tokens(tokens)

    def show_values(self, values: Sequence[str], note: FactNote, on: str) -> None:
        """Show the values of a fact. ``on`` is the value that counts as on, written or default."""
        shown = list(dict.fromkeys((*values, *note.values, *note.failure)))[:MOST]
        if list(self.rows) != shown:
            self._build(shown)
        self._failures = note.failure
        for value, one in self.rows.items():
            one.meaning.settle(note.values.get(value, ""))
            one.on.setChecked(value == on)
            one.on.default = note.on is None
            one.on.setToolTip(tip_text(_on_words(value, value == on, note)))
            one.failure.setChecked(value in note.failure)
            one.on.update()
            kind = "on" if value == on else "value"
            one.chip.show_tag(value, kind, False)

    def _build(self, values: Sequence[str]) -> None:
        for one in self.rows.values():
            for widget in (one.chip, one.meaning, one.on, one.failure):
                self._grid.removeWidget(widget)
                widget.hide()
                widget.deleteLater()
        self.rows = {value: self._new_row(at, value) for at, value in enumerate(values, start=1)}

    def _new_row(self, at: int, value: str) -> ValueRow:
        one = ValueRow(Tag(self._tokens), Field(), TickBox(round_=True), TickBox())
        one.chip.fit(value)
        one.meaning.setAccessibleName(plain_text(f"Meaning of {value}"))
        one.meaning.setToolTip(tip_text(f"What {value} means, in plain words"))
        one.meaning.editingFinished.connect(lambda: self._typed(value, one.meaning))
        one.on.setAccessibleName(plain_text(f"{value} counts as on"))
        one.on.clicked.connect(lambda: self._on(value, one.on))
        one.failure.setAccessibleName(plain_text(f"{value} means failure"))
        one.failure.setToolTip(tip_text(f"Whether {value} means that something failed"))
        one.failure.clicked.connect(lambda on: self._fail(value, on))
        centre = Qt.AlignmentFlag.AlignCenter
        self._grid.addWidget(one.chip, at, 0)
        self._grid.addWidget(one.meaning, at, 1)
        self._grid.addWidget(one.on, at, 2, centre)
        self._grid.addWidget(one.failure, at, 3, centre)
        self._grid.setRowMinimumHeight(at, CONTROL_ROW)
        return one

    def _typed(self, value: str, field: Field) -> None:
        if field.changed:
            self.meant.emit(value, field.text().strip() or None)

    def _on(self, value: str, tick: TickBox) -> None:
        # A click on the chosen value removes the choice; a default value stays on.
        chosen = tick.isChecked()
        tick.setChecked(chosen or tick.default)
        self.turned_on.emit(value if chosen else None)

    def _fail(self, value: str, on: bool) -> None:
        left = [*self._failures, value] if on else [v for v in self._failures if v != value]
        self.failed.emit(left or None)


def _on_words(value: str, on: bool, note: FactNote) -> str:
    if on and note.on is None:
        return f"{value} counts as on by default"
    return (
        f"{value} counts as on. Click to leave it to the default."
        if on
        else f"Let {value} count as on"
    )
