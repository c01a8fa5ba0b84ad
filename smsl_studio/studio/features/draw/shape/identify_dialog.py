"""A dialog with groups of states that could become a sub-SB, and what each group would save."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QDialog, QPushButton, QVBoxLayout, QWidget

from smsl_studio.generate.shapes.identify import FoundCut, Identification
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import capital, counted, series


class IdentifyDialog(QDialog):
    """The groups that were found, the best one first. Enter or a double click shows a preview."""

    chosen = Signal(object)
    """FoundCut: the person wants a preview of this group."""

    def __init__(self, found: Identification, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle("Identify sub-SBs")
        self.setModal(True)
        self.rows = RowsView(tokens, self)
        self.rows.setAccessibleName("Possible sub-SBs")
        self.rows.show_rows([_row(one) for one in found.cuts])
        self.rows.selectionModel().currentChanged.connect(lambda *_: self._show())
        self.rows.activated.connect(lambda _: self._choose())
        self.why = label("", "second")
        self.why.setWordWrap(True)
        self.preview = QPushButton("Preview…")
        self.preview.setDefault(True)
        self.preview.clicked.connect(self._choose)
        cancel = QPushButton("Cancel")
        cancel.clicked.connect(self.reject)
        said = f"{counted(len(found.cuts), 'cut')} with the same behaviour, the best first."
        if found.bound:
            said += f" Not all states were tried: the limit is {found.bound}."
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 16, 16, 16)
        column.setSpacing(8)
        column.addWidget(label(said, "second"))
        column.addWidget(self.rows, 1)
        column.addWidget(self.why)
        column.addLayout(row(None, cancel, self.preview))
        open_at(self, 640, 400)
        self.rows.setCurrentIndex(self.rows.rows.index(0))
        self.rows.setFocus()

    def _current(self) -> FoundCut | None:
        cut: FoundCut | None = self.rows.current_payload
        return cut

    def _show(self) -> None:
        found = self._current()
        self.preview.setEnabled(found is not None)
        if found is not None:
            states = series(found.cut.chosen.states[:12])
            more = len(found.cut.chosen.states) - 12
            rest = f" and {more:,} more" if more > 0 else ""
            self.why.setText(f"{states}{rest}. {capital(found.why)}")

    def _choose(self) -> None:
        found = self._current()
        # Enter in the list also presses the default button, when the dialog is already closed. The
        # second call must do nothing.
        if found is not None and self.isVisible():
            self.accept()
            self.chosen.emit(found)


def _row(found: FoundCut) -> ListRow:
    states = counted(len(found.cut.chosen.states), "state")
    saves = f"saves {counted(found.states_saved, 'state')}, {counted(found.facts_saved, 'fact')}"
    become = "becomes" if len(found.cut.chosen.states) == 1 else "become"
    words = f"{found.branch.name}: {states} {become} {found.name}"
    return ListRow(words, found, "layers", right=saves, accent=True)
