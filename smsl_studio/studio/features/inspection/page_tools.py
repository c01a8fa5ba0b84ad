"""The tools at the tab of the page Inspection: what was found, in numbers, and two buttons."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QPushButton, QWidget

from smsl_studio.inspection.proof.verdict import FAILS, HOLDS, UNKNOWN
from smsl_studio.studio.base.controls import Elided, row

if TYPE_CHECKING:
    from smsl_studio.front.recovery_rows import RecoveryRow

ONE = {FAILS: "fails", UNKNOWN: "unknown", HOLDS: "holds"}
MANY = {FAILS: "fail", UNKNOWN: "unknown", HOLDS: "hold"}


class PageTools(QWidget):
    """``sum`` has the numbers, ``add`` writes something new, and ``again`` checks once more."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.sum = Elided("")
        self.sum.setProperty("role", "small")
        self.again = QPushButton("Check again")
        self.again.setProperty("role", "row")
        self.add = QPushButton("Add…")
        self.add.setAccessibleName("Add a hazard or a property")
        self.add.setProperty("role", "row")
        self.add.setToolTip("Write a hazard or a property")
        line = row(self.sum, self.add, self.again, spacing=8)
        line.setContentsMargins(0, 0, 8, 0)
        self.setLayout(line)

    def show_verdicts(self, verdicts: Sequence[str], waiting: str, looking: bool) -> None:
        """Show how many fail, are unknown and hold; or why that is not known now (``waiting``)."""
        parts = [
            f"{count} {(ONE if count == 1 else MANY)[one]}"
            for one in ONE
            if (count := verdicts.count(one))
        ]
        self.sum.setText(waiting or ", ".join(parts) if verdicts else "")
        self.sum.setVisible(bool(verdicts))
        self.again.setText("Stop looking" if looking else "Check again")
        self.again.setVisible(bool(verdicts))

    def show_ways(self, rows: Sequence[RecoveryRow]) -> None:
        """Show how many failure states have a way back."""
        found = sum(one.found for one in rows)
        self.sum.setText(f"{found:,} of {len(rows):,} have a way back" if rows else "")
        self.sum.setVisible(bool(rows))
