"""The table of facts: believed value, sensed value, age, and whether they agree."""

from __future__ import annotations

from collections.abc import Collection

from PySide6.QtCore import (
    QAbstractTableModel,
    QModelIndex,
    QPersistentModelIndex,
    QRectF,
    Qt,
    Signal,
)
from PySide6.QtGui import QColor, QFontMetrics, QKeyEvent, QPainter, QPen, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
    QWidget,
)

from smsl_studio.blueprint.check import FactKey
from smsl_studio.front.views.fact_rows import FactRow
from smsl_studio.front.views.freshness import age_of, age_words, bars
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.chips import paint_chip
from smsl_studio.studio.base.controls import name_parts
from smsl_studio.studio.base.current_cell import CurrentCell
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.theme import RADIUS_CHIP, Tokens, mono_font, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import BLANK

COLUMNS = ("Fact", "Believed", "Sensed", "Age", "  Quality")
WIDTHS = (82, 62, 57, 58)
QUALITY = 120
"""Width of the last column (pixels) that long names may not take."""
ROW = 32
HEADS = 31
"""Height of the column header with the line below it (pixels)."""
Index = QModelIndex | QPersistentModelIndex


class FactsModel(QAbstractTableModel):
    """The rows as a Qt model; ``show`` replaces them and repaints only what changed."""

    def __init__(self, parent: QWidget | None = None, quality: str = COLUMNS[4]) -> None:
        super().__init__(parent)
        self.rows: tuple[FactRow, ...] = ()
        self._heads = (*COLUMNS[:4], quality)

    def show(self, rows: tuple[FactRow, ...]) -> None:
        """Show other rows; the view is told only of rows that changed."""
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
        """The number of rows; a row has no children."""
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The number of columns."""
        return 0 if parent.isValid() else len(COLUMNS)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = 0) -> object:
        """The titles of the columns; for a row its name, for assistive tools."""
        if orientation is Qt.Orientation.Horizontal:
            if role == Qt.ItemDataRole.DisplayRole:
                return self._heads[section]
            if role == Qt.ItemDataRole.TextAlignmentRole:
                right = Qt.AlignmentFlag.AlignRight if section == 3 else Qt.AlignmentFlag.AlignLeft
                return right | Qt.AlignmentFlag.AlignVCenter
        elif role == Qt.ItemDataRole.DisplayRole:
            # The header of rows is hidden, but a screen reader reads it.
            return self.rows[section].name
        return None

    def data(self, index: Index, role: int = 0) -> object:
        """The text, the accessible text or the tooltip of a cell, or the ``FactRow`` itself."""
        row = self.rows[index.row()]
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            age = "" if row.age is None else age_words(row.age)
            sensed = "?" if row.sensed is None else row.sensed
            words = (row.name, row.believed, sensed, age, row.words)[index.column()]
            # A screen reader says "none" for an empty cell.
            return words or (BLANK if role == Qt.ItemDataRole.AccessibleTextRole else "")
        if role == Qt.ItemDataRole.ToolTipRole:
            old = "" if row.age is None else f"; {age_of(row.age, row.limit)}"
            return tip_text(f"{row.name}: {row.words}{old}")
        if role == Qt.ItemDataRole.UserRole:
            return row
        return None


class _FactCells(QStyledItemDelegate):
    """Paints the chips and the bars for age."""

    def __init__(self, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self.chosen: frozenset[FactKey] = frozenset()

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint one cell, or the line of a group over the whole row."""
        row: FactRow = index.data(Qt.ItemDataRole.UserRole)
        room = QRectF(option.rect)
        painter.save()
        if row.key in self.chosen:
            painter.fillRect(room, self.tokens.accs)
        painter.fillRect(QRectF(room.left(), room.bottom() - 1, room.width(), 1), self.tokens.line)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        words = str(index.data(Qt.ItemDataRole.DisplayRole))
        if row.group:
            self._group(painter, room, row)
            painter.restore()
            return
        match index.column():
            case 1 if words and row.chip:
                place = QRectF(room.left(), room.center().y() - 10.5, 20, 20)
                wide = self._chip_wide(painter, words, room)
                place.setWidth(wide)
                paint_chip(painter, place, words, row.chip, self.tokens, sub=row.sub)
            case 1 | 2 if words:
                self._chip(painter, room, words, row, sensed=index.column() == 2)
            case 3:
                painter.setFont(text_font(13))
                self._words(painter, room.adjusted(0, 0, -6, 0), words, self.tokens.tx, right=True)
            case 4:
                self._quality(painter, room, row)
            case _:
                painter.setFont(text_font(13))
                # Names of facts often begin alike, so their middle is left out.
                middle = Qt.TextElideMode.ElideMiddle
                shown = painter.fontMetrics().elidedText(
                    plain_text(words), middle, int(room.width()) - 16
                )
                self._words(painter, room.adjusted(12, 0, 0, 0), shown, self.tokens.tx)
        painter.restore()

    def _group(self, painter: QPainter, room: QRectF, row: FactRow) -> None:
        """Paint the line above the facts of one SB: its name and its active state."""
        painter.fillRect(room.adjusted(0, 0, 0, -1), self.tokens.sunk)
        painter.setFont(text_font(12, 600))
        self._words(painter, room.adjusted(12, 0, 0, 0), row.name, self.tokens.tx)
        wide = painter.fontMetrics().horizontalAdvance(row.name)
        painter.setFont(text_font(12))
        self._words(painter, room.adjusted(12 + wide + 8, 0, -8, 0), row.believed, self.tokens.tx2)

    def _words(
        self, painter: QPainter, room: QRectF, words: str, colour: QColor, right: bool = False
    ) -> None:
        painter.setPen(colour)
        side = Qt.AlignmentFlag.AlignRight if right else Qt.AlignmentFlag.AlignLeft
        shown = painter.fontMetrics().elidedText(
            plain_text(words), Qt.TextElideMode.ElideRight, int(room.width())
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
        wide = self._chip_wide(painter, words, room)
        box = QRectF(room.left(), room.center().y() - 10.5, wide, 20)
        dashed = (
            Qt.PenStyle.DashLine if sensed and row.quality == "unknown" else Qt.PenStyle.SolidLine
        )
        painter.setPen(QPen(line, 1.2, dashed))
        painter.setBrush(fill)
        painter.drawRoundedRect(box, RADIUS_CHIP, RADIUS_CHIP)
        painter.setPen(ink)
        shown = painter.fontMetrics().elidedText(
            plain_text(words), Qt.TextElideMode.ElideMiddle, int(box.width() - 6)
        )
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, shown)

    @staticmethod
    def _chip_wide(painter: QPainter, words: str, room: QRectF) -> float:
        painter.setFont(mono_font(12, 600))
        width = max(20.0, painter.fontMetrics().horizontalAdvance(words) + 10.0)
        return min(width, room.width() - 12)

    def _quality(self, painter: QPainter, room: QRectF, row: FactRow) -> None:
        t = self.tokens
        colour = {"agrees": t.ok, "differs": t.bad, "unknown": t.unk, "transit": t.acc}.get(
            row.quality, t.tx3
        )
        ink = t.tx if row.quality in ("agrees", "believed") else colour
        room = room.adjusted(8, 0, -4, 0)
        sign = "arrow" if row.quality == "transit" else "layers" if row.sub else ""
        known = row.quality in ("agrees", "differs")
        if sign:
            draw(painter, sign, QRectF(room.left(), room.center().y() - 7, 14, 14), colour, t.surf)
        elif row.age is not None or not known:
            self._bars(painter, room, colour, bars(row.age, row.limit) if known else 0)
        painter.setFont(text_font(13))
        after = 20 if sign else 0 if known and row.age is None else 31
        self._words(painter, room.adjusted(after, 0, 0, 0), row.words, ink)

    def _bars(self, painter: QPainter, room: QRectF, colour: QColor, filled: int) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        for bar in range(4):
            height = 4 + 2 * bar
            painter.setBrush(colour if bar < filled else self.tokens.line2)
            left = room.left() + 6 * bar
            painter.drawRoundedRect(QRectF(left, room.center().y() + 5 - height, 4, height), 1, 1)


class FactsTable(QTableView):
    """The table view; ``show_rows`` replaces what it shows."""

    chosen = Signal(object)
    """FactKey: a person wants to see what this fact rests on, by a click on a chip or Enter."""

    named = Signal(object)
    """FactKey: a person clicked on the name of this fact."""

    def __init__(
        self, tokens: Tokens, parent: QWidget | None = None, quality: str = COLUMNS[4]
    ) -> None:
        super().__init__(parent)
        self.facts = FactsModel(self, quality)
        self._names: tuple[str, ...] = ()
        self.setModel(self.facts)
        self._cells = _FactCells(tokens, self)
        self.setItemDelegate(self._cells)
        self.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        # Cells cannot be selected, so Tab goes on to the next widget and not from cell to cell.
        self.setTabKeyNavigation(False)
        self.setShowGrid(False)
        self.setFrameShape(QTableView.Shape.NoFrame)
        name_parts(self)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(ROW)
        self.verticalHeader().setMinimumSectionSize(24)
        header = self.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        header.setStretchLastSection(True)
        header.setHighlightSections(False)
        header.setFixedHeight(30)
        header.setMinimumSectionSize(40)
        for column, width in enumerate(WIDTHS):
            header.resizeSection(column, width)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setMaximumHeight(HEADS)
        self.setAccessibleName("Facts: believed and sensed")
        FocusLine(self)
        self._cell = CurrentCell(self)
        self.clicked.connect(self._tell_name)
        self.clicked.connect(lambda index: self._choose(index, (1, 2)))

    def show_rows(self, rows: tuple[FactRow, ...]) -> None:
        """Show other rows; the line of a group spans all columns."""
        grouped = [row.group for row in rows]
        anew = grouped != [row.group for row in self.facts.rows]
        self.facts.show(rows)
        if anew:
            self.clearSpans()
            for at, group in enumerate(grouped):
                self.setRowHeight(at, 28 if group else ROW)
                if group:
                    self.setSpan(at, 0, 1, len(COLUMNS))
            self.setMaximumHeight(sum(28 if group else ROW for group in grouped) + HEADS)
        names = tuple(row.name for row in rows if not row.group)
        if names != self._names:
            self._names = names
            self._fit_names()

    def show_chosen(self, keys: frozenset[FactKey]) -> None:
        """Light the rows of these facts."""
        if keys != self._cells.chosen:
            self._cells.chosen = keys
            self.viewport().update()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter chooses the fact. Letters and digits may be commands of the page."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and self._cell.index.isValid():
            self._choose(self._cell.index, range(len(COLUMNS)))
        elif event.text().isprintable() and event.text().strip():
            event.ignore()
        else:
            super().keyPressEvent(event)

    def _tell_name(self, index: QModelIndex) -> None:
        key = self.facts.rows[index.row()].key
        if key is not None and not index.column():
            self.named.emit(key)

    def _choose(self, index: QModelIndex, columns: Collection[int]) -> None:
        """Tell which fact was chosen, if the cell is in one of these columns."""
        key = self.facts.rows[index.row()].key
        if key is not None and index.column() in columns:
            self.chosen.emit(key)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the name column into the new width."""
        super().resizeEvent(event)
        self._fit_names()

    def _fit_names(self) -> None:
        """Give the name column the width it needs, as far as the other columns allow."""
        metrics = QFontMetrics(text_font(13))
        needed = max((metrics.horizontalAdvance(name) for name in self._names), default=0) + 26
        spare = self.viewport().width() - sum(WIDTHS[1:]) - QUALITY
        self.horizontalHeader().resizeSection(0, max(WIDTHS[0], min(needed, spare)))

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._cells.tokens = tokens
        self.viewport().update()
