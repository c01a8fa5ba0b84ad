"""The dialog of measured costs and risks: what the runs say beside what is declared."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QDialog,
    QHeaderView,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.front.campaign_rates import HIGH, MEDIUM, RateProposal
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import NameDelegate, label, name_parts, row
from smsl_studio.studio.base.current_cell import CurrentCell
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.words import counted

WHY = (
    "Of the runs in which a fault disturbed the operation. The risk follows from those that did "
    f"not reach the goal: medium from {MEDIUM:.0%}, high from {HIGH:.0%} on. The cost is the "
    "declared one, and once more for the share that did not go smoothly. Checked rows are "
    "written, as one step that Undo takes back."
)
COLUMNS = ("Operation", "Did not reach", "95 % interval", "Cost", "Risk")


class RatesDialog(QDialog):
    """Shows the differences. ``chosen`` are the proposals that shall be written."""

    def __init__(self, found: Sequence[RateProposal], parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle("Costs and risks of the campaign")
        self._found = [one for one in found if one.changes]
        self.chosen: tuple[RateProposal, ...] = ()
        explained = label(WHY, "small")
        explained.setWordWrap(True)
        self.table = QTableWidget(len(self._found), len(COLUMNS))
        self.table.setProperty("role", "table")
        self.table.setAccessibleName("Measured costs and risks")
        self.table.setItemDelegate(NameDelegate(self.table))
        self.table.setHorizontalHeaderLabels(COLUMNS)
        self.table.verticalHeader().hide()
        self.table.setTabKeyNavigation(False)
        self.table.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
        self.table.setSelectionBehavior(QTableWidget.SelectionBehavior.SelectRows)
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        header.setHighlightSections(False)
        for at, one in enumerate(self._found):
            for column, words in enumerate(_words(one)):
                self.table.setItem(at, column, QTableWidgetItem(plain_text(words)))
            first = self.table.item(at, 0)
            assert first is not None
            first.setCheckState(Qt.CheckState.Checked)
        for column, wide in ((1, 110), (2, 110), (3, 100), (4, 140)):
            header.resizeSection(column, wide)
        CurrentCell(self.table)
        none = "The runs say the same as the blueprint. There is nothing to write."
        self.said = label(none if not self._found else "", "second")
        self.cancel, self.write = QPushButton("Cancel"), QPushButton("Write")
        self.write.setProperty("role", "primary")
        self.write.setDefault(True)
        self.cancel.clicked.connect(self.reject)
        self.write.clicked.connect(self.accept)
        self.table.itemChanged.connect(lambda *_: self._count())
        column_ = QVBoxLayout(self)
        column_.addWidget(explained)
        column_.addWidget(self.table, 1)
        column_.addLayout(row(self.said, None, self.cancel, self.write))
        name_parts(self)
        open_at(self, 760, 520)
        self._count()

    @property
    def _checked(self) -> tuple[RateProposal, ...]:
        rows = ((self.table.item(at, 0), one) for at, one in enumerate(self._found))
        return tuple(
            one for item, one in rows
            if item is not None and item.checkState() is Qt.CheckState.Checked
        )  # fmt: skip

    def _count(self) -> None:
        count = len(self._checked)
        self.write.setEnabled(count > 0)
        self.write.setText(f"Write {counted(count, 'operation')}" if count else "Write")

    def accept(self) -> None:
        """Take over what is checked."""
        self.chosen = self._checked
        super().accept()


def _words(one: RateProposal) -> tuple[str, ...]:
    share = one.share
    lost = share.runs - share.reached
    return (
        str(one.address),
        f"{lost:,} of {share.runs:,}",
        f"{100 * (1 - share.high):.0f} to {100 * (1 - share.low):.0f} %",
        _change(f"{one.cost_before:g}", f"{one.cost:g}"),
        _change(one.risk_before or "none", one.risk),
    )


def _change(before: str, after: str) -> str:
    return after if before == after else f"{before} → {after}"
