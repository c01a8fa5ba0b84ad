"""The rows of hazards and properties as a table model."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import (
    QAbstractTableModel,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QSize,
    Qt,
)
from PySide6.QtGui import QColor, QFont, QIcon

from smsl_studio.blueprint.address import Address
from smsl_studio.front.claim_rows import KIND_WORDS, ClaimRow
from smsl_studio.inspection.proof.verdict import FAILS, HOLDS, UNKNOWN
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.base.tips import tip_text

Index = QModelIndex | QPersistentModelIndex
Role = Qt.ItemDataRole
HEADS = ("Verdict", "Property", "Kind", "Holds if", "Looked at", "Severity")
VERDICT, NAME, KIND, SENTENCE, LOOKED_AT, SEVERITY = range(len(HEADS))
WORDS = {FAILS: "Fails", UNKNOWN: "Unknown", HOLDS: "Holds"}
PICTURES = {FAILS: "error", UNKNOWN: "unknown", HOLDS: "check"}
SEVERITIES = {"E": "error", "W": "warning"}
CHANGED, STOPPED, NEW = "Changed since checked", "Stopped looking", "Not answered yet"
HIGH = 27


class ClaimModel(QAbstractTableModel):
    """Shows rows. Those that are ``waiting`` have no verdict: nothing old is shown as true."""

    def __init__(self, tokens: Tokens, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.rows: tuple[ClaimRow, ...] = ()
        self.waiting = ""
        """Why no verdict is shown now; empty if the verdicts count."""
        self.set_tokens(tokens)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._inks = {FAILS: tokens.bad, UNKNOWN: tokens.unk, HOLDS: tokens.ok}
        self._icons = {
            verdict: icon(PICTURES[verdict], tokens, 16, ink) for verdict, ink in self._inks.items()
        }
        self._pale = tokens.tx2
        self._changed()

    def show_rows(self, rows: tuple[ClaimRow, ...]) -> None:
        """Replace the rows. Their verdicts count."""
        self.beginResetModel()
        self.rows, self.waiting = rows, ""
        self.endResetModel()

    def wait(self, why: str) -> None:
        """Show every verdict as unknown."""
        self.waiting = why
        self._changed()

    def row_of(self, address: Address) -> int:
        """The number of a row, -1 if there is none."""
        return next((at for at, row in enumerate(self.rows) if row.address == address), -1)

    def verdict(self, row: ClaimRow) -> str:
        """The verdict that is shown."""
        return UNKNOWN if self.waiting else row.verdict

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The number of rows; a row has no children."""
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The number of columns."""
        return 0 if parent.isValid() else len(HEADS)

    def headerData(self, section: int, way: Qt.Orientation, role: int = Role.DisplayRole) -> Any:
        """The name of a column."""
        if role == Role.DisplayRole and way == Qt.Orientation.Horizontal:
            return HEADS[section]
        return None

    def data(self, index: Index, role: int = Role.DisplayRole) -> Any:
        """The text of a cell with its ink and font, the tooltip, or the ``ClaimRow``."""
        row, column = self.rows[index.row()], index.column()
        if role == Role.DisplayRole:
            return self._text(row, column)
        if role == Role.UserRole:
            return row
        if role == Role.ToolTipRole:
            why = f"\n{row.why}" if row.why else ""
            kind = KIND_WORDS.get(row.kind, row.kind)
            return tip_text(f"{row.name} ({kind})\n{row.sentence}{why}")
        if role == Role.AccessibleTextRole:
            return self._text(row, column)
        return self._look(row, column, role)

    def _text(self, row: ClaimRow, column: int) -> str:
        verdict = self.verdict(row)
        return (
            WORDS[verdict],
            row.name,
            KIND_WORDS.get(row.kind, row.kind),
            row.sentence,
            self.waiting or row.looked_at,
            SEVERITIES.get(row.severity, ""),
        )[column]

    def _look(self, row: ClaimRow, column: int, role: int) -> QIcon | QColor | QFont | QSize | None:
        verdict = self.verdict(row)
        if role == Role.DecorationRole and column == VERDICT:
            return self._icons[verdict]
        if role == Role.ForegroundRole:
            if column == VERDICT:
                return self._inks[verdict]
            return self._pale if column in (KIND, LOOKED_AT, SEVERITY) else None
        if role == Role.FontRole and (column == VERDICT or (column == NAME and verdict == FAILS)):
            return text_font(13, 600)
        return QSize(10, HIGH) if role == Role.SizeHintRole else None

    def _changed(self) -> None:
        if self.rows:
            last = self.index(len(self.rows) - 1, len(HEADS) - 1)
            self.dataChanged.emit(self.index(0, 0), last)
