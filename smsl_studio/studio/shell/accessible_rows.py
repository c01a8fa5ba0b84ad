"""The accessible interfaces of lists and trees, in place of Qt's.

Qt says of a row that is scrolled out of view that it is invisible, so a reader that leaves out what
cannot be seen never comes to it. It also says of a list's current row that it has the keyboard
focus, even if another part of the window has it. Here each row is shown while its list is, and one
that is scrolled out of view is off the screen. A row has the focus only if its list has it.

Tables keep Qt's interface, because only that one tells of rows, columns and their headings.
"""

from __future__ import annotations

from functools import partial
from typing import Any

from PySide6.QtCore import QModelIndex, QPoint, QRect, Qt
from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtWidgets import (
    QAbstractItemView,
    QAccessibleWidget,
    QApplication,
    QComboBox,
    QListView,
    QTreeView,
    QWidget,
)
from shiboken6 import isValid

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.canvas.accessible_held import Children, kept
from smsl_studio.studio.base.canvas.accessible_leaf import MENU, PRESS, Acts, LeafAccessible

OPEN, CLOSE = "Expand", "Collapse"
Data = Qt.ItemDataRole


class RowsAccessible(QAccessibleWidget):
    """A list. Its children are all its rows, with the numbers that Qt's events give them."""

    def __init__(
        self, view: QAbstractItemView, role: QAccessible.Role = QAccessible.Role.List
    ) -> None:
        super().__init__(view, role, "")
        self._rows: Children[int, RowAccessible] = Children()

    @property
    def view(self) -> Any:
        """The list; None once it is gone, or while it has no model."""
        # Qt deletes this interface with the list, but readers may still hold its rows.
        found = self.object() if isValid(self) else None
        there = isinstance(found, QAbstractItemView) and found.model() is not None
        return found if there else None

    def index_of(self, number: int) -> QModelIndex:
        """The place of a row in the model; invalid if there is none."""
        view = self.view
        if view is None:
            return QModelIndex()
        found: QModelIndex = view.model().index(number, view.modelColumn(), view.rootIndex())
        return found

    def number_of(self, index: QModelIndex) -> int:
        """The number of the row at a place of the model; -1 for an invalid place."""
        return index.row()

    def is_row(self, row: RowAccessible) -> bool:
        """Whether a row is still here, with the same words."""
        index = self.index_of(row.number)
        return self._rows.get(row.number) is row and index.isValid() and row.said == said(index)

    def childCount(self) -> int:
        """The number of rows, also of those that are scrolled out of view."""
        view = self.view
        return view.model().rowCount(view.rootIndex()) if view is not None else 0

    def child(self, index: int) -> Any:
        """The row with this number; None if there is none.

        A row with other words is another row, because readers keep the words of a row.
        """
        place = self.index_of(index)
        if not place.isValid():
            return None
        words = said(place)
        make = partial(RowAccessible, self, index, words)
        found = kept(self._rows, index, make)
        if found.said != words:
            found = self._rows[index] = make()
        return found

    def indexOfChild(self, child: QAccessibleInterface) -> int:
        """The number of a row; -1 for anything else."""
        return child.number if isinstance(child, RowAccessible) else -1

    def childAt(self, x: int, y: int) -> Any:
        """The row at a point of the screen (pixels); None if there is none."""
        view = self.view
        if view is None:
            return None
        index = view.indexAt(view.viewport().mapFromGlobal(QPoint(x, y)))
        return self.child(self.number_of(index)) if index.isValid() else None

    def focusChild(self) -> Any:
        """The current row, if the list has the keyboard focus."""
        view = self.view
        if view is None or not _has_focus(view):
            return None
        return self.child(self.number_of(view.currentIndex()))

    def state(self) -> QAccessible.State:
        """As of any widget, but the current row has the focus if there is one."""
        found, view = super().state(), self.view
        if view is not None and view.currentIndex().isValid():
            found.focused = False
        return found


class LinesAccessible(RowsAccessible):
    """A tree whose lines have one height. Its children are the lines that are not collapsed, one
    below the other.

    Qt numbers the lines from 1, because the heading of the column is number 0. It is hidden here.
    """

    def __init__(self, view: QTreeView) -> None:
        super().__init__(view, QAccessible.Role.Tree)
        self._head: HeadAccessible | None = None

    def child(self, index: int) -> Any:
        """The line with this number; 0 is the heading. None if there is none."""
        if index != 0:
            return super().child(index)
        if (self._head is None or not isValid(self._head)) and self.view is not None:
            self._head = HeadAccessible(self, self.view)
        return self._head

    def indexOfChild(self, child: QAccessibleInterface) -> int:
        """The number of a line, 0 for the heading; -1 for anything else."""
        return 0 if isinstance(child, HeadAccessible) else super().indexOfChild(child)

    def index_of(self, number: int) -> QModelIndex:
        """The place of a line in the model; invalid for the heading, and if there is none."""
        view, first = self.view, self._first()
        if number < 1 or first is None:
            return QModelIndex()
        top = view.visualRect(first)
        found: QModelIndex = view.indexAt(QPoint(1, top.top() + (number - 1) * top.height() + 1))
        return found

    def number_of(self, index: QModelIndex) -> int:
        """The number of the line at a place of the model; -1 if it is not shown."""
        view, first = self.view, self._first()
        place = view.visualRect(index) if first is not None else QRect()
        if place.isEmpty():
            return -1
        top = view.visualRect(first)
        return int((place.top() - top.top()) // top.height()) + 1

    def childCount(self) -> int:
        """The number of lines, and one for the heading."""
        view, last = self.view, self._first()
        if last is None:
            return 1
        above = QModelIndex()
        while rows := view.model().rowCount(above):
            last = above = view.model().index(rows - 1, 0, above)
            if not view.isExpanded(last):
                break
        return self.number_of(last) + 1

    def _first(self) -> QModelIndex | None:
        """The place of the first line; None without lines."""
        view = self.view
        first = view.model().index(0, 0) if view is not None else QModelIndex()
        return first if first.isValid() and not view.visualRect(first).isEmpty() else None


class HeadAccessible(LeafAccessible):
    """The heading of a tree: Qt counts it, though it is hidden here."""

    def __init__(self, above: RowsAccessible, view: QWidget) -> None:
        super().__init__(above, view)
        self._list = above

    def isValid(self) -> bool:
        """Whether the tree is still there."""
        return self._list.view is not None

    def text(self, kind: QAccessible.Text) -> str:
        """The name of the tree; empty for other kinds of text."""
        view = self._list.view
        named = kind == QAccessible.Text.Name and view is not None
        return plain_text(view.accessibleName()) if named else ""

    def role(self) -> QAccessible.Role:
        """The heading of a column."""
        return QAccessible.Role.ColumnHeader

    def rect(self) -> QRect:
        """Empty: nobody sees it."""
        return QRect()

    def state(self) -> QAccessible.State:
        """Hidden."""
        found = QAccessible.State()
        found.invisible = True
        return found


class RowAccessible(LeafAccessible):
    """One row of a list, or one line of a tree."""

    def __init__(self, above: RowsAccessible, number: int, words: str) -> None:
        super().__init__(above, above.view)
        self._list, self.number, self.said = above, number, words

    def isValid(self) -> bool:
        """Whether the list still has this row, with the same words."""
        return self._list.is_row(self)

    @property
    def _index(self) -> QModelIndex:
        return self._list.index_of(self.number)

    def text(self, kind: QAccessible.Text) -> str:
        """What is read out; empty for other kinds of text."""
        if kind == QAccessible.Text.Description and self.isValid():
            return plain_text(self._index.data(Data.AccessibleDescriptionRole) or "")
        return self.said if kind == QAccessible.Text.Name else ""

    def role(self) -> QAccessible.Role:
        """An item of a list or of a tree."""
        tree = self._list.role() == QAccessible.Role.Tree
        return QAccessible.Role.TreeItem if tree else QAccessible.Role.ListItem

    def rect(self) -> QRect:
        """Where it lies on the screen (pixels), though nobody may see it; empty if it is gone."""
        view = self._list.view
        if view is None or not self.isValid():
            return QRect()
        place: QRect = view.visualRect(self._index)
        return QRect(view.viewport().mapToGlobal(place.topLeft()), place.size())

    def acts(self) -> Acts:
        """Choose it as a click does, open its menu, expand or collapse it."""
        view = self._list.view
        if view is None or not self.isValid():
            return {}
        found: dict[str, Any] = {}
        index = self._index
        if index.flags() & Qt.ItemFlag.ItemIsEnabled:
            found[PRESS] = ("Choose it, as a click does", partial(_press, view, index))
            if view.contextMenuPolicy() == Qt.ContextMenuPolicy.CustomContextMenu:
                found[MENU] = ("Open its menu", partial(_open_menu, view, index))
        if isinstance(view, QTreeView) and view.model().hasChildren(index):
            opened = view.isExpanded(index)
            words = "Hide the lines below it" if opened else "Show the lines below it"
            name = CLOSE if opened else OPEN
            found[name] = (words, partial(view.setExpanded, index, not opened))
        return found

    def state(self) -> QAccessible.State:
        """The flags: chosen, with the focus, on the screen, expanded."""
        found, view = QAccessible.State(), self._list.view
        if view is None or not self.isValid():
            found.invisible = True
            return found
        index = self._index
        found.invisible = not view.isVisible()
        found.offscreen = not view.viewport().rect().intersects(view.visualRect(index))
        found.disabled = not index.flags() & Qt.ItemFlag.ItemIsEnabled
        if index.flags() & Qt.ItemFlag.ItemIsSelectable:
            found.selectable = found.focusable = True
        found.selected = view.selectionModel().isSelected(index)
        found.focused = _has_focus(view) and view.currentIndex() == index
        checked = index.data(Data.CheckStateRole)
        if checked is not None and index.flags() & Qt.ItemFlag.ItemIsUserCheckable:
            found.checkable, found.checked = True, Qt.CheckState(checked) == Qt.CheckState.Checked
        if isinstance(view, QTreeView) and view.model().hasChildren(index):
            found.expandable = True
            found.expanded = view.isExpanded(index)
            found.collapsed = not found.expanded
        return found


def said(index: QModelIndex) -> str:
    """The words of a row for assistive tools, or the words that are shown."""
    words = index.data(Data.AccessibleTextRole) or index.data(Data.DisplayRole)
    return plain_text(str(words)) if words is not None else ""


def _has_focus(view: Any) -> bool:
    # Not ``hasFocus``: a list that hands its focus on to a field has it in that sense, too.
    return QApplication.focusWidget() is view


def _press(view: Any, index: QModelIndex) -> None:
    combo = combo_of(view)
    if combo is not None:
        combo.setCurrentIndex(index.row())
        combo.activated.emit(index.row())
        combo.hidePopup()
        return
    # A list that never has the keyboard would take it from the field beside it.
    if view.focusPolicy() != Qt.FocusPolicy.NoFocus:
        view.setFocus()
    view.setCurrentIndex(index)
    view.clicked.emit(index)


def _open_menu(view: Any, index: QModelIndex) -> None:
    view.setCurrentIndex(index)
    view.customContextMenuRequested.emit(view.visualRect(index).center())


def combo_of(view: QAbstractItemView) -> QComboBox | None:
    """The combo box whose entries a list shows; None for all other lists."""
    frame = view.parentWidget()
    combo = frame.parentWidget() if frame is not None else None
    return combo if isinstance(combo, QComboBox) and combo.view() is view else None


def rows_of(view: QAbstractItemView) -> RowsAccessible | None:
    """The interface of a list or tree; None for all other views."""
    if isinstance(view, QListView):
        return RowsAccessible(view)
    if isinstance(view, QTreeView) and view.uniformRowHeights():
        return LinesAccessible(view)
    return None
