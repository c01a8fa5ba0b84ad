"""Facts: what is believed, what is sensed, how old it is, and whether they agree."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
    QWidget,
)

from smsl_studio.studio.theme import RADIUS_CHIP, Tokens, mono_font, text_font

COLUMNS = ("Fact", "Believed", "Sensed", "Age", "Quality")
Index = QModelIndex | QPersistentModelIndex


@dataclass(frozen=True)
class FactRow:
    """One fact of one SB. ``sensed`` None: unknown; ``quality`` is agrees, differs, unknown,
    transit or believed (nobody senses it)."""

    name: str
    believed: str
    sensed: str | None
    age: float | None
    quality: str
    words: str
    group: bool = False


class FactsModel(QAbstractTableModel):
    """The rows as a Qt model; ``show`` replaces them and repaints only what changed."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.rows: tuple[FactRow, ...] = ()

    def show(self, rows: tuple[FactRow, ...]) -> None:
        if len(rows) != len(self.rows):
            self.beginResetModel()
            self.rows = rows
            self.endResetModel()
            return
        before, self.rows = self.rows, rows
        for row, (old, new) in enumerate(zip(before, rows, strict=True)):
            if old != new:
                self.dataChanged.emit(self.index(row, 0), self.index(row, len(COLUMNS) - 1))

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        return 0 if parent.isValid() else len(COLUMNS)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = 0) -> object:
        if orientation is Qt.Orientation.Horizontal:
            if role == Qt.ItemDataRole.DisplayRole:
                return COLUMNS[section]
            if role == Qt.ItemDataRole.TextAlignmentRole:
                right = Qt.AlignmentFlag.AlignRight if section == 3 else Qt.AlignmentFlag.AlignLeft
                return right | Qt.AlignmentFlag.AlignVCenter
        return None

    def data(self, index: Index, role: int = 0) -> object:
        row = self.rows[index.row()]
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            age = "" if row.age is None else age_words(row.age)
            sensed = "?" if row.sensed is None else row.sensed
            return (row.name, row.believed, sensed, age, row.words)[index.column()]
        if role == Qt.ItemDataRole.ToolTipRole:
            return f"{row.name}: {row.words}"
        if role == Qt.ItemDataRole.UserRole:
            return row
        return None


class _Cells(QStyledItemDelegate):
    """Paints chips and the bars of quality."""

    def __init__(self, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.tokens = tokens

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        row: FactRow = index.data(Qt.ItemDataRole.UserRole)
        room = QRectF(option.rect)
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        words = str(index.data(Qt.ItemDataRole.DisplayRole))
        match index.column():
            case 1 | 2 if words:
                self._chip(painter, room, words, row, sensed=index.column() == 2)
            case 3:
                self._words(painter, room.adjusted(0, 0, -12, 0), words, self.tokens.tx, right=True)
            case 4:
                self._quality(painter, room, row)
            case _:
                painter.setFont(text_font(13, 600 if row.group else 400))
                self._words(painter, room.adjusted(12, 0, 0, 0), words, self.tokens.tx)
        painter.restore()

    def _words(
        self, painter: QPainter, room: QRectF, words: str, colour: QColor, right: bool = False
    ) -> None:
        painter.setPen(colour)
        side = Qt.AlignmentFlag.AlignRight if right else Qt.AlignmentFlag.AlignLeft
        shown = painter.fontMetrics().elidedText(
            words, Qt.TextElideMode.ElideRight, int(room.width())
        )
        painter.drawText(room, side | Qt.AlignmentFlag.AlignVCenter, shown)

    def _chip(
        self, painter: QPainter, room: QRectF, words: str, row: FactRow, sensed: bool
    ) -> None:
        t = self.tokens
        fill, line, ink = t.sunk, t.sunk, t.tx
        if sensed:
            fill, line, ink = {
                "agrees": (t.oks, t.ok, t.ok),
                "differs": (t.bads, t.bad, t.bad),
                "unknown": (t.unks, t.unk, t.unk),
                "transit": (t.accs, t.acc, t.acc),
            }.get(row.quality, (t.sunk, t.sunk, t.tx3))
        painter.setFont(mono_font(12, 600))
        width = max(20.0, painter.fontMetrics().horizontalAdvance(words) + 10.0)
        box = QRectF(room.left() + 8, room.center().y() - 10, min(width, room.width() - 12), 20)
        dashed = (
            Qt.PenStyle.DashLine if sensed and row.quality == "unknown" else Qt.PenStyle.SolidLine
        )
        painter.setPen(QPen(line, 1.2, dashed))
        painter.setBrush(fill)
        painter.drawRoundedRect(box, RADIUS_CHIP, RADIUS_CHIP)
        painter.setPen(ink)
        shown = painter.fontMetrics().elidedText(
            words, Qt.TextElideMode.ElideMiddle, int(box.width() - 6)
        )
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, shown)

    def _quality(self, painter: QPainter, room: QRectF, row: FactRow) -> None:
        t = self.tokens
        colour = {"agrees": t.ok, "differs": t.bad, "unknown": t.unk, "transit": t.acc}.get(
            row.quality, t.tx3
        )
        bars = {"agrees": 4, "transit": 4, "differs": 4, "unknown": 0}.get(row.quality, 0)
        painter.setPen(Qt.PenStyle.NoPen)
        for bar in range(4):
            height = 4 + 2 * bar
            painter.setBrush(colour if bar < bars else t.line2)
            left = room.left() + 8 + 6 * bar
            painter.drawRoundedRect(QRectF(left, room.center().y() + 5 - height, 4, height), 1, 1)
        ink = t.tx if row.quality in ("agrees", "believed") else colour
        painter.setFont(text_font(13))
        self._words(painter, room.adjusted(38, 0, -4, 0), row.words, ink)


class FactsTable(QTableView):
    """The table of the run pane; ``show_rows`` replaces what it shows."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.facts = FactsModel(self)
        self.setModel(self.facts)
        self._cells = _Cells(tokens, self)
        self.setItemDelegate(self._cells)
        self.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setShowGrid(False)
        self.setFrameShape(QTableView.Shape.NoFrame)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(36)
        header = self.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        header.setStretchLastSection(True)
        header.setHighlightSections(False)
        for column, width in enumerate((96, 72, 68, 70)):
            header.resizeSection(column, width)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Interactive)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setAccessibleName("Facts: believed and sensed")

    def show_rows(self, rows: tuple[FactRow, ...]) -> None:
        self.facts.show(rows)

    def set_tokens(self, tokens: Tokens) -> None:
        self._cells.tokens = tokens
        self.viewport().update()


def age_words(seconds: float) -> str:
    """An age for people: ms below a second, then s."""
    return f"{seconds * 1000:.0f} ms" if seconds < 0.9995 else f"{seconds:.1f} s"
