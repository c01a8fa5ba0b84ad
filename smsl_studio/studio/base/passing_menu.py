"""A menu for one time."""

from __future__ import annotations

from PySide6.QtWidgets import QMenu, QWidget


def passing_menu(window: QWidget) -> QMenu:
    """A menu for one time; it goes when it is left."""
    menu = QMenu(window)
    menu.aboutToHide.connect(menu.deleteLater)
    return menu
