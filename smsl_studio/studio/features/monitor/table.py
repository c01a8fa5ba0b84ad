"""The table of the monitor page: a row for each source of each fact."""

from __future__ import annotations

from PySide6.QtCore import (
    QAbstractTableModel,
    QModelIndex,
    QPersistentModelIndex,
    QPoint,
    QRectF,
    Qt,
    Signal,
)
from PySide6.QtGui import QColor, QFontMetrics, QPainter, QPen, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
    QWidget,
)

from smsl_studio.front.views.monitor_rows import (
    BELIEVED,
    COLUMNS,
    CONFLICT,
    FACT,
    FIGURES,
    GROUP,
    KNOWN,
    SOURCE,
    UNKNOWN,
    MonitorRow,
)
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import name_parts
from smsl_studio.studio.base.current_cell import CurrentCell
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import RADIUS_CHIP, Tokens, mono_font, text_font
from smsl_studio.studio.base.tips import tip_text

ROW, LINE_OF_GROUP = 30, 28
WIDTHS = (150, 150, 48, 200, 58, 62, 66, 74, 44, 84)
NAME, FROM, VALUE, QUALITY, DISTURBED = 0, 1, 2, 3, 9
LEAST_NAME, LEAST_QUALITY = 100, 178
INSET = {NAME: 12, DISTURBED: 18}
"""Pixels at the left of the words of a column."""
Index = QModelIndex | QPersistentModelIndex


class MonitorModel(QAbstractTableModel):
    """The rows as a Qt model; ``show`` reports only cells that changed."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.rows: tuple[MonitorRow, ...] = ()

    def show(self, rows: tuple[MonitorRow, ...]) -> bool:
        """Replace the rows; returns whether the list of rows changed, and not only their cells."""
        if [row.key for row in rows] != [row.key for row in self.rows]:
            self.beginResetModel()
            self.rows = rows
            self.endResetModel()
            return True
        before, self.rows = self.rows, rows
        for at, (old, new) in enumerate(zip(before, rows, strict=True)):
            if old == new:
                continue
            whole = old.standing != new.standing
            for column, (was, is_now) in enumerate(zip(old.cells, new.cells, strict=True)):
                if whole or was != is_now:
                    cell = self.index(at, column)
                    self.dataChanged.emit(cell, cell)
        return False

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The number of rows; a row has no children."""
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The number of columns."""
        return 0 if parent.isValid() else len(COLUMNS)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = 0) -> object:
        """The titles of the columns; for a row its words, for assistive tools."""
        if orientation is Qt.Orientation.Horizontal:
            if role == Qt.ItemDataRole.DisplayRole:
                return f"  {COLUMNS[section]}" if section == DISTURBED else COLUMNS[section]
            if role == Qt.ItemDataRole.TextAlignmentRole:
                side = Qt.AlignmentFlag
                across = side.AlignRight if section in FIGURES else side.AlignLeft
                return across | side.AlignVCenter
        elif role == Qt.ItemDataRole.DisplayRole:
            # The header of rows is hidden, but a screen reader reads it.
            return self.rows[section].spoken
        return None

    def data(self, index: Index, role: int = 0) -> object:
        """The text, the accessible text or the tooltip of a cell, or the ``MonitorRow`` itself."""
        row = self.rows[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            return row.cells[index.column()]
        if role == Qt.ItemDataRole.AccessibleTextRole:
            return row.spoken
        if role == Qt.ItemDataRole.ToolTipRole:
            return tip_text(row.tip)
        return row if role == Qt.ItemDataRole.UserRole else None


class _MonitorCells(QStyledItemDelegate):
    """Paints chips, words and figures."""

    def __init__(self, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.tokens = tokens

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint one cell."""
        row: MonitorRow = index.data(Qt.ItemDataRole.UserRole)
        tokens, room, column = self.tokens, QRectF(option.rect), index.column()
        words = row.cells[column]
        painter.save()
        chosen = bool(option.state & QStyle.StateFlag.State_Selected)
        if chosen:
            painter.fillRect(room, tokens.accs)
        elif row.kind == GROUP:
            painter.fillRect(room, tokens.sunk)
        painter.fillRect(QRectF(room.left(), room.bottom() - 1, room.width(), 1), tokens.line)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        inner = room.adjusted(INSET.get(column, 0), 0, -6, 0)
        if row.kind == GROUP:
            self._group(painter, inner, row, column)
        elif column == VALUE and words:
            self._chip(painter, inner, words, row.standing)
        elif column == QUALITY:
            self._quality(painter, inner, row)
        elif words:
            self._words(painter, inner, row, column)
        painter.restore()

    def _group(self, painter: QPainter, room: QRectF, row: MonitorRow, column: int) -> None:
        if column == NAME:
            paint_text(painter, room, row.cells[NAME], TextInk(self.tokens.tx, 12, 600))
        elif column == FROM:
            believed = room.adjusted(0, 0, -room.width() / 2, 0)
            wide = paint_text(painter, believed, row.cells[FROM], TextInk(self.tokens.tx2, 12))
            known = row.standing == KNOWN
            ink = TextInk(self.tokens.tx2 if known else self._colour(row.standing), 12)
            paint_text(painter, room.adjusted(wide + 16, 0, 0, 0), row.cells[QUALITY], ink)

    def _words(self, painter: QPainter, room: QRectF, row: MonitorRow, column: int) -> None:
        tokens = self.tokens
        if column in FIGURES:
            paint_text(painter, room, row.cells[column], TextInk(tokens.tx), right=True)
        elif column == FROM:
            inset = 12 if row.kind == SOURCE else 0
            mono = row.kind == SOURCE or "," not in row.cells[FROM]
            ink = TextInk(tokens.tx2 if row.kind == FACT else tokens.tx, 12, mono=mono)
            paint_text(painter, room.adjusted(inset, 0, 0, 0), row.cells[FROM], ink)
        elif column == DISTURBED:
            paint_text(painter, room, row.cells[column], TextInk(tokens.risk, 12, 500))
        else:
            paint_text(painter, room, row.cells[column], TextInk(tokens.tx))

    def _colour(self, standing: str) -> QColor:
        t = self.tokens
        return {KNOWN: t.ok, UNKNOWN: t.unk, CONFLICT: t.bad, BELIEVED: t.tx3}[standing]

    def _chip(self, painter: QPainter, room: QRectF, words: str, standing: str) -> None:
        t = self.tokens
        fill = {KNOWN: t.oks, UNKNOWN: t.unks, CONFLICT: t.bads, BELIEVED: t.sunk}[standing]
        ink = self._colour(standing)
        painter.setFont(mono_font(12, 600))
        wide = max(20.0, painter.fontMetrics().horizontalAdvance(words) + 10.0)
        box = QRectF(room.left(), room.center().y() - 10, min(wide, room.width()), 20)
        style = Qt.PenStyle
        dashed = style.DashLine if standing == UNKNOWN else style.SolidLine
        painter.setPen(QPen(t.sunk if standing == BELIEVED else ink, 1.2, dashed))
        painter.setBrush(fill)
        painter.drawRoundedRect(box, RADIUS_CHIP, RADIUS_CHIP)
        painter.setPen(ink)
        shown = painter.fontMetrics().elidedText(
            plain_text(words), Qt.TextElideMode.ElideMiddle, int(box.width() - 6)
        )
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, shown)

    def _quality(self, painter: QPainter, room: QRectF, row: MonitorRow) -> None:
        t = self.tokens
        ink = t.tx if row.standing == KNOWN else self._colour(row.standing)
        end = Qt.TextElideMode.ElideRight
        paint_text(painter, room, row.cells[QUALITY], TextInk(ink), elide=end)


class MonitorTable(QTableView):
    """The table view.

    Arrows or a click select a row; Enter or a right click asks to disturb its sensor.
    """

    disturb_wanted = Signal(object, object)
    """(row, point of the screen): the person wants to disturb its sensor."""
    row_chosen = Signal(object)
    """The selected row, or None."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.model_of_rows = MonitorModel(self)
        self.setModel(self.model_of_rows)
        self._cells = _MonitorCells(tokens, self)
        self.setItemDelegate(self._cells)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setTabKeyNavigation(False)
        self.setShowGrid(False)
        self.setFrameShape(QTableView.Shape.NoFrame)
        self.setVerticalScrollMode(QTableView.ScrollMode.ScrollPerPixel)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.customContextMenuRequested.connect(self._asked)
        self.activated.connect(lambda index: self._ask(self.visualRect(index).bottomLeft()))
        self.cell = CurrentCell(self)
        self.selectionModel().currentRowChanged.connect(self._chosen)
        name_parts(self)
        self.verticalHeader().hide()
        self.verticalHeader().setMinimumSectionSize(24)
        self.verticalHeader().setDefaultSectionSize(ROW)
        header = self.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        header.setHighlightSections(False)
        header.setFixedHeight(30)
        header.setMinimumSectionSize(40)
        for column, width in enumerate(WIDTHS):
            header.resizeSection(column, width)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAsNeeded)
        self.setAccessibleName("Sensors: what each says of each fact")

    @property
    def chosen(self) -> MonitorRow | None:
        """The selected row, or None."""
        at = self.cell.index.row()
        rows = self.model_of_rows.rows
        return rows[at] if 0 <= at < len(rows) else None

    def choose(self, key: tuple[str, ...]) -> None:
        """Select the row with this key, if there is one."""
        for at, row in enumerate(self.model_of_rows.rows):
            if row.key == key:
                self.cell.choose(self.model_of_rows.index(at, 0))
                return

    def show_chosen(self) -> None:
        """Scroll to the selected row."""
        self.scrollTo(self.cell.index)

    def show_rows(self, rows: tuple[MonitorRow, ...]) -> None:
        """Show these rows; the selected one stays selected while it exists."""
        kept = self.chosen
        if not self.model_of_rows.show(rows):
            return
        self.clearSpans()
        for at, row in enumerate(rows):
            self.setRowHeight(at, LINE_OF_GROUP if row.kind == GROUP else ROW)
            if row.kind == GROUP:
                self.setSpan(at, FROM, 1, len(COLUMNS) - FROM)
            elif not any(row.cells[FIGURES.start :]):
                self.setSpan(at, QUALITY, 1, len(COLUMNS) - QUALITY)
            if kept is not None and row.key == kept.key:
                self.cell.choose(self.model_of_rows.index(at, 0))
        self._fit()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._cells.tokens = tokens
        self.viewport().update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Distribute the new width among the columns."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        """Give names and sources the width they need, and quality what remains."""
        header = self.horizontalHeader()
        rows = self.model_of_rows.rows
        room = self.viewport().width() - sum(WIDTHS[2:3]) - sum(WIDTHS[4:])
        metrics = QFontMetrics(text_font(13)), QFontMetrics(mono_font(12))
        wide = [
            max((metrics[at].horizontalAdvance(row.cells[at]) + extra for row in rows), default=0)
            for at, extra in ((NAME, 24), (FROM, 28))
        ]
        spare = max(2 * LEAST_NAME, room - LEAST_QUALITY)
        name = max(LEAST_NAME, min(wide[0], spare // 2, WIDTHS[0] * 2))
        source = max(LEAST_NAME, min(wide[1], spare - name, WIDTHS[1] * 2))
        header.resizeSection(NAME, name)
        header.resizeSection(FROM, source)
        header.resizeSection(QUALITY, max(LEAST_QUALITY, room - name - source))

    def _chosen(self) -> None:
        self.row_chosen.emit(self.chosen)

    def _asked(self, at: QPoint) -> None:
        index = self.indexAt(at)
        if index.isValid():
            self.cell.choose(index)
            self._ask(at)

    def _ask(self, at: QPoint) -> None:
        if self.chosen is not None:
            self.disturb_wanted.emit(self.chosen, self.viewport().mapToGlobal(at))
