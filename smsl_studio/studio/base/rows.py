"""Lists of rows: an icon, a text, a second text beside it, and a text at the right.

The library, the operations of a state and the command palette are such lists. Only visible rows are
painted, so a list may have ten thousand.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import (
    QAbstractListModel,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QRectF,
    QSize,
    Qt,
)
from PySide6.QtGui import QColor, QFontMetricsF, QPainter
from PySide6.QtWidgets import QListView, QStyle, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.icons import SEVERITY_ICON, draw, severity_colour
from smsl_studio.studio.base.theme import Tokens, mono_font, text_font
from smsl_studio.studio.base.tips import tip_text

Index = QModelIndex | QPersistentModelIndex
ROW, SECTION = 28, 26
LINE = "row"


@dataclass(frozen=True)
class ListRow:
    """One row.

    ``kind`` is ``row`` or ``section``; ``payload`` is the object that a click is about.
    """

    text: str
    payload: Any = None
    icon: str = ""
    beside: str = ""
    right: str = ""
    severity: str = ""
    kind: str = LINE
    tip: str = ""
    accent: bool = False
    mono: bool = False
    """Whether ``right`` is a value, painted in the mono font."""
    pale: bool = False


class RowsModel(QAbstractListModel):
    """The rows of one list."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.rows: tuple[ListRow, ...] = ()
        self.draggable = False
        """Whether rows can be dragged."""

    def show(self, rows: Sequence[ListRow]) -> None:
        """Replace all rows, unless they are the same."""
        if tuple(rows) != self.rows:
            self.beginResetModel()
            self.rows = tuple(rows)
            self.endResetModel()

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The number of rows; a row has no children."""
        return 0 if parent.isValid() else len(self.rows)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """The text, the tooltip, the accessible text, or the ``ListRow`` itself."""
        row = self.rows[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            return row.text
        if role == Qt.ItemDataRole.ToolTipRole:
            return tip_text(row.tip or row.text)
        if role == Qt.ItemDataRole.AccessibleTextRole:
            return ", ".join(part for part in (row.text, row.beside, row.right) if part)
        return row if role == Qt.ItemDataRole.UserRole else None

    def flags(self, index: Index) -> Qt.ItemFlag:
        """Rows can be selected, headings cannot."""
        if self.rows[index.row()].kind != LINE:
            return Qt.ItemFlag.NoItemFlags
        kind = Qt.ItemFlag
        found = kind.ItemIsEnabled | kind.ItemIsSelectable
        return found | kind.ItemIsDragEnabled if self.draggable else found


class RowsDelegate(QStyledItemDelegate):
    """Paints rows; ``margin`` is the free width at both sides (pixels)."""

    def __init__(self, tokens: Tokens, margin: int = 12, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.tokens, self.margin = tokens, margin

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        """The height of a row or of a heading."""
        row = index.data(Qt.ItemDataRole.UserRole)
        return QSize(10, ROW if row.kind == LINE else SECTION)

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint one row."""
        row: ListRow = index.data(Qt.ItemDataRole.UserRole)
        tokens, rect = self.tokens, QRectF(option.rect)
        state = option.state
        painter.save()
        if state & QStyle.StateFlag.State_Selected:
            painter.fillRect(rect, tokens.accs)
        elif state & QStyle.StateFlag.State_MouseOver and row.kind == LINE:
            painter.fillRect(rect, tokens.sunk)
        inner = rect.adjusted(self.margin, 0, -self.margin, 0)
        if row.kind == LINE:
            self._line(painter, inner, row)
        else:
            paint_text(painter, inner, row.text, TextInk(tokens.tx2, 12))
        painter.restore()

    def _line(self, painter: QPainter, inner: QRectF, row: ListRow) -> None:
        tokens = self.tokens
        if row.icon:
            box = QRectF(inner.left(), inner.center().y() - 7.5, 15, 15)
            if row.icon in {"rise", "fall", "mixed"}:
                box = QRectF(inner.left() + 2, inner.center().y() - 5.5, 11, 11)
            draw(painter, row.icon, box, tokens.acc if row.accent else tokens.tx2, tokens.surf)
        left = inner.adjusted(23, 0, 0, 0)
        right = inner.right()
        if row.right:
            wide = paint_text(
                painter, inner, row.right, TextInk(tokens.tx2, 12, mono=row.mono), right=True
            )
            right -= wide + 8
        if row.severity:
            box = QRectF(right - 15, inner.center().y() - 7, 14, 14)
            colour = severity_colour(row.severity, tokens)
            draw(painter, SEVERITY_ICON[row.severity], box, colour, tokens.surf)
            right -= 22
        left.setRight(right)
        used = paint_text(painter, left, row.text, TextInk(tokens.tx2 if row.pale else tokens.tx))
        if row.beside and used + 16 < left.width():
            beside = left.adjusted(used + 8, 0, 0, 0)
            paint_text(painter, beside, row.beside, TextInk(tokens.tx2, 12))


class RowsView(QListView):
    """A list of rows."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None, margin: int = 12) -> None:
        super().__init__(parent)
        self.rows = RowsModel(self)
        self.setModel(self.rows)
        self._delegate = RowsDelegate(tokens, margin, self)
        self.setItemDelegate(self._delegate)
        self.setMouseTracking(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollMode(QListView.ScrollMode.ScrollPerPixel)
        self.setEditTriggers(QListView.EditTrigger.NoEditTriggers)
        FocusLine(self)

    def keyboardSearch(self, search: str, /) -> None:
        """Do nothing: letters are keys of the window."""

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._delegate.tokens = tokens
        self.viewport().update()

    @property
    def current_payload(self) -> Any:
        """What the current row stands for; None if no row is current."""
        index = self.currentIndex()
        return index.data(Qt.ItemDataRole.UserRole).payload if index.isValid() else None

    def show_rows(self, rows: Sequence[ListRow]) -> None:
        """Show these rows; the selection stays on the row with the same text."""
        kept = self.currentIndex().data() if self.currentIndex().isValid() else None
        place = self.verticalScrollBar().value()
        self.rows.show(rows)
        if kept is not None and not self.currentIndex().isValid():
            for at, row in enumerate(self.rows.rows):
                if row.text == kept and row.kind == LINE:
                    self.setCurrentIndex(self.rows.index(at))
                    break
        self.verticalScrollBar().setValue(place)

    def height_of_all(self) -> int:
        """The height of all rows together, in pixels."""
        return sum(ROW if row.kind == LINE else SECTION for row in self.rows.rows)


@dataclass(frozen=True)
class TextInk:
    """Colour, size (pixels), weight and font of a text."""

    colour: QColor
    size: int = 13
    weight: int = 400
    mono: bool = False


def paint_text(
    painter: QPainter,
    rect: QRectF,
    text: str,
    ink: TextInk,
    *,
    right: bool = False,
    elide: Qt.TextElideMode = Qt.TextElideMode.ElideMiddle,
) -> float:
    """Paint one line, shortened if it does not fit; returns its width in pixels."""
    font = mono_font(ink.size, ink.weight) if ink.mono else text_font(ink.size, ink.weight)
    metrics = QFontMetricsF(font)
    shown = metrics.elidedText(plain_text(text), elide, rect.width())
    side = Qt.AlignmentFlag.AlignRight if right else Qt.AlignmentFlag.AlignLeft
    painter.setFont(font)
    painter.setPen(ink.colour)
    painter.drawText(rect, Qt.AlignmentFlag.AlignVCenter | side, shown)
    return metrics.horizontalAdvance(shown)
