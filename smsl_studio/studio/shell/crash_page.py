"""The page about a failure of the program: it is read first, and kept only if the person wants."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import (
    QDialog,
    QPlainTextEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.file_dialogs import ask_to_save
from smsl_studio.studio.base.lines.line import Sentence
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.theme import mono_font
from smsl_studio.studio.shell.crash_report import file_name, report

ABOUT = (
    "This is all that a report would have. Nothing was written or sent. Read it, take out what "
    "others should not see, and keep it if you want to tell somebody."
)


def crash_page(sentence: str, told: str, parent: QWidget) -> CrashPage:
    """A page that is deleted after it was closed."""
    made = CrashPage(sentence, told, parent)
    made.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    return made


class CrashPage(QDialog):
    """Shows the report of a failure. The text can be changed before it is kept or copied."""

    def __init__(self, sentence: str, told: str, parent: QWidget) -> None:
        super().__init__(parent)
        self._when = datetime.now().astimezone()
        self.setWindowTitle("A failure of the program")
        open_at(self, 760, 560)
        self.ask: Callable[[str], str] = self._ask
        """Asks for the place of the file, given its proposed name; empty if the person cancels."""
        heading = label(sentence, "heading")
        heading.setWordWrap(True)
        self.text = QPlainTextEdit(report(told, self._when))
        self.text.setFont(mono_font(12))
        self.text.setProperty("role", "field")
        self.text.setAccessibleName("Report")
        self.text.setTabChangesFocus(True)
        self.refusal = Sentence("refusal")
        self.said = Sentence("hint")
        self.keep, self.copy = QPushButton("Keep as a file…"), QPushButton("Copy")
        self.leave = QPushButton("Close")
        for button in (self.keep, self.copy, self.leave):
            button.setAutoDefault(False)
        self.keep.clicked.connect(self._keep)
        self.copy.clicked.connect(self._copy)
        self.leave.clicked.connect(self.accept)
        column = QVBoxLayout(self)
        column.setContentsMargins(20, 16, 20, 16)
        column.setSpacing(10)
        column.addWidget(heading)
        column.addWidget(label(ABOUT, "hint"))
        column.addWidget(self.text, 1)
        column.addWidget(self.refusal)
        column.addWidget(self.said)
        column.addLayout(row(self.keep, self.copy, None, self.leave))

    def _ask(self, name: str) -> str:
        place = str(Path.home() / name)
        return ask_to_save(self, "Keep the report", place)[0]

    def _keep(self) -> None:
        name = self.ask(file_name(self._when))
        if not name:
            return
        self.refusal.say("")
        try:
            Path(name).write_text(self.text.toPlainText(), encoding="utf-8")
        except OSError as error:
            self.refusal.say(f"{name} was not written: {error.strerror}. Choose another folder.")
        else:
            self.said.say(f"Kept as {name}.")

    def _copy(self) -> None:
        QGuiApplication.clipboard().setText(self.text.toPlainText())
        self.said.say("Copied.")
