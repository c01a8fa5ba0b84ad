"""A dialog that says why a shape cannot be changed, with a run that shows the reason."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QDialog, QPushButton, QVBoxLayout, QWidget

from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import refusal_words
from smsl_studio.studio.features.draw.shape.shape_edit import ShapeRefusal


class RefusedShape(QDialog):
    """The reason, and the operations of the shortest run that shows it."""

    run_wanted = Signal()
    """The person wants to see the run on the drawing."""

    def __init__(self, refusal: ShapeRefusal, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle("Not possible")
        self.setModal(True)
        self.said = label(refusal_words(refusal.error), "second")
        self.said.setWordWrap(True)
        self.rows = RowsView(tokens, self)
        self.rows.setAccessibleName("Run that shows why")
        self.rows.show_rows(
            [ListRow(name, name, "chevron-right", right=str(at))
             for at, name in enumerate(refusal.run, 1)]
        )  # fmt: skip
        self.walk = QPushButton("Show it on the drawing")
        self.walk.setAutoDefault(False)
        self.walk.clicked.connect(self._walk)
        close = QPushButton("Close")
        close.setDefault(True)
        close.clicked.connect(self.reject)
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 16, 16, 16)
        column.setSpacing(8)
        column.addWidget(self.said)
        column.addWidget(label("The shortest run that shows it:", "hint"))
        column.addWidget(self.rows, 1)
        column.addLayout(row(self.walk, None, close))
        open_at(self, 480, 340)

    def _walk(self) -> None:
        self.accept()
        self.run_wanted.emit()
