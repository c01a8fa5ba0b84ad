"""A dialog with what another program's form does not hold."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QDialog, QPushButton, QVBoxLayout, QWidget

from smsl_studio.exchange.findings import ExchangeFinding
from smsl_studio.legible import one_line
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted


class FindingsDialog(QDialog):
    """A list of findings. It does not stop the work in the window."""

    def __init__(
        self,
        title: str,
        said: str,
        findings: Sequence[ExchangeFinding],
        tokens: Tokens,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(f"{title}: what was left out or changed")
        self._lines = [_words(one) for one in findings]
        self.rows = RowsView(tokens, self)
        self.rows.setAccessibleName("What was left out or changed")
        self.rows.show_rows([ListRow(words, words) for words in self._lines])
        self.rows.selectionModel().currentChanged.connect(lambda *_: self._show())
        self.whole = label("", "second")
        self.whole.setWordWrap(True)
        self.whole.setTextFormat(Qt.TextFormat.PlainText)
        copy = QPushButton("Copy")
        copy.clicked.connect(self.copy)
        close = QPushButton("Close")
        close.setDefault(True)
        close.clicked.connect(self.accept)
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 16, 16, 16)
        column.setSpacing(8)
        head = label(f"{one_line(said)} {counted(len(findings), 'finding')}:", "second")
        head.setTextFormat(Qt.TextFormat.PlainText)
        column.addWidget(head)
        column.addWidget(self.rows, 1)
        column.addWidget(self.whole)
        column.addLayout(row(copy, None, close))
        open_at(self, 720, 420)
        self.rows.setCurrentIndex(self.rows.rows.index(0))
        self.rows.setFocus()

    def copy(self) -> None:
        """Copy all findings as lines of text."""
        QGuiApplication.clipboard().setText("\n".join(self._lines))

    def _show(self) -> None:
        self.whole.setText(str(self.rows.current_payload or ""))


def _words(one: ExchangeFinding) -> str:
    place = f"line {one.line}: " if one.line else ""
    address = f"{one.address}: " if one.address else ""
    return one_line(f"{place}{address}{one.message}")
