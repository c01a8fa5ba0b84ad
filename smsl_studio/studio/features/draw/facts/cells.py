"""Where the cells of a fact stand: on a card in a narrow panel, in five columns in a wide one."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from PySide6.QtCore import QRectF
from PySide6.QtGui import QFontMetricsF

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.theme import mono_font, text_font
from smsl_studio.studio.features.draw.facts.fact_lines import FactValue, TabledFact

WIDE = 560
"""From this width on (pixels) a fact is one row of a table."""
COLUMNS = (("Fact", 0.0), ("Values", 0.27), ("Sensor or sub-SB", 0.62), ("Max. age", 0.82),
           ("Unit", 0.91))  # fmt: skip
"""The columns of the wide table: their words, and where they begin as a share of the width."""
MARGIN, TEXT, LINE, ROW = 12.0, 40.0, 24.0, 36.0
LINES, GAP = 4, 4.0
"""How many lines the values of a card take at most, and the space between two of them (pixels)."""
TYPED = ("name", "meaning", "source", "age", "unit")
"""The kinds of cells in which a person types."""
HINTS = {"name": "Fact {}", "meaning": "meaning", "source": "no sensor", "age": "age",
         "unit": "unit"}  # fmt: skip
"""What is shown in an empty cell, by its kind; a name has the number of its fact."""


@dataclass(frozen=True)
class Cell:
    """A part of a line with a place of its own. ``value`` is the value of the fact it is about."""

    kind: str
    rect: QRectF
    text: str
    value: str = ""

    @property
    def key(self) -> tuple[str, str]:
        """What it shows, wherever it stands."""
        return self.kind, self.value


def width_of(text: str, mono: bool = False) -> float:
    """The width of a text of a cell in pixels."""
    return _metrics(mono).horizontalAdvance(plain_text(text[:200]))


@cache
def _metrics(mono: bool) -> QFontMetricsF:
    return QFontMetricsF(mono_font(12) if mono else text_font(12))


def height_of(line: TabledFact, width: int) -> int:
    """The height of a line in a panel of this width."""
    if width >= WIDE:
        return int(ROW)
    return int(max(cell.rect.bottom() for cell in cells_of(line, width)) + 10)


def cells_of(line: TabledFact, width: int) -> list[Cell]:
    """The cells of a line, in the order in which the keys visit them."""
    return _row(line, width) if width >= WIDE else _card(line, width)


def _card(line: TabledFact, width: int) -> list[Cell]:
    right = width - MARGIN
    unit = _at_right(right, 8.0, line.unit or "unit", width * 0.3)
    critical = QRectF(unit.left() - 22, 11, 14, 14)
    name = QRectF(TEXT, 8, critical.left() - 4 - TEXT, 20)
    cells = [
        Cell("digit", QRectF(MARGIN, 8, 20, 20), str(line.digit)),
        Cell("name", name, line.name),
        Cell("critical", critical, ""),
        Cell("unit", unit, line.unit),
    ]
    values, bottom = _grid(line, TEXT, right, 34.0)
    cells += values
    return cells + _source(line, QRectF(TEXT, bottom + 2, right - TEXT, 20))


def _row(line: TabledFact, width: int) -> list[Cell]:
    span = width - 2 * MARGIN
    at = [MARGIN + share * span for _, share in COLUMNS] + [width - MARGIN]
    top = (ROW - 20) / 2
    cells = [
        Cell("digit", QRectF(MARGIN, top, 20, 20), str(line.digit)),
        Cell("name", QRectF(TEXT, top, at[1] - 30 - TEXT, 20), line.name),
        Cell("critical", QRectF(at[1] - 24, top + 3, 14, 14), ""),
    ]
    cells += _in_line(line, at[1], at[2] - 12, top)
    source = QRectF(at[2], top, at[3] - 12 - at[2], 20)
    age = QRectF(at[3], top, at[4] - 8 - at[3], 20)
    if line.sub:
        cells.append(Cell("sub", source, line.sub))
    else:
        cells += [Cell("source", source, line.source), Cell("age", age, line.age)]
    return [*cells, Cell("unit", QRectF(at[4], top, at[5] - at[4], 20), line.unit)]


def _source(line: TabledFact, room: QRectF) -> list[Cell]:
    if line.sub:
        return [Cell("sub", room, line.sub)]
    age = _at_right(room.right(), room.top(), line.age or "age", room.width() * 0.4)
    source = QRectF(room.left(), room.top(), age.left() - 8 - room.left(), 20)
    return [Cell("source", source, line.source), Cell("age", age, line.age)]


def _at_right(right: float, top: float, text: str, most: float) -> QRectF:
    wide = min(max(width_of(text, mono=True), 20.0), most)
    return QRectF(right - wide, top, wide, 20)


def _sizes(one: FactValue) -> tuple[float, float]:
    """The widths of the chip of a value, and of its meaning or the hint in its place."""
    chip = min(max(18.0, width_of(one.text, mono=True) + 8), 60.0)
    return chip, max(width_of(one.meaning or HINTS["meaning"]) + 4, 16.0)


def _pair(one: FactValue, x: float, y: float, chip: float, wide: float) -> list[Cell]:
    """The cells of a value and of its meaning, from their corner on."""
    return [
        Cell("value", QRectF(x, y + 1, chip, 18), one.text, one.text),
        Cell("meaning", QRectF(x + chip + 5, y, wide, 20), one.meaning, one.text),
    ]


def _grid(line: TabledFact, left: float, right: float, top: float) -> tuple[list[Cell], float]:
    """The cells of the values in two columns, and where the next line begins.

    If a meaning does not fit into a column, each value has a line of its own. So a meaning that is
    typed moves no other cell as long as it fits.
    """
    half = (right - left) / 2
    sizes = [_sizes(one) for one in line.values]
    columns = 2 if all(chip + 5 + wide <= half - GAP for chip, wide in sizes) else 1
    room = (right - left) / columns
    shown, rest = len(line.values), line.more
    if rest or shown > LINES * columns:
        shown = min(shown, LINES * columns - 1)
        rest += len(line.values) - shown
    cells: list[Cell] = []
    for at, (one, (chip, _)) in enumerate(zip(line.values[:shown], sizes, strict=False)):
        row, column = divmod(at, columns)
        x = left + column * room
        cells += _pair(one, x, top + row * LINE, chip, room - chip - 5 - GAP)
    row, column = divmod(shown, columns)
    if rest:
        place = QRectF(left + column * room, top + row * LINE, room - GAP, 20)
        cells.append(Cell("more", place, f"+{rest:,}"))
    return cells, top + (row + bool(rest or column)) * LINE


def _in_line(line: TabledFact, left: float, right: float, top: float) -> list[Cell]:
    """The cells of the values in one line, as many as fit."""
    cells: list[Cell] = []
    x = left
    for at, one in enumerate(line.values):
        chip, wide = _sizes(one)
        rest = len(line.values) - at + line.more
        room = right - (30 if rest > 1 else 0)
        if x > left and x + chip + 5 + wide > room:
            return [*cells, Cell("more", QRectF(x, top, right - x, 20), f"+{rest:,}")]
        wide = min(wide, max(room - x - chip - 5, 16.0))
        cells += _pair(one, x, top, chip, wide)
        x += chip + 5 + wide + 10
    if line.more:
        cells.append(Cell("more", QRectF(x, top, max(right - x, 0), 20), f"+{line.more:,}"))
    return cells
