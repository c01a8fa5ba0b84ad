"""The current cell of a table is one only while the table has the keyboard focus.

Qt tells screen readers that the current cell of a table has the focus, wherever the focus is. So a
reader that asks the whole window finds several things with the focus. Here the current cell is
remembered while another part has the focus, and it is current again when the focus comes back. What
is chosen stays chosen.
"""

from __future__ import annotations

from PySide6.QtCore import QEvent, QItemSelectionModel, QModelIndex, QObject, QPersistentModelIndex
from PySide6.QtWidgets import QAbstractItemView, QApplication

KEEP = QItemSelectionModel.SelectionFlag.NoUpdate


class CurrentCell(QObject):
    """Belongs to a table. If it is made before the table has its model, ``follow`` comes then."""

    def __init__(self, table: QAbstractItemView) -> None:
        super().__init__(table)
        self._table = table
        self._kept = QPersistentModelIndex()
        table.installEventFilter(self)
        if table.model() is not None:
            self.follow()

    def follow(self) -> None:
        """Follow the model that the table has now."""
        self._table.selectionModel().currentChanged.connect(self._changed)

    @property
    def index(self) -> QModelIndex:
        """The current cell, or the one that will be it; invalid for none."""
        current = self._table.currentIndex()
        return current if current.isValid() else QModelIndex(self._kept)  # type: ignore[call-overload]

    def choose(self, index: QModelIndex) -> None:
        """Choose a cell; an invalid index chooses none."""
        self._bring_back()
        self._kept = QPersistentModelIndex()
        self._table.setCurrentIndex(index)
        self._changed()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the focus of the table."""
        if event.type() == QEvent.Type.FocusIn:
            self._bring_back()
        elif event.type() == QEvent.Type.FocusOut:
            self._put_away()
        return super().eventFilter(watched, event)

    def _changed(self) -> None:
        if QApplication.focusWidget() is not self._table:
            self._put_away()

    def _put_away(self) -> None:
        current = self._table.currentIndex()
        if current.isValid():
            self._kept = QPersistentModelIndex(current)
            self._make_current(QModelIndex())

    def _bring_back(self) -> None:
        if self._kept.isValid() and not self._table.currentIndex().isValid():
            self._make_current(QModelIndex(self._kept))  # type: ignore[call-overload]

    def _make_current(self, index: QModelIndex) -> None:
        """Nobody is told, for nothing else was chosen."""
        chosen = self._table.selectionModel()
        blocked = chosen.blockSignals(True)
        chosen.setCurrentIndex(index, KEEP)
        chosen.blockSignals(blocked)
