"""The room on a screen, so that no window is opened larger than its screen."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QRect, QSize
from PySide6.QtWidgets import QDialog, QStyle, QWidget

SIDES = 8
"""The assumed width of the frame beside and below a window (pixels)."""


def room(window: QWidget) -> QSize:
    """The largest size of a window on its screen, without the frame that the desktop adds."""
    return window.screen().availableGeometry().size() - _frame(window)


def place_over(window: QWidget, other: QWidget) -> None:
    """Put a window that is not shown yet over the middle of another one, inside the screen.

    Desktops do that for dialogs, but not for every window.
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
    """The size that the desktop's frame adds to a window, estimated if it is not shown yet."""
    frame = window.frameGeometry().size() - window.size()
    if not window.isVisible() or frame.isEmpty():
        title = window.style().pixelMetric(QStyle.PixelMetric.PM_TitleBarHeight)
        frame = QSize(SIDES, title + SIDES)
    return frame


def open_at(dialog: QDialog, width: int, height: int) -> None:
    """Give a dialog its first size (pixels), limited to its screen."""
    most = room(dialog)
    dialog.setMinimumSize(dialog.minimumSize().boundedTo(most))
    dialog.resize(QSize(width, height).boundedTo(most))
