"""The parts of every panel: a surface and a heading."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import label, row

HEADING = 36


class Panel(QWidget):
    """A surface with a column of widgets."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName(name.lower())
        self.setAccessibleName(plain_text(name))
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.column = QVBoxLayout(self)
        self.column.setContentsMargins(0, 0, 0, 0)
        self.column.setSpacing(0)


class Heading(QWidget):
    """The title of a panel at the left, a small text at the right."""

    def __init__(self, title: str, right: str = "", parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.title = label(title, "heading")
        self.right: QLabel = label(right, "small")
        layout = row(self.title, None, self.right)
        layout.setContentsMargins(12, 0, 12, 0)
        self.setLayout(layout)
        self.setFixedHeight(HEADING)
