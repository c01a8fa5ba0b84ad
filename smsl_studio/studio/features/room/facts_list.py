"""The facts that nodes tell: when they hold, on which nodes they rest, and who needs them."""

from __future__ import annotations

from PySide6.QtCore import (
    QAbstractTableModel,
    QModelIndex,
    QPersistentModelIndex,
    QRectF,
    Qt,
    Signal,
)
from PySide6.QtGui import QPainter, QPen
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
    QWidget,
)

from smsl_studio.front.views.room_view import RoomFact, age_words
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import name_parts
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import RADIUS_CHIP, Tokens, mono_font
from smsl_studio.studio.base.tips import tip_text

COLUMNS = ("Fact", "Sensed", "Holds if", "Rests on", "Age", "Needed by")
WIDTHS = (224, 58, 200, 134, 62, 200)
FACT, SENSED, HOLDS, RESTS, AGE, NEEDED = range(6)
ROW = 30
Index = QModelIndex | QPersistentModelIndex


def cells(fact: RoomFact) -> tuple[str, ...]:
    """The words of a row."""
    needed = ", ".join(fact.needed_by)
    held = f"{needed}: held back" if fact.held_back else needed
    return (
        fact.name,
        "?" if fact.value is None else fact.value,
        fact.holds_if if fact.value is not None else fact.reason,
        fact.rests_on,
        age_words(fact.age) if fact.value is not None or fact.age else "",
        held,
    )


class RoomFactsModel(QAbstractTableModel):
    """The facts as a Qt model."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.facts: tuple[RoomFact, ...] = ()

    def show(self, facts: tuple[RoomFact, ...]) -> None:
        """Replace the facts. Only if their number changes, the selection goes."""
        if len(facts) != len(self.facts):
            self.beginResetModel()
            self.facts = facts
            self.endResetModel()
        elif facts != self.facts:
            self.facts = facts
            last = self.index(max(len(facts) - 1, 0), len(COLUMNS) - 1)
            self.dataChanged.emit(self.index(0, 0), last)

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The number of facts; a fact has no children."""
        return 0 if parent.isValid() else len(self.facts)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The number of columns."""
        return 0 if parent.isValid() else len(COLUMNS)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = 0) -> object:
        """The titles of the columns."""
        if role == Qt.ItemDataRole.DisplayRole:
            return COLUMNS[section] if orientation is Qt.Orientation.Horizontal else section + 1
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
        return None

    def data(self, index: Index, role: int = 0) -> object:
        """The text or the tooltip of a cell, or the fact itself."""
        fact = self.facts[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            return plain_text(cells(fact)[index.column()])
        if role == Qt.ItemDataRole.ToolTipRole:
            lines = [f"{value}: {text}" for value, text in fact.predicates]
            return tip_text("\n".join([fact.name, fact.reason, *lines]))
        return fact if role == Qt.ItemDataRole.UserRole else None


class _RoomFactCells(QStyledItemDelegate):
    """Paints chips and words."""

    def __init__(self, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.tokens = tokens

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint one cell."""
        fact: RoomFact = index.data(Qt.ItemDataRole.UserRole)
        tokens, room, column = self.tokens, QRectF(option.rect), index.column()
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if option.state & QStyle.StateFlag.State_Selected:
            painter.fillRect(room, tokens.accs)
        painter.fillRect(QRectF(room.left(), room.bottom() - 1, room.width(), 1), tokens.line)
        inner = room.adjusted(12 if column == FACT else 6, 0, -8, 0)
        unknown = fact.value is None
        words = cells(fact)[column]
        if column == SENSED:
            self._chip(painter, inner, words, unknown)
        elif column == NEEDED:
            ink = TextInk(tokens.unk if fact.held_back else tokens.tx, 12, mono=not fact.held_back)
            paint_text(painter, inner, words, ink)
        else:
            colour = tokens.unk if unknown and column in (HOLDS, RESTS, AGE) else tokens.tx
            ink = TextInk(colour, 13 if column == FACT else 12)
            paint_text(painter, inner, words, ink, elide=Qt.TextElideMode.ElideRight)
        painter.restore()

    def _chip(self, painter: QPainter, room: QRectF, words: str, unknown: bool) -> None:
        tokens = self.tokens
        box = QRectF(room.left() + 4, room.center().y() - 10, 20, 20)
        ink = tokens.unk if unknown else tokens.ok
        style = Qt.PenStyle.DashLine if unknown else Qt.PenStyle.SolidLine
        painter.setPen(QPen(ink, 1.2, style))
        painter.setBrush(tokens.unks if unknown else tokens.oks)
        painter.drawRoundedRect(box, RADIUS_CHIP, RADIUS_CHIP)
        painter.setPen(ink)
        painter.setFont(mono_font(12, 600))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, plain_text(words[:3]))


class RoomFacts(QTableView):
    """The table. A chosen row tells its fact."""

    chosen = Signal(object)
    """RoomFact: the fact of the chosen row."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.facts = RoomFactsModel(self)
        self.setModel(self.facts)
        self._cells = _RoomFactCells(tokens, self)
        self.setItemDelegate(self._cells)
        self.setProperty("role", "table")
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setTabKeyNavigation(False)
        self.setShowGrid(False)
        self.setFrameShape(QTableView.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(ROW)
        header = self.horizontalHeader()
        header.setHighlightSections(False)
        header.setFixedHeight(30)
        for column, width in enumerate(WIDTHS):
            header.resizeSection(column, width)
        for column in (HOLDS, NEEDED):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Stretch)
        name_parts(self)
        self.setAccessibleName("Facts that nodes tell")
        self.selectionModel().currentRowChanged.connect(self._choose)

    def keyboardSearch(self, search: str, /) -> None:
        """Do nothing: letters are keys of the window."""

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._cells.tokens = tokens
        self.viewport().update()

    def _choose(self, now: QModelIndex, before: QModelIndex) -> None:
        if now.isValid():
            self.chosen.emit(self.facts.facts[now.row()])
