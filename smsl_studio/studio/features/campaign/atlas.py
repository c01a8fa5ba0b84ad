"""The table of a campaign: a row an operation, a column a fault, and the shares of both."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import (
    QAbstractTableModel,
    QModelIndex,
    QPersistentModelIndex,
    QRectF,
    Qt,
    Signal,
)
from PySide6.QtGui import QPainter, QPen, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
    QWidget,
)

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.campaign_tally import CampaignCell, CampaignShare, CampaignTally, share_of
from smsl_studio.front.views.states import short_name
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import name_parts
from smsl_studio.studio.base.current_cell import CurrentCell
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import RADIUS_CHIP, Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.campaign.marks import (
    TICKS,
    counts_words,
    paint_counts,
    paint_share,
    paint_ticks,
    paint_waiting,
)

ROW, TOTALS, HEAD = 24, 46, 44
NAME, COLUMN, SHARE = 240, 74, 176
LEAST = 172, 70, 124
"""The same where the page has less room (pixels)."""
ALL_EDGES, UNDISTURBED = "All operations", "No fault"
Index = QModelIndex | QPersistentModelIndex


def percent(share: CampaignShare) -> str:
    """Return a share in words, with its interval."""
    if not share.runs:
        return share.nothing
    between = f"{100 * share.low:.0f} to {100 * share.high:.0f} %"
    return f"{100 * share.reached / share.runs:.1f} %, 95 % interval {between}"


class AtlasModel(QAbstractTableModel):
    """A tally as a Qt model. The last row has all operations, the last column all faults."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.tally = CampaignTally()
        self._names: dict[str, tuple[str, str]] = {}

    @property
    def stale(self) -> bool:
        """Whether the tally has other rows than when it was shown."""
        return len(self._names) != len(self.tally.edges)

    def show(self, tally: CampaignTally, blueprint: Blueprint) -> None:
        """Show another tally, or the same one with more runs."""
        if tally is self.tally and not self.stale:
            if tally.cells:
                last = self.index(self.rowCount() - 1, self.columnCount() - 1)
                self.dataChanged.emit(self.index(0, 0), last)
            return
        self.beginResetModel()
        self.tally = tally
        self._names = {edge: names_of(edge, blueprint) for edge in tally.edges}
        self.endResetModel()

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The operations, and all of them."""
        return 0 if parent.isValid() or not self.tally.cells else len(self.tally.edges) + 1

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The name, the faults, and the share."""
        return 0 if parent.isValid() or not self.tally.cells else len(self.tally.faults) + 2

    def cell(self, index: Index) -> CampaignCell | None:
        """The cell of one operation and one fault; None for any other place."""
        edges, faults = self.tally.edges, self.tally.faults
        at, column = index.row(), index.column() - 1
        if not (0 <= at < len(edges) and 0 <= column < len(faults)):
            return None
        return self.tally.cell(edges[at], faults[column])

    def share(self, index: Index) -> CampaignShare | None:
        """The share at the end of a row or below a column; None for any other place."""
        edges, faults = self.tally.edges, self.tally.faults
        at, column = index.row(), index.column() - 1
        if column == len(faults):
            cells = self.tally.cells
            return self.tally.of_edge(edges[at]) if at < len(edges) else share_of(cells)
        if at == len(edges) and column >= 0:
            return self.tally.of_fault(faults[column])
        return None

    def names(self, at: int) -> tuple[str, str]:
        """The name of an operation, and from which state to which."""
        edges = self.tally.edges
        return self._names[edges[at]] if at < len(edges) else (ALL_EDGES, "")

    def fault(self, column: int) -> str:
        """The words of a column."""
        name = self.tally.faults[column - 1]
        return plain_text(name.replace("_", " ")) if name else UNDISTURBED

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = 0) -> object:
        """The words of the columns; for a row its name, for assistive tools."""
        if role != Qt.ItemDataRole.DisplayRole:
            return None
        if orientation is Qt.Orientation.Vertical:
            return " ".join(self.names(section)).strip()
        if section == 0:
            return "Operation, from and to"
        if section == self.columnCount() - 1:
            return "Reached 0–100 %\n95 % interval"
        return self.fault(section).replace(" ", "\n", 1)

    def data(self, index: Index, role: int = 0) -> object:
        """The words of a place."""
        if role not in (
            Qt.ItemDataRole.DisplayRole,
            Qt.ItemDataRole.AccessibleTextRole,
            Qt.ItemDataRole.ToolTipRole,
        ):
            return None
        name = plain_text(" ".join(self.names(index.row())).strip())
        said = self._said(index)
        if role == Qt.ItemDataRole.DisplayRole:
            return name if index.column() == 0 else said
        column = index.column()
        under = self.fault(column) if 0 < column < self.columnCount() - 1 else ""
        words = ", ".join(one for one in (name, under, said) if one)
        return tip_text(words) if role == Qt.ItemDataRole.ToolTipRole else words

    def _said(self, index: Index) -> str:
        if index.column() == 0:
            return ""
        share = self.share(index)
        if share is not None:
            return percent(share)
        cell = self.cell(index)
        if cell is None:
            return "cannot occur here"
        if cell.runs < cell.seeds:
            return f"{cell.runs:,} of {cell.seeds:,} runs" if cell.runs else "not yet run"
        told = cell.foreseen
        other = f", foreseen {told.end}" if told is not None and cell.differs else ""
        return f"{counts_words(cell.counts)}{other}"

    @property
    def differing(self) -> tuple[CampaignCell, ...]:
        """The cells that ended otherwise than foreseen."""
        return tuple(one for one in self.tally.cells if one.differs)


def names_of(edge: str, blueprint: Blueprint) -> tuple[str, str]:
    """Return the name of an operation, and the short names of its states."""
    if not edge:
        return "Whole run", ""
    address = Address(*Address.split(edge))
    branch = blueprint.branches.get(address.branch)
    if branch is None or address.operation not in branch.table.get(address.state, {}):
        return edge, ""
    target = branch.table[address.state][address.operation]
    several = f"{address.branch} " if len(blueprint.branches) > 1 else ""
    states = f"{short_name(branch, address.state)} → {short_name(branch, target)}"
    return f"{several}{address.operation}", states


class _AtlasCells(QStyledItemDelegate):
    """Paints names, counts and shares."""

    def __init__(self, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.tokens, self.pale = tokens, False
        self.only = False
        """Whether cells that ended as foreseen are dimmed."""

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint one place."""
        model: Any = index.model()
        assert isinstance(model, AtlasModel)
        tokens, room = self.tokens, QRectF(option.rect)
        painter.save()
        if self.pale:
            painter.setOpacity(0.45)
        last = index.row() == model.rowCount() - 1
        if option.state & QStyle.StateFlag.State_Selected:
            painter.fillRect(room, tokens.accs)
        elif last:
            painter.fillRect(room, tokens.sunk)
        painter.fillRect(QRectF(room.left(), room.bottom() - 1, room.width(), 1), tokens.line)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        share, column = model.share(index), index.column()
        if column == 0:
            self._name(painter, room, model, index.row(), last)
        elif share is not None:
            self._share(painter, room, share, wide=column == model.columnCount() - 1)
        else:
            box = room.adjusted(3, 3, -3, -4)
            cell = model.cell(index)
            if self.only and (cell is None or not cell.differs):
                painter.setOpacity(0.2)
            ticks = cell is not None and cell.runs >= cell.seeds and cell.foreseen is not None
            self._cell(painter, box.adjusted(0, 0, -TICKS if ticks else 0, 0), cell)
            if ticks and cell is not None:
                paint_ticks(painter, box, cell.differs, tokens)
            if option.state & QStyle.StateFlag.State_Selected:
                painter.setPen(QPen(tokens.acc, 2))
                painter.setBrush(Qt.BrushStyle.NoBrush)
                painter.drawRoundedRect(box.adjusted(-1, -1, 1, 1), RADIUS_CHIP, RADIUS_CHIP)
        painter.restore()

    def _name(
        self, painter: QPainter, room: QRectF, model: AtlasModel, at: int, last: bool
    ) -> None:
        name, states = model.names(at)
        ink = TextInk(self.tokens.tx, 12, 600 if last else 400)
        inner = room.adjusted(16, 0, -6, 0)
        half = inner if not states else inner.adjusted(0, 0, -inner.width() / 2, 0)
        paint_text(painter, half, name, ink)
        if states:
            beside = inner.adjusted(inner.width() / 2, 0, 0, 0)
            paint_text(painter, beside, states, TextInk(self.tokens.tx2, 12, mono=True))

    def _share(self, painter: QPainter, room: QRectF, share: CampaignShare, wide: bool) -> None:
        if not wide:
            inner = room.adjusted(8, 0, -8, 0)
            if share.runs:
                words = f"{100 * share.reached / share.runs:.1f} %"
                ink = TextInk(self.tokens.tx, 12, 600)
                paint_text(painter, inner.adjusted(0, 2, 0, -28), words, ink)
                count = TextInk(self.tokens.tx2, 11)
                paint_text(painter, inner.adjusted(0, 30, 0, -2), f"n {share.runs:,}", count)
            paint_share(painter, inner, share, self.tokens)
            return
        inner = room.adjusted(10, 0, -14, 0)
        if not share.runs:
            paint_text(painter, inner, share.nothing, TextInk(self.tokens.tx2, 12))
            return
        words = f"{100 * share.reached / share.runs:.1f} %"
        paint_text(painter, inner, words, TextInk(self.tokens.tx, 12), right=True)
        paint_share(painter, inner.adjusted(0, 0, -58, 0), share, self.tokens)

    def _cell(self, painter: QPainter, box: QRectF, cell: CampaignCell | None) -> None:
        if cell is None:
            ink = TextInk(self.tokens.tx3, 12)
            paint_text(painter, box.adjusted(box.width() / 2 - 6, 0, 0, 0), "—", ink)
        elif cell.runs < cell.seeds:
            words = f"{cell.runs:,} of {cell.seeds:,}" if cell.runs else ""
            paint_waiting(painter, box, words, self.tokens)
        else:
            paint_counts(painter, box, cell.counts, self.tokens)


class AtlasTable(QTableView):
    """The table view. Arrows or a click choose a cell."""

    cell_chosen = Signal(object)
    """The chosen CampaignCell, or None."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.atlas = AtlasModel(self)
        self.setModel(self.atlas)
        self._cells = _AtlasCells(tokens, self)
        self.setItemDelegate(self._cells)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setTabKeyNavigation(False)
        self.setShowGrid(False)
        self.setFrameShape(QTableView.Shape.NoFrame)
        self.setProperty("role", "table")
        self.setVerticalScrollMode(QTableView.ScrollMode.ScrollPerPixel)
        self.setHorizontalScrollMode(QTableView.ScrollMode.ScrollPerPixel)
        self.setAccessibleName("Table of the campaign: operations and faults")
        self.current = CurrentCell(self)
        self.selectionModel().currentChanged.connect(lambda *_: self._tell())
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(ROW)
        self.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        header = self.horizontalHeader()
        header.setFixedHeight(HEAD)
        header.setHighlightSections(False)
        header.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        FocusLine(self)
        name_parts(self)

    def keyboardSearch(self, search: str, /) -> None:
        """Do nothing: letters are keys of the window."""

    @property
    def chosen(self) -> CampaignCell | None:
        """The chosen cell, or None."""
        index = self.current.index
        return self.atlas.cell(index) if index.isValid() else None

    def choose(self, edge: str, fault: str) -> None:
        """Choose a cell by its operation and its fault."""
        tally = self.atlas.tally
        if edge in tally.edges and fault in tally.faults:
            at, column = tally.edges.index(edge), tally.faults.index(fault) + 1
            self.current.choose(self.atlas.index(at, column))
            self._tell()

    def show_tally(self, tally: CampaignTally, blueprint: Blueprint) -> None:
        """Show a tally. The chosen cell stays chosen while it is there."""
        before = self.chosen
        again = tally is not self.atlas.tally or self.atlas.stale
        self.atlas.show(tally, blueprint)
        if again and tally.cells:
            self.setRowHeight(self.atlas.rowCount() - 1, TOTALS)
        if again and before is not None:
            self.choose(before.edge, before.fault)
        if again or self.horizontalHeader().sectionSize(0) < NAME // 2:
            self._fit()

    def show_only(self, only: bool) -> None:
        """Show, with ``only``, the cells alone that ended otherwise than foreseen."""
        atlas = self.atlas
        self._cells.only = only
        kept = {one.edge for one in atlas.differing} if only else set(atlas.tally.edges)
        for at, edge in enumerate(atlas.tally.edges):
            if self.isRowHidden(at) is (edge in kept):
                self.setRowHidden(at, edge not in kept)
        self.viewport().update()

    def show_pale(self, pale: bool) -> None:
        """Dim everything, because it is about another version."""
        self._cells.pale = pale
        self.viewport().update()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._cells.tokens = tokens
        self.viewport().update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Distribute the new width among the columns."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        """Give the cells their width, and to the names and the shares what is left."""
        count = self.atlas.columnCount()
        if not count:
            return
        header = self.horizontalHeader()
        faults = count - 2
        wide = self.viewport().width()
        usual = NAME, COLUMN, SHARE
        name, least, share = usual if wide >= NAME + COLUMN * faults + SHARE else LEAST
        room = wide - name - share
        cell = max(least, min(room // max(faults, 1), 2 * COLUMN))
        spare = max(0, room - cell * faults)
        header.resizeSection(0, name + spare // 2)
        for column in range(1, faults + 1):
            header.resizeSection(column, cell)
        header.resizeSection(count - 1, share + spare - spare // 2)

    def _tell(self) -> None:
        self.cell_chosen.emit(self.chosen)
