"""The dialog in which a person reads generated functions before they are allowed."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QDialog, QPlainTextEdit, QPushButton, QVBoxLayout, QWidget

from smsl_studio.errors import StudioError
from smsl_studio.front.installed import allow_generated
from smsl_studio.legible import whole_text
from smsl_studio.library.generated_proposal import GeneratedProposal
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.theme import mono_font
from smsl_studio.studio.base.words import refusal_words

EXPLAINED = (
    "What differs from the code that was allowed before. Nothing of it has run. Allowed, it runs "
    "in the process of a run alone, and counts in a simulated world once its sweep has passed."
)


class FunctionsDialog(QDialog):
    """Shows the difference. Exactly what is shown can be allowed."""

    allowed = Signal()

    def __init__(self, proposal: GeneratedProposal, parent: QWidget) -> None:
        super().__init__(parent)
        self._proposal = proposal
        self.setWindowTitle("Read functions")
        self.difference = QPlainTextEdit(whole_text(proposal.difference()))
        self.difference.setReadOnly(True)
        self.difference.setFont(mono_font(12))
        self.difference.setAccessibleName("Difference")
        self.difference.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self.refusal = label("", "refusal")
        self.allow, self.later = QPushButton("Allow what I have read"), QPushButton("Not now")
        self.allow.setAutoDefault(False)
        self.later.setDefault(True)
        self.allow.clicked.connect(self._allow)
        self.later.clicked.connect(self.reject)
        digest = label(f"SHA-256 {proposal.digest}", "mono")
        column = QVBoxLayout(self)
        column.addWidget(label(EXPLAINED, "hint"))
        column.addWidget(self.difference, 1)
        column.addWidget(digest)
        column.addWidget(self.refusal)
        column.addLayout(row(None, self.later, self.allow))
        open_at(self, 720, 520)

    def _allow(self) -> None:
        try:
            allow_generated(self._proposal, self._proposal.digest)
        except StudioError as error:
            self.refusal.setText(refusal_words(error))
            return
        self.allowed.emit()
        self.accept()
