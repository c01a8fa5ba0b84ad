"""Tells assistive tools which row has the keyboard focus when its list gets it.

Qt tells only that the list has it. A reader would then say the name of the list, and not where one
is in it.
"""

from __future__ import annotations

from PySide6.QtCore import QTimer
from PySide6.QtGui import QAccessible, QAccessibleEvent
from PySide6.QtWidgets import QApplication, QListView, QTabBar, QTreeView, QWidget
from shiboken6 import isValid

from smsl_studio.studio.base.canvas.canvas import Canvas


def focus_moved(before: QWidget | None, now: QWidget | None) -> None:
    """Tell of the current row, tab or element of what has the focus now, after Qt has told."""
    if now is not None and QAccessible.isActive():
        QTimer.singleShot(0, now, lambda: _tell(now))


def _tell(now: QWidget) -> None:
    if not isValid(now) or QApplication.focusWidget() is not now:
        return
    if isinstance(now, QListView | QTreeView | QTabBar | Canvas):
        inside = QAccessible.queryAccessibleInterface(now).focusChild()
        if inside is not None:
            QAccessible.updateAccessibility(QAccessibleEvent(inside, QAccessible.Event.Focus))
