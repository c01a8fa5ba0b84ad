"""The table of hazards and properties."""

from __future__ import annotations

from PySide6.QtCore import QModelIndex, Qt, Signal
from PySide6.QtGui import QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.front.claim_rows import ClaimRow
from smsl_studio.studio.base.current_cell import CurrentCell
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.inspection.claim_model import (
    KIND,
    LOOKED_AT,
    NAME,
    SENTENCE,
    SEVERITY,
    VERDICT,
    ClaimModel,
    Index,
)
from smsl_studio.studio.features.inspection.row_table import RowTable

NARROW = 860
"""Below this width the column Kind is hidden, because the sentence says the same (pixels)."""
ENTER = (Qt.Key.Key_Return, Qt.Key.Key_Enter)


class ClaimTable(RowTable):
    """Hazards and properties, one in a row. Enter or a double click edits, Del removes."""

    row_chosen = Signal(object)
    """ClaimRow, or None if no row is chosen."""
    edit_wanted = Signal(object)
    delete_wanted = Signal(object)

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("Hazards and properties", parent)
        self.claims = ClaimModel(tokens, self)
        # Qt tells of the current row while a table gets its model.
        self.cell = CurrentCell(self)
        self.setModel(self.claims)
        self.cell.follow()
        self.doubleClicked.connect(lambda index: self.edit_wanted.emit(index.data(_ROW)))

    @property
    def chosen(self) -> ClaimRow | None:
        """The chosen row."""
        return _row(self.cell.index)

    def choose(self, address: Address | None) -> None:
        """Choose a row; None or an unknown address chooses none."""
        at = self.claims.row_of(address) if address is not None else -1
        self.cell.choose(self.claims.index(at, 0) if at >= 0 else QModelIndex())

    def show_rows(self, rows: tuple[ClaimRow, ...]) -> None:
        """Show other rows. The chosen one stays chosen."""
        before = self.chosen
        blocked = self.blockSignals(True)
        self.claims.show_rows(rows)
        self.choose(before.address if before else None)
        self.blockSignals(blocked)
        self.row_chosen.emit(self.chosen)

    def currentChanged(self, current: Index, previous: Index) -> None:
        """Tell the chosen row."""
        super().currentChanged(current, previous)
        self.row_chosen.emit(_row(current))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter edits the chosen row, Del removes it."""
        chosen = self.chosen
        if chosen is not None and event.key() in ENTER:
            self.edit_wanted.emit(chosen)
        elif chosen is not None and event.key() == Qt.Key.Key_Delete:
            self.delete_wanted.emit(chosen)
        else:
            super().keyPressEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Share the width among the columns. The sentence has most of it."""
        super().resizeEvent(event)
        whole = self.viewport().width()
        narrow = whole < NARROW
        self.setColumnHidden(KIND, narrow)
        heads = self.horizontalHeader()
        fixed = {VERDICT: 110, KIND: 84, SEVERITY: 78, LOOKED_AT: 166 if narrow else 200}
        for column, wide in fixed.items():
            heads.resizeSection(column, wide)
        rest = whole - sum(fixed.values()) + (fixed[KIND] if narrow else 0)
        heads.resizeSection(NAME, max(rest * 2 // 5, 90))
        heads.resizeSection(SENTENCE, max(rest - max(rest * 2 // 5, 90), 90))


_ROW = Qt.ItemDataRole.UserRole


def _row(index: Index) -> ClaimRow | None:
    found = index.data(_ROW) if index.isValid() else None
    return found if isinstance(found, ClaimRow) else None
