"""A menu that is used once."""

from __future__ import annotations

from PySide6.QtWidgets import QMenu, QWidget


def passing_menu(window: QWidget) -> QMenu:
    """A menu that is deleted after it was closed."""
    menu = QMenu(window)
    menu.aboutToHide.connect(menu.deleteLater)
    return menu
