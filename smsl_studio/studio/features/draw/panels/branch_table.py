"""The SB that is shown as a table, for those to whom a drawing says little."""

from __future__ import annotations

from PySide6.QtCore import QItemSelectionModel, QModelIndex, Qt, Signal
from PySide6.QtGui import QFocusEvent, QHideEvent, QKeyEvent, QShowEvent
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import NameDelegate, name_parts
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.branch_model import (
    OPERATION,
    STATE,
    TARGET,
    BranchModel,
    Index,
)

WIDTHS = (150, 190, 150, 130, 240)
FLAG = QItemSelectionModel.SelectionFlag
ENTER = (Qt.Key.Key_Return, Qt.Key.Key_Enter)


class BranchTable(QTableView):
    """States and operations as rows. The chosen cell and the selection follow each other.

    Enter goes on to the target of the row, F2 and Del act on the selection. A hidden table has no
    rows, so that it costs nothing.

    It has a current cell only while it has the keyboard focus, and a chosen cell always: Qt tells
    screen readers that a current cell has the focus, wherever the focus is.
    """

    action_wanted = Signal(str)
    """The id of an action of the window: ``rename`` or ``delete``."""
    shown_wanted = Signal(object)
    """Address: scroll the drawing to this element; the keyboard focus stays here."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session, self._following = session, False
        self.lines = BranchModel(self)
        self.setModel(self.lines)
        self.setProperty("role", "table")
        self.setItemDelegate(NameDelegate(self))
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setTabKeyNavigation(False)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(28)
        heads = self.horizontalHeader()
        heads.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        heads.setHighlightSections(False)
        heads.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        for section, wide in enumerate(WIDTHS):
            heads.resizeSection(section, wide)
        heads.setStretchLastSection(True)
        name_parts(self)
        self.set_findings = self.lines.set_findings
        self._name()
        changed = session.blueprint_changed, session.branch_changed
        session.afterwards.follow(self._show, *changed)
        session.selection_changed.connect(self._follow)

    def keyboardSearch(self, search: str, /) -> None:
        """Do nothing: letters are keys of the window."""

    def showEvent(self, event: QShowEvent) -> None:
        """Fill the table, because it is seen now."""
        super().showEvent(event)
        self._show()

    def hideEvent(self, event: QHideEvent) -> None:
        """Empty the table."""
        super().hideEvent(event)
        self._show()

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Go on at the chosen cell."""
        self._make_current(self._chosen())
        super().focusInEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Keep the chosen cell, but no current one."""
        super().focusOutEvent(event)
        self._make_current(QModelIndex())

    def _make_current(self, index: QModelIndex) -> None:
        self._following = True
        self.selectionModel().setCurrentIndex(index, FLAG.NoUpdate)
        self._following = False

    def _chosen(self) -> QModelIndex:
        """The current cell, or the chosen one without the keyboard focus; invalid for none."""
        current = self.currentIndex()
        return current if current.isValid() else next(iter(self.selectedIndexes()), current)

    def currentChanged(self, current: Index, previous: Index) -> None:
        """Select the element of the cell that was chosen, and show it on the drawing."""
        super().currentChanged(current, previous)
        if self._following or not current.isValid():
            return
        address = self.lines.address(current.row(), current.column())
        self._session.select((address,))
        self.shown_wanted.emit(address)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter goes to the target, F2 renames, Del deletes; other keys as in any table."""
        key, current = event.key(), self.currentIndex()
        if not current.isValid():
            super().keyPressEvent(event)
        elif key in ENTER:
            target = self.lines.target(current.row())
            if target is not None:
                self._go(target, current.column())
        elif key == Qt.Key.Key_F2:
            self.action_wanted.emit("rename")
        elif key == Qt.Key.Key_Delete:
            self.action_wanted.emit("delete")
        else:
            super().keyPressEvent(event)

    def _go(self, address: Address, column: int) -> None:
        """Choose the first cell of an element. A state is chosen in a column about states: in that
        of its name, if the column was about operations."""
        row = self.lines.row_of(address)
        column = STATE if not address.operation and column >= OPERATION else column
        self.setCurrentIndex(self.lines.index(row, column))

    def _show(self) -> None:
        session = self._session
        self._following = True
        self.lines.show_branch(session.blueprint, session.branch if self.isVisible() else "")
        self._following = False
        self._name()
        self._follow(session.selection)

    def _name(self) -> None:
        self.setAccessibleName(plain_text(f"Table of {self._session.branch}"))

    def _follow(self, selection: tuple[Address, ...]) -> None:
        """Choose the row of the element that was selected elsewhere."""
        if len(selection) != 1 or not self.lines.rows:
            return
        current, (address,) = self._chosen(), selection
        if current.isValid() and self.lines.address(current.row(), current.column()) == address:
            return
        row = self.lines.row_of(address)
        if row >= 0:
            column = max(current.column(), 0)
            kept = min(max(column, OPERATION), TARGET) if address.operation else 0
            index = self.lines.index(row, kept)
            self.selectionModel().select(index, FLAG.ClearAndSelect)
            self.scrollTo(index)
            if self.hasFocus():
                self._make_current(index)
