"""Paints the lines of the table of facts."""

from __future__ import annotations

from PySide6.QtCore import QModelIndex, QObject, QPersistentModelIndex, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPen
from PySide6.QtWidgets import QStyle, QStyledItemDelegate, QStyleOptionViewItem

from smsl_studio.studio.base.chips import paint_chip
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import RADIUS_CHIP, Tokens
from smsl_studio.studio.features.draw.facts.cells import HINTS, WIDE, Cell, cells_of, height_of
from smsl_studio.studio.features.draw.facts.fact_lines import TabledFact

Index = QModelIndex | QPersistentModelIndex
State = QStyle.StateFlag


class FactPainter(QStyledItemDelegate):
    """Paints a fact as a card or as a row. ``cursor`` is the cell with the keyboard focus."""

    def __init__(self, tokens: Tokens, parent: QObject) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self.width = 232
        self.cursor: tuple[int, tuple[str, str]] | None = None
        self.edited: tuple[int, tuple[str, str]] | None = None

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        """The height that the line needs in a panel of this width."""
        return QSize(10, height_of(index.data(Qt.ItemDataRole.UserRole), self.width))

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint one fact."""
        line: TabledFact = index.data(Qt.ItemDataRole.UserRole)
        tokens, rect = self.tokens, QRectF(option.rect)
        painter.save()
        lit = bool(option.state & (State.State_Selected | State.State_MouseOver))
        if option.state & State.State_Selected:
            painter.fillRect(rect, tokens.accs)
        painter.fillRect(QRectF(rect.left(), rect.bottom() - 1, rect.width(), 1), tokens.line)
        painter.translate(rect.topLeft())
        for cell in cells_of(line, self.width):
            here = (index.row(), cell.key)
            if here != self.edited:
                self._cell(painter, line, cell, lit)
            if here == self.cursor:
                painter.setPen(QPen(tokens.acc, 1.5))
                painter.setBrush(Qt.BrushStyle.NoBrush)
                painter.setRenderHint(QPainter.RenderHint.Antialiasing)
                painter.drawRoundedRect(cell.rect.adjusted(-2, -1, 2, 1), 5, 5)
        painter.restore()

    def _cell(self, painter: QPainter, line: TabledFact, cell: Cell, lit: bool) -> None:
        tokens, rect = self.tokens, cell.rect
        if cell.kind == "digit":
            paint_chip(painter, rect, cell.text, "value", tokens, sub=bool(line.sub))
        elif cell.kind == "value":
            self._value(painter, line, cell)
        elif cell.kind == "critical":
            if line.critical or lit:
                colour = tokens.risk if line.critical else tokens.line2
                draw(painter, "warning", rect, colour, tokens.surf)
        elif cell.kind == "more":
            paint_text(painter, rect, cell.text, TextInk(tokens.tx2, 12))
        elif cell.kind == "sub":
            self._with_icon(painter, cell, "layers", TextInk(tokens.acc, 12))
        elif cell.kind == "source":
            told = line.told and not line.source
            said = cell.text or line.measured
            words = said or ("a person says it" if told else HINTS["source"])
            ink = TextInk(tokens.tx2 if said or told else tokens.tx3, 12, mono=bool(said))
            icon = "person" if line.told else "signal"
            self._with_icon(painter, Cell("source", rect, words), icon, ink)
        else:
            self._text(painter, line, cell)

    def _text(self, painter: QPainter, line: TabledFact, cell: Cell) -> None:
        tokens, named = self.tokens, cell.kind == "name"
        words = cell.text or HINTS[cell.kind].format(line.digit + 1)
        mono = cell.kind in ("unit", "age") and bool(cell.text)
        written = tokens.tx if named else tokens.tx2
        ink = TextInk(written if cell.text else tokens.tx3, 13 if named else 12, mono=mono)
        aside = cell.kind in ("unit", "age") and self.width < WIDE
        paint_text(painter, cell.rect, words, ink, right=aside)

    def _with_icon(self, painter: QPainter, cell: Cell, icon: str, ink: TextInk) -> None:
        box = QRectF(cell.rect.left(), cell.rect.center().y() - 6.5, 13, 13)
        draw(painter, icon, box, ink.colour, self.tokens.surf)
        paint_text(painter, cell.rect.adjusted(20, 0, 0, 0), cell.text, ink)

    def _value(self, painter: QPainter, line: TabledFact, cell: Cell) -> None:
        one = next(one for one in line.values if one.text == cell.value)
        rect = cell.rect
        paint_chip(painter, rect, one.text, one.kind, self.tokens)
        if one.failure:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(self.tokens.bad, 1.4))
            painter.drawRoundedRect(rect, RADIUS_CHIP, RADIUS_CHIP)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(self.tokens.bad)
            corner = rect.topRight()
            painter.drawPolygon([corner + QPointF(-6, 0), corner, corner + QPointF(0, 6)])
