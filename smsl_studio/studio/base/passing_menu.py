"""A menu that is used once."""

from __future__ import annotations

from PySide6.QtWidgets import QMenu, QWidget

from smsl_studio.legible import plain_text


def passing_menu(window: QWidget, name: str) -> QMenu:
    """A menu that is deleted after it was closed. ``name`` is for assistive tools."""
    menu = QMenu(window)
    menu.setAccessibleName(plain_text(name))
    menu.aboutToHide.connect(menu.deleteLater)
    return menu
