"""What the page Inspection shows while no hazard and no property is written."""

from __future__ import annotations

from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.studio.base.controls import label, row

EMPTY = (
    "No hazard and no property is written.",
    "A hazard names facts that must never hold together. A property is a sentence about the whole "
    "procedure, such as “the needle never moves before it is clamped” or “there is always a way "
    "back”. Inspection looks at everything that can happen, and shows the shortest run if it does "
    "not hold.",
)


class EmptyPage(QWidget):
    """Says what a hazard and a property are. ``add`` writes the first one."""

    def __init__(self) -> None:
        super().__init__()
        self.add = QPushButton("Add property…")
        self.add.setProperty("role", "primary")
        column = QVBoxLayout(self)
        column.setContentsMargins(14, 14, 14, 14)
        column.setSpacing(8)
        text = label(EMPTY[1], "second")
        text.setWordWrap(True)
        text.setMaximumWidth(640)
        self.title = label(EMPTY[0], "heading")
        column.addWidget(self.title)
        column.addWidget(text)
        column.addLayout(row(self.add, None))
        column.addStretch(1)
