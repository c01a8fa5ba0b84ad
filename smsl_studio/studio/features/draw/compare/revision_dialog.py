"""Asks for a commit among those that touched the file, the latest first."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QDialog, QPushButton, QVBoxLayout, QWidget

from smsl_studio.front.revisions import MOST, Revision
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Field, label, row
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted


class RevisionDialog(QDialog):
    """A list of commits that gets shorter while one types; Enter or a double click chooses."""

    chosen = Signal(object)
    """Revision: the person chose this commit."""

    def __init__(
        self, name: str, revisions: Sequence[Revision], tokens: Tokens, parent: QWidget
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(plain_text(f"Compare {name} with a revision"))
        self.setModal(True)
        self._revisions = tuple(revisions)
        self.search = Field()
        self.search.setPlaceholderText("Words of the commit, its author, date or number")
        self.search.setAccessibleName("Search commits")
        self.search.textChanged.connect(self._narrow)
        self.rows = RowsView(tokens, self)
        self.rows.setAccessibleName("Commits")
        self.rows.activated.connect(lambda _: self._choose())
        self.search.returnPressed.connect(self._choose)
        self.compare = QPushButton("Compare")
        self.compare.setDefault(True)
        self.compare.clicked.connect(self._choose)
        cancel = QPushButton("Cancel")
        cancel.clicked.connect(self.reject)
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 16, 16, 16)
        column.setSpacing(8)
        touched = f"{counted(len(self._revisions), 'commit')} touched {name}"
        if len(self._revisions) == MOST:
            touched = f"The latest {MOST} commits that touched {name}"
        self.said = label(touched, "second")
        column.addWidget(self.said)
        column.addWidget(self.search)
        column.addWidget(self.rows, 1)
        column.addLayout(row(None, cancel, self.compare))
        open_at(self, 640, 420)
        self._narrow("")
        self.search.setFocus()

    def _narrow(self, text: str) -> None:
        words = text.casefold().split()
        shown = [
            ListRow(
                one.subject or one.short, one, "clock", one.author, f"{one.when[:10]}  {one.short}"
            )
            for one in self._revisions
            if all(word in _all_of(one) for word in words)
        ]
        self.rows.show_rows(shown)
        if shown:
            self.rows.setCurrentIndex(self.rows.rows.index(0))
        self.compare.setEnabled(bool(shown))

    def _choose(self) -> None:
        revision: Revision | None = self.rows.current_payload
        if revision is not None:
            self.accept()
            self.chosen.emit(revision)


def _all_of(revision: Revision) -> str:
    parts = (revision.subject, revision.author, revision.when, revision.commit)
    return " ".join(parts).casefold()
