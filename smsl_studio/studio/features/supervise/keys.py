"""The keys of Supervise: numbers choose, letters ask, Enter confirms, Esc drops."""

from __future__ import annotations

from typing import Protocol

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractButton, QApplication, QWidget

from smsl_studio.dispatch.supervision.table import COMMANDS

KEYS = {Qt.Key(ord(row.key)): row.word for row in COMMANDS.values() if len(row.key) == 1}
"""The words of commands by their letter keys."""


class Pressed(Protocol):
    """What the keys act on."""

    def choose(self, number: int) -> None:
        """Choose the operation with this number key."""

    def ask_for(self, word: str) -> None:
        """Ask for confirmation of the command with this word."""

    def turn_large(self) -> None:
        """Show the large layout, or the usual one again."""

    def drop(self) -> None:
        """Drop the question and what is chosen."""

    def confirm(self) -> bool:
        """Confirm the present question; returns whether there is one."""


def press(page: Pressed, key: Qt.Key) -> bool:
    """Act on a key; returns whether it means something there."""
    if Qt.Key.Key_1 <= key <= Qt.Key.Key_9:
        page.choose(key - Qt.Key.Key_0)
    elif key in KEYS:
        page.ask_for(KEYS[key])
    elif key == Qt.Key.Key_W:
        page.turn_large()
    elif key == Qt.Key.Key_Escape:
        page.drop()
    elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
        return _enter(page)
    else:
        return False
    return True


def _enter(page: Pressed) -> bool:
    """Press the button that has the focus, else confirm the present question."""
    focus = QApplication.focusWidget()
    inside = isinstance(page, QWidget) and page.isAncestorOf(focus) if focus else False
    if isinstance(focus, QAbstractButton) and inside:
        focus.click()
        return True
    return page.confirm()
