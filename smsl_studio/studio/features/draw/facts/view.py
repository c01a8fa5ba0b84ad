"""The list of facts: its cells are edited where they stand, by pointer and by keys."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QPoint, QRect, Qt, Signal
from PySide6.QtGui import (
    QContextMenuEvent,
    QFocusEvent,
    QHelpEvent,
    QKeyEvent,
    QKeySequence,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
)
from PySide6.QtWidgets import QAbstractItemView, QApplication, QListView, QToolTip, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.draw.facts.cell_field import CellField
from smsl_studio.studio.features.draw.facts.cells import HINTS, TYPED, Cell, cells_of
from smsl_studio.studio.features.draw.facts.fact_lines import TabledFact
from smsl_studio.studio.features.draw.facts.fact_model import FactModel
from smsl_studio.studio.features.draw.facts.painter import FactPainter, Index

Key, KEYPAD = Qt.Key, Qt.KeyboardModifier.KeypadModifier
TIPS = {
    "digit": "Digit {}. Click for its form, drag to move it",
    "name": "The plain name of the fact",
    "critical": "Whether people may be harmed if it is wrong",
    "unit": "The unit of its sensors",
    "value": "{}: click to rename it, or to let it count as on or as a failure",
    "meaning": "What {} means",
    "source": "The sensors that read it, with commas between",
    "sub": "Show {}",
    "age": "Seconds after which a reading counts as unknown",
    "more": "More values: click for the form of the fact",
}


class FactView(QListView):
    """The facts, one below the other. It changes nothing itself."""

    typed = Signal(int, str, str, str)
    """(digit, kind of cell, value, text): the person typed this text into a cell."""
    pressed_cell = Signal(int, str, str, QPoint)
    """(digit, kind of cell, value, place on the screen): the person pressed another cell.

    The kind is ``rename`` for F2 on a value.
    """
    moved = Signal(int, int)
    """(digit, place): the person wants this fact at another place."""
    unwanted = Signal(int)
    menu_wanted = Signal(int, QPoint)

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.facts, self.looks = FactModel(self), FactPainter(tokens, self)
        self._cell = ("name", "")
        self._dragged, self._drop, self._from = -1, -1, QPoint()
        self.setModel(self.facts)
        self.setItemDelegate(self.looks)
        self.setMouseTracking(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setAccessibleName("Facts")
        self.field = CellField(self.viewport())
        self.field.hide()
        self.field.ended.connect(self._end)
        self.field.given_up.connect(self._give_up)
        self.field.editingFinished.connect(self.settle)
        self.verticalScrollBar().valueChanged.connect(lambda _: self._place_field())

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.looks.tokens = tokens
        self.viewport().update()

    def show_lines(self, lines: tuple[TabledFact, ...]) -> None:
        """Show these facts. The row with the keyboard stays."""
        if lines == self.facts.lines:
            return
        row = self.currentIndex().row()
        self.facts.show(lines)
        if row >= 0 and lines and not self.currentIndex().isValid():
            self.setCurrentIndex(self.facts.index(min(row, len(lines) - 1)))
        self._place_field()

    def rect_of(self, digit: int, kind: str, value: str = "") -> QRect:
        """The place of a cell in the viewport; empty if it is not shown."""
        index = self.facts.index(digit)
        if not index.isValid():
            return QRect()
        corner = self.visualRect(index).topLeft()
        for cell in cells_of(self.facts.lines[digit], self.looks.width):
            if cell.key == (kind, value):
                return cell.rect.toAlignedRect().translated(corner)
        return QRect()

    # Typing

    def edit_cell(self, digit: int, kind: str, value: str = "") -> None:
        """Open the field over a cell."""
        self.settle()
        index = self.facts.index(digit)
        self.setCurrentIndex(index)
        self.scrollTo(index)
        self._cell = (kind, value)
        cell = next((c for c in self._cells(digit) if c.key == self._cell), None)
        if cell is None:
            return
        self.looks.edited = (digit, self._cell)
        self.field.settle(cell.text)
        self.field.setAccessibleName(plain_text(_words(cell, digit)))
        # The field covers what the empty cell says, so it says it itself.
        hint = HINTS.get(cell.kind, "").format(digit + 1)
        self.field.setPlaceholderText(hint.removeprefix("no "))
        self._place_field()
        self.field.show()
        self.field.selectAll()
        self.field.setFocus()

    def settle(self) -> None:
        """Take over the text that is being typed, and close the field."""
        edited = self.looks.edited
        if edited is None:
            return
        self.looks.edited = None
        text, changed = self.field.text(), self.field.changed
        self._hide_field()
        if changed:
            self.typed.emit(edited[0], *edited[1], text.strip())

    def _end(self, step: int) -> None:
        row = self.currentIndex().row()
        self.settle()
        if step:
            self._go(row, step)

    def _give_up(self) -> None:
        self.looks.edited = None
        self._hide_field()

    def _hide_field(self) -> None:
        # A field with the focus that is hidden would hand it on, as Tab does.
        if self.field.hasFocus():
            self.setFocus()
        self.field.hide()
        self.viewport().update()

    def _go(self, row: int, step: int) -> None:
        """Edit the next cell that takes text (``step`` 1), or the previous one (-1).

        After the last cell of a line comes the first cell of the next line.
        """
        keys = [(at, c.key) for at in range(max(row - 1, 0), min(row + 2, len(self.facts.lines)))
                for c in self._cells(at) if c.kind in TYPED]  # fmt: skip
        here = (row, self._cell)
        at = keys.index(here) + step if here in keys else -1
        if 0 <= at < len(keys):
            self.edit_cell(keys[at][0], *keys[at][1])

    def _place_field(self) -> None:
        if self.looks.edited is None:
            return
        rect = self.rect_of(self.looks.edited[0], *self.looks.edited[1])
        if rect.isEmpty():
            self._give_up()
            return
        wide = max(rect.width() + 14, 96)
        left = max(min(rect.left() - 8, self.viewport().width() - wide - 2), 2)
        self.field.setGeometry(left, rect.center().y() - 12, wide, 26)

    # Pointer

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Remember where a drag of a digit may begin."""
        super().mousePressEvent(event)
        row, cell = self._at(event.position().toPoint())
        self._from, self._drop = event.position().toPoint(), -1
        self._dragged = row if cell is not None and cell.kind == "digit" else -1

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Show where a dragged fact would go."""
        at = event.position().toPoint()
        if event.buttons() & Qt.MouseButton.LeftButton and self._dragged >= 0:
            if (at - self._from).manhattanLength() >= QApplication.startDragDistance():
                self._drop = self._place_at(at.y())
                self.viewport().update()
            return
        _, cell = self._at(at)
        typed = cell is not None and cell.kind in TYPED
        shape = Qt.CursorShape.IBeamCursor if typed else Qt.CursorShape.PointingHandCursor
        self.viewport().setCursor(shape if cell is not None else Qt.CursorShape.ArrowCursor)
        super().mouseMoveEvent(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Drop a dragged fact, or act on the cell that was clicked."""
        super().mouseReleaseEvent(event)
        dragged, drop = self._dragged, self._drop
        self._dragged = self._drop = -1
        self.viewport().update()
        row, cell = self._at(event.position().toPoint())
        if dragged >= 0 and drop >= 0:
            place = drop - 1 if drop > dragged else drop
            if place != dragged:
                self.moved.emit(dragged, place)
        elif cell is not None and event.button() == Qt.MouseButton.LeftButton:
            self._act(row, cell)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Ask for the menu of the fact at the pointer, or of the current one."""
        index = self.indexAt(event.pos())
        if event.reason() != QContextMenuEvent.Reason.Mouse:
            index = self.currentIndex()
        if index.isValid():
            rect = self.visualRect(index)
            keyed = event.reason() != QContextMenuEvent.Reason.Mouse
            place = self.viewport().mapToGlobal(rect.center()) if keyed else event.globalPos()
            self.menu_wanted.emit(index.row(), place)

    def viewportEvent(self, event: QEvent) -> bool:
        """Tell what the cell under the pointer is, with its whole text."""
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            row, cell = self._at(event.pos())
            words = _words(cell, row) if cell is not None else ""
            if cell is not None and cell.text and cell.kind in TYPED:
                words = f"{cell.text}\n{words}"
            QToolTip.showText(event.globalPos(), tip_text(words), self.viewport())
            return True
        return super().viewportEvent(event)

    def _place_at(self, y: int) -> int:
        for row in range(len(self.facts.lines)):
            if y < self.visualRect(self.facts.index(row)).center().y():
                return row
        return len(self.facts.lines)

    def _at(self, at: QPoint) -> tuple[int, Cell | None]:
        index = self.indexAt(at)
        if not index.isValid():
            return -1, None
        inside = (at - self.visualRect(index).topLeft()).toPointF()
        cells = self._cells(index.row())
        # A press near a small target hits it, too, before the wide cells around it.
        small = [cell for cell in cells if cell.kind not in TYPED]
        wide = [cell for cell in cells if cell.kind in TYPED]
        hit = (cell for cell in small if cell.rect.adjusted(-4, -4, 3, 4).contains(inside))
        near = (cell for cell in wide if cell.rect.adjusted(-2, -2, 2, 2).contains(inside))
        return index.row(), next(hit, None) or next(near, None)

    def _act(self, row: int, cell: Cell, rename: bool = False) -> None:
        if cell.kind in TYPED:
            self.edit_cell(row, *cell.key)
        else:
            kind = "rename" if rename and cell.kind == "value" else cell.kind
            place = self.rect_of(row, *cell.key).bottomLeft()
            where = self.viewport().mapToGlobal(place)
            self.pressed_cell.emit(row, kind, cell.value, where)

    # Keys

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Left and right choose a cell, Enter and F2 act on it. Del and Alt with an arrow are about
        the fact.
        """
        row, key = self.currentIndex().row(), event.key()
        alt = bool(event.modifiers() & Qt.KeyboardModifier.AltModifier)
        if event.matches(QKeySequence.StandardKey.Copy):
            event.ignore()
        elif row < 0:
            super().keyPressEvent(event)
        elif alt and key in (Key.Key_Up, Key.Key_Down):
            self.moved.emit(row, row + (1 if key == Key.Key_Down else -1))
        elif key in (Key.Key_Left, Key.Key_Right):
            self._choose(row, 1 if key == Key.Key_Right else -1)
        elif key in (Key.Key_Return, Key.Key_Enter, Key.Key_Space):
            self._act(row, self._current(row))
        elif key == Key.Key_F2:
            self._act(row, self._current(row), rename=True)
        elif key == Key.Key_Delete:
            self.unwanted.emit(row)
        elif event.text().isprintable() and event.text().strip():
            self._begin_with(row, event)
        else:
            super().keyPressEvent(event)

    def _begin_with(self, row: int, event: QKeyEvent) -> None:
        """Replace the text of the chosen cell by the letter that was pressed."""
        cell = self._current(row)
        held = event.modifiers() & ~(Qt.KeyboardModifier.ShiftModifier | KEYPAD)
        if held or cell.kind not in TYPED:
            event.ignore()
            return
        self.edit_cell(row, *cell.key)
        self.field.insert(event.text())

    def currentChanged(self, current: Index, previous: Index) -> None:
        """Keep the cell with the keyboard in the line that is current now."""
        super().currentChanged(current, previous)
        self._mark()

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Begin at the first fact."""
        super().focusInEvent(event)
        if not self.currentIndex().isValid() and self.facts.lines:
            self.setCurrentIndex(self.facts.index(0))
        self._mark()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Show no cell as current."""
        super().focusOutEvent(event)
        self._mark()

    def keyboardSearch(self, search: str, /) -> None:
        """Letters choose no line, because they may be keys of the window."""

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Arrange the cells in the new width."""
        self.looks.width = self.viewport().width()
        super().resizeEvent(event)
        self.scheduleDelayedItemsLayout()
        self._place_field()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the facts, and a line where a dragged one would go."""
        super().paintEvent(event)
        if self._drop >= 0 and self.facts.lines:
            last = self.visualRect(self.facts.index(len(self.facts.lines) - 1)).bottom()
            below = self._drop >= len(self.facts.lines)
            y = last if below else self.visualRect(self.facts.index(self._drop)).top()
            painter = QPainter(self.viewport())
            painter.fillRect(0, y - 1, self.viewport().width(), 2, self.looks.tokens.acc)

    def _cells(self, row: int) -> list[Cell]:
        cells = cells_of(self.facts.lines[row], self.looks.width)
        return [cell for cell in cells if cell.rect.width() > 0]

    def _current(self, row: int) -> Cell:
        cells = self._cells(row)
        return next((cell for cell in cells if cell.key == self._cell), cells[1])

    def _choose(self, row: int, step: int) -> None:
        cells = self._cells(row)
        at = cells.index(self._current(row)) + step
        self._cell = cells[max(0, min(at, len(cells) - 1))].key
        self._mark()

    def _mark(self) -> None:
        row = self.currentIndex().row()
        shown = self.hasFocus() and 0 <= row < len(self.facts.lines)
        cell = self._current(row) if shown else None
        self.looks.cursor = (row, cell.key) if cell is not None else None
        said = f"{_words(cell, row)}: {cell.text or 'none'}" if cell is not None else ""
        self.setAccessibleDescription(plain_text(said))
        self.viewport().update()


def _words(cell: Cell, digit: int) -> str:
    """What a cell is."""
    about = {"digit": str(digit), "sub": cell.text}.get(cell.kind, cell.value)
    return TIPS[cell.kind].format(about)
