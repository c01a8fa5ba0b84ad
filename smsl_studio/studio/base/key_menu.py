"""Entries of a menu that show a key which another part answers."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QKeySequence


def show_key(entry: QAction, key: str) -> None:
    """Show a key at the right of an entry, without letting the entry answer it.

    The key is no part of the text, because a screen reader would read it with the tab before it.
    """
    entry.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
    entry.setShortcut(QKeySequence(key))
    entry.setShortcutVisibleInContextMenu(True)
