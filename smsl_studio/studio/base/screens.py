"""How much room the screen of a window has, so that nothing is opened larger than it."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QRect, QSize
from PySide6.QtWidgets import QDialog, QStyle, QWidget

SIDES = 8
"""What a desktop draws beside and below a window, as far as a style can tell."""


def room(window: QWidget) -> QSize:
    """What a window may take of its screen, without the frame that a desktop draws around it."""
    return window.screen().availableGeometry().size() - _frame(window)


def place_over(window: QWidget, other: QWidget) -> None:
    """Put a window that is not shown yet over the middle of another one, its title on the screen.

    Desktops see to that for dialogs, but not for every window.
    """
    screen = other.screen().availableGeometry()
    place = QRect(QPoint(), window.size() + _frame(window))
    place.moveCenter(other.frameGeometry().center())
    place.moveRight(min(place.right(), screen.right()))
    place.moveBottom(min(place.bottom(), screen.bottom()))
    place.moveLeft(max(place.left(), screen.left()))
    place.moveTop(max(place.top(), screen.top()))
    window.move(place.topLeft())


def _frame(window: QWidget) -> QSize:
    """What a desktop draws around a window, as far as it can be told."""
    frame = window.frameGeometry().size() - window.size()
    if not window.isVisible() or frame.isEmpty():
        title = window.style().pixelMetric(QStyle.PixelMetric.PM_TitleBarHeight)
        frame = QSize(SIDES, title + SIDES)
    return frame


def open_at(dialog: QDialog, width: int, height: int) -> None:
    """Give a dialog its first size, or as much of it as its screen has room for."""
    most = room(dialog)
    dialog.setMinimumSize(dialog.minimumSize().boundedTo(most))
    dialog.resize(QSize(width, height).boundedTo(most))
