"""A dialog that asks for a state of one SB."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QDialog, QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.front.views.states import short_name
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Field, label, row
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted


class StatePick(QDialog):
    """A list of states to choose from. Text in the field above hides the states that do not match.

    Enter or a double click chooses a state.
    """

    chosen = Signal(str, str)
    """(SB, state): the person has chosen this state."""

    def __init__(self, branch: StateBranch, here: str, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(plain_text(f"A state of {branch.name}"))
        self.setModal(True)
        self._branch = branch
        self._lines = [(name, short_name(branch, name)) for name in branch.table]
        self.search = Field()
        self.search.setPlaceholderText("A part of the name")
        self.search.setAccessibleName("Search states")
        self.search.textChanged.connect(self._narrow)
        self.rows = RowsView(tokens, self)
        self.rows.setAccessibleName("States")
        self.rows.activated.connect(lambda _: self._choose())
        self.go = QPushButton("Go there")
        self.go.setDefault(True)
        self.go.clicked.connect(self._choose)
        cancel = QPushButton("Cancel")
        cancel.clicked.connect(self.reject)
        self.said = label(counted(len(self._lines), "state"), "second")
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 16, 16, 16)
        column.setSpacing(8)
        column.addWidget(self.said)
        column.addWidget(self.search)
        column.addWidget(self.rows, 1)
        column.addLayout(row(None, cancel, self.go))
        open_at(self, 380, 420)
        self._narrow("")
        self._mark(here)
        self.search.setFocus()

    def _narrow(self, text: str) -> None:
        wanted = text.casefold()
        shown = [
            ListRow(name, name, "dot", short if short != name else "", mono=True)
            for name, short in self._lines
            if wanted in name.casefold()
        ]
        self.rows.show_rows(shown)
        if shown and not self.rows.currentIndex().isValid():
            self.rows.setCurrentIndex(self.rows.rows.index(0))
        self.go.setEnabled(bool(shown))

    def _mark(self, state: str) -> None:
        """Select the present state of the SB."""
        for at, one in enumerate(self.rows.rows.rows):
            if one.payload == state:
                self.rows.setCurrentIndex(self.rows.rows.index(at))
                self.rows.scrollTo(self.rows.currentIndex())

    def _choose(self) -> None:
        state: str | None = self.rows.current_payload
        # Enter in the list also presses the default button, when the dialog is already closed. The
        # second call must do nothing.
        if state is not None and self.isVisible():
            self.accept()
            self.chosen.emit(self._branch.name, state)
