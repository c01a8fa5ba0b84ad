"""The keys of Supervise: numbers choose, letters ask, Enter confirms, Esc drops."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractButton, QApplication

from smsl_studio.dispatch.supervision.table import COMMANDS

if TYPE_CHECKING:
    from smsl_studio.studio.features.supervise.pane import SupervisePane

KEYS = {Qt.Key(ord(row.key)): row.word for row in COMMANDS.values() if len(row.key) == 1}
"""The words of commands by their letter keys."""


def press(pane: SupervisePane, key: Qt.Key) -> bool:
    """Act on a key; returns whether it means something there."""
    if Qt.Key.Key_1 <= key <= Qt.Key.Key_9:
        pane.choose(key - Qt.Key.Key_0)
    elif key in KEYS:
        pane.ask_for(KEYS[key])
    elif key == Qt.Key.Key_L:
        pane.set_large(not pane.is_large)
    elif key == Qt.Key.Key_Escape:
        pane.deciding.drop()
    elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
        return _enter(pane)
    else:
        return False
    return True


def _enter(pane: SupervisePane) -> bool:
    """Press the button that has the focus, else confirm the present question."""
    focus = QApplication.focusWidget()
    if isinstance(focus, QAbstractButton) and pane.isAncestorOf(focus):
        focus.click()
        return True
    return pane.deciding.confirm()
