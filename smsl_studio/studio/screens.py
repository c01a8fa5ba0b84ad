"""How much room the screen of a window has, so that nothing is opened larger than it."""

from __future__ import annotations

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QDialog, QStyle, QWidget

SIDES = 8
"""What a desktop draws beside and below a window, as far as a style can tell."""


def room(window: QWidget) -> QSize:
    """What a window may take of its screen, without the frame that a desktop draws around it."""
    frame = window.frameGeometry().size() - window.size()
    if not window.isVisible() or frame.isEmpty():
        title = window.style().pixelMetric(QStyle.PixelMetric.PM_TitleBarHeight)
        frame = QSize(SIDES, title + SIDES)
    return window.screen().availableGeometry().size() - frame


def open_at(dialog: QDialog, width: int, height: int) -> None:
    """Give a dialog its first size, or as much of it as its screen has room for."""
    most = room(dialog)
    dialog.setMinimumSize(dialog.minimumSize().boundedTo(most))
    dialog.resize(QSize(width, height).boundedTo(most))
