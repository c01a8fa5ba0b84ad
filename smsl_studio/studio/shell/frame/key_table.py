"""The table of all keys: one row for each, with its menu, what it does, and the key."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableWidget, QTableWidgetItem

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.current_cell import CurrentCell
from smsl_studio.studio.base.feature import KeyList
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.theme import text_font
from smsl_studio.studio.base.tips import tip_text

COLUMNS = ("Does", "Key")


class KeyTable(QTableWidget):
    """All keys in sections. It can be read with the arrows; nothing in it is changed."""

    def __init__(self, sections: Sequence[KeyList]) -> None:
        super().__init__(sum(len(lines) + 1 for _, lines in sections), len(COLUMNS))
        self.setProperty("role", "table")
        self.setAccessibleName("Keyboard shortcuts")
        FocusLine(self)
        CurrentCell(self)
        self.setHorizontalHeaderLabels(COLUMNS)
        self.verticalHeader().hide()
        self.setShowGrid(False)
        self.setFrameShape(QTableWidget.Shape.NoFrame)
        self.setTabKeyNavigation(False)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        header = self.horizontalHeader()
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        header.setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        # A long sentence is wrapped, because nothing of a key may be left out.
        self.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        at = 0
        for title, lines in sections:
            self._put(at, 0, title, heading=True)
            self.setSpan(at, 0, 1, len(COLUMNS))
            for words, keys in lines:
                at += 1
                self._put(at, 0, words)
                self._put(at, 1, keys, key=True)
            at += 1
        self.setCurrentCell(1, 0)

    @property
    def words(self) -> list[str]:
        """What the keys do, with the titles of the sections."""
        items = (self.item(at, 0) for at in range(self.rowCount()))
        return [item.text() for item in items if item is not None]

    def _put(
        self, at: int, column: int, words: str, heading: bool = False, key: bool = False
    ) -> None:
        item = QTableWidgetItem(plain_text(words))
        item.setFlags(Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable)
        item.setFont(
            text_font(13, 600) if heading else text_font(12, 500) if key else text_font(13)
        )
        item.setToolTip(tip_text(words))
        self.setItem(at, column, item)
