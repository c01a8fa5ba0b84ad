"""The source of one element in three columns, in the order of the buttons."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QScrollArea, QVBoxLayout, QWidget

from smsl_studio.blueprint.merge.columns import Row, aligned_lines, lines_of
from smsl_studio.blueprint.merge.conflict import Conflict
from smsl_studio.blueprint.merge.sides import MergeSides
from smsl_studio.legible import one_line
from smsl_studio.studio.base.controls import Elided
from smsl_studio.studio.base.paint.change_signs import draw_side
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.features.merge.conflict_card import SIDES
from smsl_studio.studio.features.merge.open_merge import WORDS
from smsl_studio.studio.features.merge.side_button import LETTERS

LINE, HEAD = 18, 28
LEAST = 3
"""So many lines are in view in the lowest window; its page scrolls."""
AROUND, FOLDED = 3, 3
"""So many lines around a difference are shown; so many others and more are folded."""
WAITING = "Choose a conflict: its lines in all versions stand here."


class ColumnsView(QWidget):
    """Shows the lines around a conflict in mine, theirs and base. Read only."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._title = Elided(f"Source. {WAITING}")
        self._title.setProperty("role", "heading")
        self._title.setContentsMargins(12, 6, 12, 6)
        self.columns = VersionColumns(tokens)
        scroll = QScrollArea()
        scroll.setWidgetResizable(True)
        scroll.setFrameShape(QScrollArea.Shape.NoFrame)
        scroll.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        scroll.setAccessibleName("Source of the versions")
        scroll.setWidget(self.columns)
        scroll.setMinimumHeight(HEAD + LEAST * LINE)
        self._scroll = scroll
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self._title)
        column.addWidget(scroll, 1)
        self.setAutoFillBackground(True)
        self.setProperty("role", "panel")

    def show_conflict(self, conflict: Conflict | None, number: int, sides: MergeSides) -> None:
        """Show the lines of a conflict; None for no conflict."""
        if conflict is None:
            self._title.setText(f"Source. {WAITING}")
            self.columns.show_rows((), ())
            return
        self._title.setText(f"Source of conflict {number}, {conflict.address}")
        lines = []
        absent = []
        for side in SIDES:
            version = sides.get(side)
            found = () if version is None else lines_of(version, conflict.path, sides.known)
            lines.append(found)
            absent.append("not known" if version is None else "" if found else "not there")
        rows = aligned_lines(lines)
        self.columns.who = tuple(who_words(sides, side) for side in SIDES)
        self.columns.show_rows(rows, absent, conflict.path[-1])
        shown = self.columns.shown
        first = next(
            (at for at, one in enumerate(shown) if not isinstance(one, int)
             and self.columns.is_about(one)), 0)  # fmt: skip
        self._scroll.ensureVisible(0, HEAD + first * LINE, 0, 3 * LINE)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.columns.set_tokens(tokens)


class VersionColumns(QWidget):
    """Paints rows of lines in three columns. A line that a version lacks is hatched."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens, self._key = tokens, ""
        self.rows: tuple[Row, ...] = ()
        self.shown: tuple[Row | int, ...] = ()
        """The rows that are painted; a number stands for so many that are folded."""
        self.who: tuple[str, ...] = ("", "", "")
        """Who made each version."""
        self._absent: tuple[str, ...] = ()
        self._indent = 0

    def show_rows(self, rows: tuple[Row, ...], absent: Sequence[str], key: str = "") -> None:
        """Show these rows; ``absent`` says for each version why it has no lines, if it has none.
        ``key`` is the name in the lines of the conflict."""
        self.rows, self._absent, self._key = rows, tuple(absent), key
        self._indent = min(
            (len(one.text) - len(one.text.lstrip()) for row in rows for one in row
             if one and one.text.strip()),
            default=0,
        )  # fmt: skip
        said = [" | ".join(one.text.strip() if one else "missing" for one in row) for row in rows]
        self.setAccessibleName("Lines of mine, theirs and base")
        self.setAccessibleDescription("\n".join(said[:50]))
        self.shown = folded(rows, self.is_about)
        self.setMinimumHeight(HEAD + max(len(self.shown), 1) * LINE + 6)
        self.update()

    def is_about(self, row: Row) -> bool:
        """Whether a row has the lines of the conflict: their texts differ."""
        texts = {one.text.strip().rstrip(",") if one else None for one in row}
        return len(texts) > 1 and any(one and self._key in one.text for one in row)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def sizeHint(self) -> QSize:
        """All rows high."""
        return QSize(600, self.minimumHeight())

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint heads and lines of the three columns."""
        painter, tokens = QPainter(self), self._tokens
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), tokens.surf)
        wide = self.width() / len(SIDES)
        for at, side in enumerate(SIDES):
            left = at * wide
            draw_side(painter, left + 18, HEAD / 2, 6.0, LETTERS[side], tokens)
            words = WORDS[side]
            if self._absent and self._absent[at]:
                words += f", {self._absent[at]}"
            head = QRectF(left + 32, 0, wide - 40, HEAD)
            paint_text(painter, head, words, TextInk(tokens.tx, 12, 500))
            if self.who[at]:
                kept = head.adjusted(90, 0, -2, 0)
                paint_text(painter, kept, self.who[at], TextInk(tokens.tx2, 11), right=True)
            for number, row in enumerate(self.shown):
                area = QRectF(left, HEAD + number * LINE, wide, LINE)
                if not isinstance(row, int):
                    self._line(painter, area, row, at)
                elif not at:
                    words = counted(row, "unchanged line")
                    painter.fillRect(QRectF(0, area.top(), self.width(), LINE), tokens.sunk)
                    paint_text(painter, area.adjusted(44, 0, -8, 0), words, TextInk(tokens.tx3, 11))
            if at:
                painter.fillRect(QRectF(left, 0, 1, self.height()), tokens.line)
        painter.fillRect(QRectF(0, HEAD - 1, self.width(), 1), tokens.line)
        painter.end()

    def _line(self, painter: QPainter, area: QRectF, row: Row, at: int) -> None:
        tokens, line = self._tokens, row[at]
        if self.is_about(row):
            painter.fillRect(area, tokens.bads)
        if line is None:
            if not self._absent[at]:
                _hatch(painter, area, tokens.line)
                paint_text(painter, area.adjusted(44, 0, -8, 0), "not in this version",
                           TextInk(tokens.tx3, 11))  # fmt: skip
            return
        if line.number:
            paint_text(painter, QRectF(area.left() + 4, area.top(), 28, LINE), f"{line.number}",
                       TextInk(tokens.tx3, 11, mono=True), right=True)  # fmt: skip
        text = line.text[self._indent :].expandtabs(4)
        paint_text(painter, area.adjusted(44, 0, -8, 0), text, TextInk(tokens.tx, 12, mono=True),
                   elide=Qt.TextElideMode.ElideRight)  # fmt: skip


def folded(rows: Sequence[Row], about: Callable[[Row], bool]) -> tuple[Row | int, ...]:
    """The rows, with a number in place of each long run of rows that are equal in all versions."""
    near: set[int] = set()
    for at, one in enumerate(rows):
        if about(one) or _differs(one):
            near.update(range(at - AROUND, at + AROUND + 1))
    near |= {0, len(rows) - 1}
    found: list[Row | int] = []
    at = 0
    while at < len(rows):
        end = at
        while end < len(rows) and end not in near:
            end += 1
        if end - at >= FOLDED:
            found.append(end - at)
            at = end
        else:
            found.extend(rows[at : max(end, at + 1)])
            at = max(end, at + 1)
    return tuple(found)


def _differs(row: Row) -> bool:
    return len({one.text.strip().rstrip(",") if one else None for one in row}) > 1


def who_words(sides: MergeSides, side: str) -> str:
    """The author and the day of a version, of the base the commit and the day; empty if they are
    not known."""
    author, day, commit = sides.who.get(side, ("", "", ""))
    if not commit:
        return ""
    return f"{commit[:9]}, {day}" if side == "base" else f"{one_line(author)}, {day}"


def _hatch(painter: QPainter, area: QRectF, colour: QColor) -> None:
    painter.setBrushOrigin(QPointF(0, 0))
    painter.fillRect(area, QBrush(colour, Qt.BrushStyle.BDiagPattern))
