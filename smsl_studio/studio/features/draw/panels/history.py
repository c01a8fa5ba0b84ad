"""The list of undo steps. A click or Enter goes back or forward to a step; arrows only read."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QAbstractListModel, QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtGui import QFont, QPalette, QUndoStack
from PySide6.QtWidgets import QListView, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.session import Session

Index = QModelIndex | QPersistentModelIndex
Role = Qt.ItemDataRole
OPENED = "As it was opened"


class _Steps(QAbstractListModel):
    """The steps of an undo stack below the row for how the file was opened."""

    def __init__(self, stack: QUndoStack, parent: QListView) -> None:
        super().__init__(parent)
        self._stack, self._view = stack, parent

    def read_again(self) -> None:
        """Take over the steps as they are now."""
        self.beginResetModel()
        self.endResetModel()

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The number of steps and 1; a row has no children."""
        return 0 if parent.isValid() else self._stack.count() + 1

    def data(self, index: Index, role: int = Role.DisplayRole) -> Any:
        """The words of a step. The present one is bold, those that were undone are pale; both are
        told in words to assistive tools."""
        row, now = index.row(), self._stack.index()
        if role in (Role.DisplayRole, Role.AccessibleTextRole):
            words = plain_text(self._stack.text(row - 1)) if row else OPENED
            mark = ", present step" if row == now else ", undone" if row > now else ""
            return words if role == Role.DisplayRole else words + mark
        if role == Role.FontRole and row == now:
            font = QFont(self._view.font())
            font.setWeight(QFont.Weight.DemiBold)
            return font
        if role == Role.ForegroundRole and row > now:
            return self._view.palette().brush(QPalette.ColorRole.PlaceholderText)
        return None


class History(QListView):
    """The steps since the file was opened. After a step the present one is the current row."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._stack = session.history
        self._steps = _Steps(self._stack, self)
        self.setModel(self._steps)
        self.setProperty("role", "list")
        self.setAccessibleName("History")
        self.setToolTip("Click a step to go there, or press Enter")
        self.setEditTriggers(QListView.EditTrigger.NoEditTriggers)
        FocusLine(self)
        self.clicked.connect(self._go)
        self.activated.connect(self._go)
        self._stack.indexChanged.connect(self._follow)
        self._follow(self._stack.index())

    def keyboardSearch(self, search: str, /) -> None:
        """Do nothing: typed letters must not lead to another step."""

    def _go(self, index: QModelIndex) -> None:
        self._stack.setIndex(index.row())

    def _follow(self, now: int) -> None:
        self._steps.read_again()
        self.setCurrentIndex(self._steps.index(now, 0))
