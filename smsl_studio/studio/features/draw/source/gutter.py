"""The gutter: line numbers, the worst mark of each line, and arrows that fold."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QEvent, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QHelpEvent, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QToolTip, QWidget

from smsl_studio.studio.base.icons import SEVERITY_ICON, draw, severity_colour
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.draw.source import regions
from smsl_studio.studio.features.draw.source.text_rows import TextRows

LEFT, MARKS = 8, 22
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


@dataclass(frozen=True)
class Mark:
    """The mark of a line: the severity letter (E, W or I) and the words."""

    severity: str
    words: str


class Gutter(QWidget):
    """The column left of the text.

    ``fixes_wanted`` (line): a mark was clicked. ``fold_wanted`` (line): an arrow or a folded row
    was clicked.
    """

    fixes_wanted = Signal(int)
    fold_wanted = Signal(int)

    def __init__(self, editor: TextRows) -> None:
        super().__init__(editor)
        self._editor = editor
        self._under = -1
        self.marks: dict[int, Mark] = {}
        self.banded: frozenset[int] = frozenset()
        self.active: frozenset[int] = frozenset()
        self.setMouseTracking(True)
        self.setAccessibleName("Line numbers")

    def sizeHint(self) -> QSize:
        """As wide as the numbers and marks need."""
        return QSize(self.needed(), 0)

    def needed(self) -> int:
        """The width in pixels that the line numbers and marks need."""
        digits = max(3, len(str(self._editor.sheet.line_of(self._editor.blockCount() - 1) + 1)))
        return LEFT + self._editor.fontMetrics().horizontalAdvance("0") * digits + MARKS

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the rows that are exposed."""
        painter = QPainter(self)
        painter.fillRect(event.rect(), self._editor.tokens.surf)
        painter.setFont(self._editor.font())
        for line, top, height in self._editor.rows():
            if top > event.rect().bottom():
                break
            if top + height >= event.rect().top():
                self._paint_row(painter, line, QRectF(0, top, self.width(), height))
        painter.end()

    def _paint_row(self, painter: QPainter, line: int, band: QRectF) -> None:
        editor, tokens = self._editor, self._editor.tokens
        if editor.folds.at(line):
            painter.fillRect(band, tokens.sunk)
            self._draw(painter, "chevron-right", band, tokens.tx2)
            return
        if line in self.banded:
            painter.fillRect(band, tokens.accs)
        if line in self.active:
            painter.fillRect(band.adjusted(0, 0, 3 - band.width(), 0), tokens.acc)
        colour: QColor = tokens.tx3
        mark = self.marks.get(line)
        if mark and mark.severity != "I":
            colour = severity_colour(mark.severity, tokens)
            self._draw(painter, SEVERITY_ICON[mark.severity], band, colour)
        elif line == self._under and regions.opens(editor.sheet.pieces, line):
            self._draw(painter, "chevron-down", band, tokens.tx2)
        if editor.sheet.begins_line(line):
            painter.setPen(colour)
            room = band.adjusted(0, 0, -MARKS - 3, 0)
            painter.drawText(room, _RIGHT, str(editor.sheet.line_of(line) + 1))

    def _draw(self, painter: QPainter, name: str, band: QRectF, colour: QColor) -> None:
        box = QRectF(band.right() - MARKS + 1, band.top() + (band.height() - 13) / 2, 13, 13)
        draw(painter, name, box, colour, self._editor.tokens.surf)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Fold or unfold the line, or ask for the fixes of its mark."""
        line = self._editor.row_at(event.position().y())
        if event.button() is not Qt.MouseButton.LeftButton or line is None:
            return
        mark = self.marks.get(line)
        on_mark = event.position().x() >= self.width() - MARKS - 3
        if self._editor.folds.at(line) or (on_mark and (not mark or mark.severity == "I")):
            self.fold_wanted.emit(line)
        elif on_mark:
            self.fixes_wanted.emit(line)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Show the fold arrow in the row under the pointer."""
        self._point(self._editor.row_at(event.position().y()))

    def leaveEvent(self, event: QEvent) -> None:
        """Hide the fold arrow."""
        super().leaveEvent(event)
        self._point(None)

    def event(self, event: QEvent) -> bool:
        """Show the words of a mark as a tip."""
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            line = self._editor.row_at(event.pos().y())
            mark = self.marks.get(-1 if line is None else line)
            words = tip_text(mark.words) if mark else ""
            QToolTip.showText(event.globalPos(), words, self)
            return True
        return super().event(event)

    def _point(self, line: int | None) -> None:
        under = -1 if line is None else line
        if under != self._under:
            self._under = under
            self.update()
