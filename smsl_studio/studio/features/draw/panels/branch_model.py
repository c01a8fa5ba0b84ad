"""The rows of the table of an SB: one for each operation, and one for a state without any."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.picture.picture import Picture
from smsl_studio.studio.base.canvas.element_details import (
    facts_told,
    operation_details,
    state_details,
)
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import BLANK, whole_sentence
from smsl_studio.studio.features.draw.panels.finding_rows import named, place_in

Index = QModelIndex | QPersistentModelIndex
HEADS = ("State", "Facts", "Operation", "Target", "Details", "Findings")
STATE, FACTS, OPERATION, TARGET, DETAILS, FINDINGS = range(len(HEADS))
Role = Qt.ItemDataRole


class BranchModel(QAbstractTableModel):
    """The states and operations of one SB, in the order of the file.

    The words of a row are made when they are shown, because an SB may have many operations.
    """

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.rows: tuple[Address, ...] = ()
        self._picture: Picture | None = None
        self._findings: dict[Address, list[Finding]] = {}

    def show_branch(self, blueprint: Blueprint, branch: str) -> None:
        """Show an SB; a name that does not exist shows nothing."""
        self.beginResetModel()
        shown = blueprint.branches.get(branch)
        self._picture = Picture(blueprint, branch) if shown is not None else None
        rows: list[Address] = []
        for state, operations in shown.table.items() if shown is not None else ():
            rows += [Address(branch, state, name) for name in operations or ("",)]
        self.rows = tuple(rows)
        self.endResetModel()

    def set_findings(self, findings: Sequence[Finding]) -> None:
        """Tell these findings in the rows of their elements."""
        self._findings = {}
        for finding in findings:
            for address in finding.addresses:
                self._findings.setdefault(address, []).append(finding)
        if self.rows:
            last = self.index(len(self.rows) - 1, FINDINGS)
            self.dataChanged.emit(self.index(0, FINDINGS), last)

    def address(self, row: int, column: int) -> Address:
        """The element of a cell: the operation, or its state in the columns about states."""
        found = self.rows[row]
        return Address(found.branch, found.state) if column < OPERATION else found

    def row_of(self, address: Address) -> int:
        """The row of an operation, or the first row of a state; -1 if there is none."""
        for row, found in enumerate(self.rows):
            same = found.branch == address.branch and found.state == address.state
            if same and address.operation in ("", found.operation):
                return row
        return -1

    def target(self, row: int) -> Address | None:
        """The state that the operation of a row leads to; None if there is no such state."""
        found, picture = self.rows[row], self._picture
        if picture is None or not found.operation:
            return None
        target = picture.branch.table[found.state][found.operation]
        return Address(found.branch, target) if target in picture.branch.table else None

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The number of rows; a row has no children."""
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The number of columns."""
        return 0 if parent.isValid() else len(HEADS)

    def headerData(self, section: int, way: Qt.Orientation, role: int = Role.DisplayRole) -> Any:
        """The titles of the columns; for a row its element, for assistive tools."""
        if role != Role.DisplayRole:
            return None
        if way is Qt.Orientation.Horizontal:
            return HEADS[section]
        found = self.rows[section]
        return f"{found.state} {found.operation}".strip()

    def data(self, index: Index, role: int = Role.DisplayRole) -> Any:
        """The text of a cell, also as its tooltip. A screen reader says "none" for an empty one."""
        if role not in (Role.DisplayRole, Role.AccessibleTextRole, Role.ToolTipRole):
            return None
        words = self._words(index.row(), index.column())
        if role == Role.ToolTipRole:
            return tip_text(words)
        return words or (BLANK if role == Role.AccessibleTextRole else "")

    def _words(self, row: int, column: int) -> str:
        found, picture = self.rows[row], self._picture
        assert picture is not None
        branch = picture.branch
        if column == STATE:
            return _with_marks(found.state, branch.initial, branch.activating)
        if column == FACTS:
            return facts_told(branch, found.state)
        if column == FINDINGS:
            return self._told(found)
        if not found.operation:
            return state_details(branch, found.state) if column == DETAILS else ""
        if column == OPERATION:
            return found.operation
        if column == TARGET:
            return branch.table[found.state][found.operation]
        return operation_details(picture, picture.edge(found))

    def _told(self, found: Address) -> str:
        state = Address(found.branch, found.state)
        own: Mapping[Address, None] = dict.fromkeys((found, state))
        about = [finding for one in own for finding in self._findings.get(one, ())]
        return " ".join(_finding_told(finding, own) for finding in about)


def _finding_told(finding: Finding, here: Collection[Address]) -> str:
    """A finding in the row of one of its places: ``Note R17: leads back to its own state.``

    Its sentence may name the elements of its first place, so another place says which one that is.
    """
    first = finding.address
    other = "" if first in here else f", as at {place_in(finding, first)}"
    return f"{named(finding)}{other}: {whole_sentence(finding)}"


def _with_marks(state: str, initial: str, activating: str) -> str:
    marks = [word for word, one in (("initial", initial), ("activating", activating))
             if one == state]  # fmt: skip
    return f"{state} ({', '.join(marks)})" if marks else state
