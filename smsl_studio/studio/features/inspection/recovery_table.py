"""The table of recovery: each failure state with the way out of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QModelIndex, Signal
from PySide6.QtGui import QColor, QResizeEvent, QStandardItem, QStandardItemModel
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.current_cell import CurrentCell
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.inspection.claim_model import Index
from smsl_studio.studio.features.inspection.row_table import RowTable

if TYPE_CHECKING:
    from smsl_studio.front.recovery_rows import RecoveryRow

HEADS = ("From", "Failure", "Nearest good", "By", "Who decides", "Goal")
SHARES = (4, 4, 3, 4, 3, 2)
"""How the columns share the width."""


class RecoveryTable(RowTable):
    """Failure states, one in a row. Those without a way back stand first."""

    row_chosen = Signal(object)
    """RecoveryRow, or None if no row is chosen."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("Recoverability", parent)
        self._tokens = tokens
        self.rows: tuple[RecoveryRow, ...] = ()
        self._model = QStandardItemModel(self)
        # Qt tells of the current row while a table gets its model.
        self.cell = CurrentCell(self)
        self.setModel(self._model)
        self.cell.follow()

    @property
    def chosen(self) -> RecoveryRow | None:
        """The chosen row."""
        at = self.cell.index.row()
        return self.rows[at] if 0 <= at < len(self.rows) else None

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        blocked = self.blockSignals(True)  # the chosen way stays where it is
        self.show_rows(self.rows)
        self.blockSignals(blocked)

    def show_rows(self, rows: tuple[RecoveryRow, ...]) -> None:
        """Show other rows. The chosen one stays chosen."""
        before = self.chosen
        blocked = self.blockSignals(True)
        self._model.clear()
        self._model.setHorizontalHeaderLabels(HEADS)
        self.rows = rows
        for row in rows:
            self._model.appendRow(self._items(row))
        kept = [at for at, row in enumerate(rows) if before and row.state == before.state]
        self.cell.choose(self._model.index(kept[0], 0) if kept else QModelIndex())
        self.blockSignals(blocked)
        self._share()
        self.row_chosen.emit(self.chosen)

    def choose_first(self) -> None:
        """If no row is selected, select the first one."""
        if self.chosen is None and self.rows:
            self.cell.choose(self._model.index(0, 0))

    def currentChanged(self, current: Index, previous: Index) -> None:
        """Tell the chosen row."""
        super().currentChanged(current, previous)
        self.row_chosen.emit(self.chosen)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Share the width among the columns."""
        super().resizeEvent(event)
        self._share()

    def _items(self, row: RecoveryRow) -> list[QStandardItem]:
        words = (str(row.state), row.failure, row.nearest, row.way, row.decides, row.goal)
        items = [QStandardItem(text) for text in words]
        for item, text in zip(items, words, strict=True):
            item.setToolTip(tip_text(text))
        if not row.found:
            items[2].setForeground(QColor(self._tokens.bad))
            items[2].setIcon(icon("error", self._tokens, 16, self._tokens.bad))
        return items

    def _share(self) -> None:
        whole = self.viewport().width()
        for column, share in enumerate(SHARES):
            self.horizontalHeader().resizeSection(column, whole * share // sum(SHARES))
