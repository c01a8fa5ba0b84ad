"""PySide6 does not lose references to None (see the pin in pyproject.toml)."""

from __future__ import annotations

import sys

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

CALLS = 1000


class Painted(QWidget):
    """A widget with overridden virtuals that return None."""

    def __init__(self) -> None:
        super().__init__()
        self.painted = 0

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.fillRect(self.rect(), self.palette().window())
        painter.end()
        self.painted += 1

    def customEvent(self, event: QEvent) -> None:
        return None


def test_none_survives_a_thousand_repaints(qtbot: QtBot) -> None:
    widget = Painted()
    qtbot.addWidget(widget)
    with qtbot.waitExposed(widget):
        widget.show()
    before, painted = sys.getrefcount(None), widget.painted
    for _ in range(CALLS):
        widget.repaint()
    assert widget.painted >= painted + CALLS
    assert sys.getrefcount(None) > before - CALLS // 10


def test_none_survives_a_thousand_void_calls(qtbot: QtBot) -> None:
    watched = QObject()
    before = sys.getrefcount(None)
    for number in range(CALLS):
        watched.setObjectName(str(number))
        watched.blockSignals(False)
    assert sys.getrefcount(None) > before - CALLS // 10
