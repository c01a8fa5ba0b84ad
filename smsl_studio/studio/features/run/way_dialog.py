"""The dialog that asks who proposes operations where no way leads to the goal."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QGridLayout, QLineEdit, QPushButton, QVBoxLayout, QWidget

from smsl_studio.errors import StudioError
from smsl_studio.studio.base.controls import Combo, label, row
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.words import capital
from smsl_studio.studio.running.run_session import RunSession

CHOICES = {
    "reader": ("The library itself, without a model", ""),
    "by-hand:": ("A person, by hand: a folder of answers", "the folder"),
    "replay:": ("Answers that were kept: a file", "the file, such as run.jsonl.answers.json"),
    "": ("A server: its base URL", "http://127.0.0.1:8080/v1"),
}
"""What a provider begins with, its words, and what is written behind it."""
WHY = (
    "Operations of the library are proposed that the drawing does not have. Each is inspected, "
    "tried in a simulated world and shown. It counts only if you allow it, and in this run alone. "
    "The drawing does not change."
)


class WayDialog(QDialog):
    """Asks for the provider, and calls ``ask`` with it. A StudioError of it is shown."""

    def __init__(self, ask: Callable[[str], None], parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle("Ask for a way")
        self._ask = ask
        self.who = Combo()
        self.who.setAccessibleName("Who proposes")
        for provider, (words, _) in CHOICES.items():
            self.who.addItem(words, provider)
        self.what = QLineEdit()
        self.what.setAccessibleName("Folder, file or URL")
        self.refusal = label("", "refusal")
        self.refusal.setWordWrap(True)
        self.cancel, self.use = QPushButton("Cancel"), QPushButton("Ask")
        self.use.setProperty("role", "primary")
        self.use.setDefault(True)
        self.cancel.clicked.connect(self.reject)
        self.use.clicked.connect(self.accept)
        self.who.currentIndexChanged.connect(lambda _: self._show())
        self.what.textChanged.connect(lambda _: self._show())
        why = label(WHY, "small")
        why.setWordWrap(True)
        grid = QGridLayout()
        grid.setHorizontalSpacing(12)
        grid.setVerticalSpacing(8)
        grid.setColumnStretch(1, 1)
        grid.addWidget(label("Who proposes", "second"), 0, 0)
        grid.addWidget(self.who, 0, 1)
        grid.addWidget(self.what, 1, 1)
        column = QVBoxLayout(self)
        column.addWidget(why)
        column.addLayout(grid)
        column.addWidget(self.refusal)
        column.addStretch(1)
        column.addLayout(row(None, self.cancel, self.use, spacing=8))
        open_at(self, 480, 240)
        self._show()

    @property
    def provider(self) -> str:
        """The provider that is chosen."""
        begin = self.who.currentData()
        return str(begin) if begin == "reader" else f"{begin}{self.what.text().strip()}"

    def _show(self) -> None:
        begin = self.who.currentData()
        hint = CHOICES[begin][1]
        self.what.setVisible(bool(hint))
        self.what.setPlaceholderText(hint)
        self.refusal.setText("")
        self.use.setEnabled(not hint or bool(self.what.text().strip()))

    def accept(self) -> None:
        """Ask this provider, or show why that is not possible."""
        try:
            self._ask(self.provider)
        except StudioError as error:
            self.refusal.setText(f"{capital(error.sentence)}. {error.advice}".strip())
            return
        super().accept()


def ask_for_a_way(run: RunSession, window: QWidget) -> None:
    """Ask who proposes operations that lead on, and let the run ask there."""
    dialog = WayDialog(run.ask_for_a_way, window)
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    dialog.open()
