"""The table of levels: rows that can be marked, with the declared and the chosen level."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, Qt, Signal
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView, QWidget

from smsl_studio.studio.base.controls import NameDelegate, name_parts
from smsl_studio.studio.base.current_cell import CurrentCell
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import BLANK
from smsl_studio.studio.features.people.level_rows import LevelRow

Index = QModelIndex | QPersistentModelIndex
HEADS = ("What", "Where", "Declared", "From", "Chosen here")
OUT = "taken out"
"""Chosen instead of a level: the entry in the file is removed."""
Role = Qt.ItemDataRole


class LevelModel(QAbstractTableModel):
    """The rows that match the search, and the chosen level (or ``OUT``) by key."""

    def __init__(self) -> None:
        super().__init__()
        self._all: tuple[LevelRow, ...] = ()
        self._words = ""
        self.rows: tuple[LevelRow, ...] = ()
        self.chosen: dict[str, str] = {}
        self._before: list[dict[str, str]] = []
        self._after: list[dict[str, str]] = []

    def show_rows(self, rows: tuple[LevelRow, ...]) -> None:
        """Show other rows; the search still applies."""
        self._all = rows
        self.find(self._words)

    def find(self, words: str) -> None:
        """Show only rows that contain all of these words."""
        self._words = words
        wanted = words.casefold().split()
        self.beginResetModel()
        self.rows = tuple(row for row in self._all if _has(row, wanted))
        self.endResetModel()

    def choose(self, keys: list[str], level: str) -> None:
        """Choose a level for these keys; empty means as declared."""
        chosen = {key: one for key, one in self.chosen.items() if key not in keys}
        chosen |= dict.fromkeys(keys, level) if level else {}
        if chosen != self.chosen:
            self._before.append(self.chosen)
            self._after.clear()
            self._show_chosen(chosen)

    def undo(self) -> None:
        """Undo the last choice."""
        if self._before:
            self._after.append(self.chosen)
            self._show_chosen(self._before.pop())

    def redo(self) -> None:
        """Redo the last undone choice."""
        if self._after:
            self._before.append(self.chosen)
            self._show_chosen(self._after.pop())

    def _show_chosen(self, chosen: dict[str, str]) -> None:
        self.chosen = chosen
        last = self.index(max(len(self.rows) - 1, 0), len(HEADS) - 1)
        self.dataChanged.emit(self.index(0, 0), last)

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The number of matching rows; a row has no children."""
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The number of columns."""
        return 0 if parent.isValid() else len(HEADS)

    def headerData(self, section: int, way: Qt.Orientation, role: int = Role.DisplayRole) -> Any:
        """The titles of the columns; for a row its name, for assistive tools."""
        if way is Qt.Orientation.Horizontal and role == Role.DisplayRole:
            return HEADS[section]
        if role == Role.DisplayRole:
            # The header of rows is hidden, but a screen reader reads it.
            return self.rows[section].name
        return None

    def data(self, index: Index, role: int = Role.DisplayRole) -> Any:
        """The text of a cell or its tooltip. A screen reader says "none" for an empty cell."""
        row = self.rows[index.row()]
        if role == Role.ToolTipRole:
            return tip_text(row.key)
        if role not in (Role.DisplayRole, Role.AccessibleTextRole):
            return None
        chosen = self.chosen.get(row.key, "")
        words = (row.name, row.place, row.declared, row.source, chosen)[index.column()]
        return words or (BLANK if role == Role.AccessibleTextRole else "")


def _has(row: LevelRow, wanted: list[str]) -> bool:
    text = f"{row.kind} {row.name} {row.place} {row.declared} {row.source}".casefold()
    return all(word in text for word in wanted)


class LevelTable(QTableView):
    """The table view; whole rows are marked, several with Shift and Ctrl."""

    marked = Signal()

    def __init__(self, model: LevelModel, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setModel(model)
        self.setProperty("role", "table")
        self.setItemDelegate(NameDelegate(self))
        self.setAccessibleName("Levels")
        FocusLine(self)
        CurrentCell(self)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.setTabKeyNavigation(False)
        name_parts(self)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(28)
        heads = self.horizontalHeader()
        heads.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        heads.setHighlightSections(False)
        heads.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        for section, wide in enumerate((220, 210, 110, 110)):
            heads.resizeSection(section, wide)
        heads.setStretchLastSection(True)
        self.selectionModel().selectionChanged.connect(lambda *_: self.marked.emit())
        model.modelReset.connect(self.marked)

    def keys(self) -> list[str]:
        """The keys of the marked rows."""
        model = self.model()
        assert isinstance(model, LevelModel)
        return [model.rows[index.row()].key for index in self.selectionModel().selectedRows()]
