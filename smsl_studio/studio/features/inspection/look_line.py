"""LookLine: says that a search is running, and lets the person cancel it."""

from __future__ import annotations

from PySide6.QtCore import QTimer, Signal
from PySide6.QtWidgets import QHBoxLayout, QProgressBar, QPushButton, QWidget

from smsl_studio.studio.base.controls import label

PATIENCE = 300
"""A search is shown only if it takes longer than this, because most are shorter (milliseconds)."""
BAR = 90
"""The width of the moving bar (pixels)."""


class LookLine(QWidget):
    """A sentence, a moving bar and the button Cancel. The line is hidden if there is no search."""

    cancelled = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.words = label("", "second")
        bar = QProgressBar()
        bar.setRange(0, 0)
        bar.setTextVisible(False)
        bar.setFixedSize(BAR, 8)
        bar.setAccessibleName("It goes on")
        self.cancel = QPushButton("Cancel")
        self.cancel.setProperty("role", "row")
        self.cancel.setToolTip("Stop looking")
        self.cancel.clicked.connect(self.cancelled)
        line = QHBoxLayout(self)
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(8)
        for part in (self.words, bar, self.cancel):
            line.addWidget(part)
        line.addStretch(1)
        self._later = QTimer(self)
        self._later.setSingleShot(True)
        self._later.setInterval(PATIENCE)
        self._later.timeout.connect(self.show)
        self.hide()

    def show_work(self, words: str) -> None:
        """Show what is searched, after ``PATIENCE``. An empty text hides the line."""
        self.words.setText(words)
        if not words:
            self._later.stop()
            self.hide()
        elif not self._later.isActive() and self.isHidden():
            self._later.start()
