"""The table of actions as Qt actions: enabled, checked and called."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMainWindow
from pytestqt.qtbot import QtBot

from smsl_studio.studio.base.actions import Action, Actions
from smsl_studio.studio.base.theme import LIGHT


def test_an_action_is_called_and_every_condition_asked_again(qtbot: QtBot) -> None:
    window, told = QMainWindow(), []
    qtbot.addWidget(window)
    table = (
        Action("once", "Once", lambda: told.append("once"), enabled=lambda: not told),
        Action("after", "After", lambda: told.append("after"), enabled=lambda: bool(told)),
        Action("on", "On", lambda: None, checked=lambda: bool(told)),
    )
    actions = Actions(table, window, LIGHT)
    assert (actions["once"].isEnabled(), actions["after"].isEnabled()) == (True, False)
    actions["once"].trigger()
    assert told == ["once"]
    assert (actions["once"].isEnabled(), actions["after"].isEnabled()) == (False, True)
    assert actions["on"].isChecked()


def test_keys_of_the_canvas_are_said_and_not_taken(qtbot: QtBot) -> None:
    window = QMainWindow()
    qtbot.addWidget(window)
    actions = Actions(
        (
            Action("a", "Add", lambda: None, keys=("Del",), scope="canvas"),
            Action("b", "Build…", lambda: None, keys=("Ctrl+B",), tip="Build it"),
        ),
        window,
        LIGHT,
    )
    assert actions["a"].text() == "Add"
    assert actions["a"].shortcut().toString() == "Del"
    assert actions["a"].shortcutContext() is Qt.ShortcutContext.WidgetShortcut
    assert actions["a"] not in window.actions(), "the canvas answers it"
    assert actions["b"].toolTip() == "Build it (Ctrl+B)"


def test_a_menu_is_ordered_by_section(qtbot: QtBot) -> None:
    window = QMainWindow()
    qtbot.addWidget(window)
    table = [
        Action("z", "Z", lambda: None, "File", section=1),
        Action("a", "A", lambda: None, "File"),
        Action("x", "X", lambda: None, "Edit"),
    ]
    actions = Actions(table, window, LIGHT)
    assert [action.id for action in actions.in_menu("File")] == ["a", "z"]
