"""The keyboard focus is seen wherever it is: each control looks otherwise with it."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication, QDialog, QLineEdit, QWidget

from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

Key = Qt.Key
AROUND = 6
"""Pixels around a control in which its ring may lie."""


DIALOGS = ("settings", "shortcuts", "levels", "persons", "monitor", "export_picture", "print",
           "compare_saved", "help_pages")  # fmt: skip
"""The actions of the window that open a dialog with controls."""


def shown(window: QWidget) -> list[QDialog]:
    """The dialogs of a window that are open."""
    return [one for one in window.findChildren(QDialog) if one.isVisible()]


def controls(window: QWidget) -> list[QWidget]:
    """Everything in a window that Tab comes to at present."""
    return [
        one
        for one in window.findChildren(QWidget)
        if one.isVisible()
        and one.isEnabled()
        and one.window() is window
        and one.focusPolicy() & Qt.FocusPolicy.TabFocus
        and one.focusProxy() is None
        and not one.visibleRegion().isEmpty()
    ]


def look(window: QWidget, one: QWidget) -> QImage:
    """A control with what is around it."""
    place = QRect(one.mapTo(window, QPoint()), one.size())
    around = place.adjusted(-AROUND, -AROUND, AROUND, AROUND)
    QApplication.processEvents()
    return window.grab(around).toImage()


def unseen(window: QWidget) -> list[str]:
    """The controls that look alike with the focus and without it. A field has its caret besides."""
    found, every = [], controls(window)
    for one in every:
        elsewhere = next(w for w in every if w is not one and not w.isAncestorOf(one))
        elsewhere.setFocus()
        before = look(window, one)
        one.setFocus(Qt.FocusReason.TabFocusReason)
        if not one.hasFocus():
            continue
        if isinstance(one, QLineEdit):
            one.deselect()
        if look(window, one) == before:
            found.append(f"{type(one).__name__} {one.accessibleName() or one.objectName()}")
    return found


@pytest.mark.parametrize("mode", ["1", "2", "3"])
def test_every_control_shows_that_it_has_the_focus(sit: Sit, mode: str) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.until_inspected()
    person.ctrl(getattr(Key, f"Key_{mode}"))
    assert len(controls(person.window)) > 6
    assert unseen(person.window) == []


def test_every_control_of_a_dialog_shows_that_it_has_the_focus(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    for action in DIALOGS:
        # The command opens the monitor in a window of its own beside Supervise.
        person.window.set_mode("supervise" if action == "monitor" else "draw")
        person.window.actions_table[action].trigger()
        person.until(lambda: bool(shown(person.window)))
        (dialog,) = shown(person.window)
        dialog.activateWindow()
        person.until(dialog.isActiveWindow)
        assert controls(dialog), action
        assert unseen(dialog) == [], action
        dialog.close()
        person.until(lambda: not shown(person.window))
