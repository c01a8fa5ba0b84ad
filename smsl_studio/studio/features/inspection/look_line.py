"""LookLine: tells that something is being looked for, and calls it off."""

from __future__ import annotations

from PySide6.QtCore import QTimer, Signal
from PySide6.QtWidgets import QHBoxLayout, QProgressBar, QPushButton, QWidget

from smsl_studio.studio.base.controls import label

PATIENCE = 300
"""Milliseconds for which a search is not mentioned, because most end before."""
BAR = 90
"""The width of the bar that shows that work goes on (pixels)."""


class LookLine(QWidget):
    """A sentence, a moving bar and Cancel. It is hidden while nothing lasts."""

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
        """Say what is being looked for, in a moment; empty words end it."""
        self.words.setText(words)
        if not words:
            self._later.stop()
            self.hide()
        elif not self._later.isActive() and self.isHidden():
            self._later.start()
