"""How the parts of Supervise stand beside and below each other."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QFrame, QScrollArea, QSplitter, QVBoxLayout, QWidget


class Rolled(QScrollArea):
    """The left side; in a low page it scrolls, so that the question at the right stays."""

    def __init__(self, inner: QWidget) -> None:
        super().__init__()
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setWidget(inner)

    def sizeHint(self) -> QSize:
        """The size that the parts would like to have."""
        inner = self.widget()
        return inner.sizeHint() if inner is not None else super().sizeHint()

    def minimumSizeHint(self) -> QSize:
        """Wide enough for the partial view; it scrolls sideways by itself."""
        return QSize(300, 160)


def column_of(*parts: QWidget | None) -> QWidget:
    """Return a widget with these parts below each other; the second one gets all free room, and
    None is left out."""
    made = QWidget()
    column = QVBoxLayout(made)
    column.setContentsMargins(0, 0, 0, 0)
    column.setSpacing(0)
    for at, part in enumerate(parts):
        if part is not None:
            column.addWidget(part, int(at == 1))
    return made


def split_of(way: Qt.Orientation, *parts: QWidget) -> QSplitter:
    """Return a splitter with these parts."""
    made = QSplitter(way)
    made.setHandleWidth(1)
    made.setChildrenCollapsible(False)
    for part in parts:
        made.addWidget(part)
    return made
