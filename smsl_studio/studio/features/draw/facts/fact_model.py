"""The model of the list of facts."""

from __future__ import annotations

from PySide6.QtCore import QAbstractListModel, QModelIndex, Qt
from PySide6.QtWidgets import QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.features.draw.facts.fact_lines import TabledFact
from smsl_studio.studio.features.draw.facts.painter import Index


class FactModel(QAbstractListModel):
    """The lines of the list."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.lines: tuple[TabledFact, ...] = ()

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The number of facts; a fact has no children."""
        return 0 if parent.isValid() else len(self.lines)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        """The words of a fact, or the ``TabledFact`` itself."""
        line = self.lines[index.row()]
        if role == Qt.ItemDataRole.UserRole:
            return line
        said = (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole)
        return plain_text(line.words) if role in said else None

    def show(self, lines: tuple[TabledFact, ...]) -> None:
        """Replace the lines. If as many stay, only their content changes."""
        if len(lines) == len(self.lines):
            changed = [at for at, line in enumerate(lines) if line != self.lines[at]]
            self.lines = lines
            for at in changed:
                self.dataChanged.emit(self.index(at), self.index(at))
            if changed:
                self.layoutChanged.emit()
        else:
            self.beginResetModel()
            self.lines = lines
            self.endResetModel()
