"""RowTable: the common base of the tables on the page Inspection."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView, QWidget

from smsl_studio.studio.base.controls import NameDelegate, name_parts
from smsl_studio.studio.features.inspection.claim_model import HIGH


class RowTable(QTableView):
    """A table in which one whole row is selected at a time. Nothing can be edited in it."""

    def __init__(self, words: str, parent: QWidget | None) -> None:
        """``words`` is the name of the table for screen readers."""
        super().__init__(parent)
        self.setProperty("role", "table")
        self.setAccessibleName(words)
        self.setItemDelegate(NameDelegate(self))
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setTabKeyNavigation(False)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(HIGH)
        self.verticalHeader().setMinimumSectionSize(HIGH)
        heads = self.horizontalHeader()
        heads.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        heads.setHighlightSections(False)
        heads.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        name_parts(self)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Hide the headings of a low table, so that one row is fully visible."""
        super().resizeEvent(event)
        heads = self.horizontalHeader()
        room = self.height() - 2 * self.frameWidth() - heads.sizeHint().height()
        if heads.isHidden() != (room < HIGH):
            heads.setHidden(room < HIGH)

    def keyboardSearch(self, search: str, /) -> None:
        """Do nothing.

        Qt would use a letter to search a row, but letters are shortcuts of the window.
        """
