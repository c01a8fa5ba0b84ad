"""A page whose head stands elsewhere, beside the switch that shows it."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget


class HeadedPage(QWidget):
    """A page and its ``head``, a row of words and buttons."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.head = QWidget()
