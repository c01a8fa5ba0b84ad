"""F8 stops a run, whatever PySide takes the receiver of an event for."""

from __future__ import annotations

from typing import Any

import pytest
from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication, QSpacerItem

from smsl_studio.studio.shell.stop_key import StopKey


@pytest.mark.parametrize("watched", [QObject(), QSpacerItem(1, 1)])
def test_an_event_of_any_object_passes_and_the_key_stops(qapp: QApplication, watched: Any) -> None:
    """Where a widget was deleted, PySide gave an item of a layout in place of the next object."""
    stopped: list[bool] = []
    key = StopKey(qapp, lambda: stopped.append(True), qapp)
    assert not key.eventFilter(watched, QEvent(QEvent.Type.User))
    press = QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_F8, Qt.KeyboardModifier.NoModifier)
    assert key.eventFilter(watched, press)
    assert stopped == [True]
