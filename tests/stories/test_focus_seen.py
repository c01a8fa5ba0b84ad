"""The keyboard focus is seen wherever it is: each control looks otherwise with it."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication, QLineEdit, QWidget

from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
AROUND = 6
"""Pixels around a control in which its ring may lie."""


def controls(person: Person) -> list[QWidget]:
    """Everything that Tab comes to in the present mode."""
    return [
        one
        for one in person.window.findChildren(QWidget)
        if one.isVisible()
        and one.isEnabled()
        and one.window() is person.window
        and one.focusPolicy() & Qt.FocusPolicy.TabFocus
        and one.focusProxy() is None
        and not one.visibleRegion().isEmpty()
    ]


def look(person: Person, one: QWidget) -> QImage:
    """A control with what is around it."""
    place = QRect(one.mapTo(person.window, QPoint()), one.size())
    around = place.adjusted(-AROUND, -AROUND, AROUND, AROUND)
    QApplication.processEvents()
    return person.window.grab(around).toImage()


def unseen(person: Person) -> list[str]:
    """The controls that look alike with the focus and without it. A field has its caret besides."""
    found, every = [], controls(person)
    for one in every:
        elsewhere = next(w for w in every if w is not one and not w.isAncestorOf(one))
        elsewhere.setFocus()
        before = look(person, one)
        one.setFocus(Qt.FocusReason.TabFocusReason)
        if not one.hasFocus():
            continue
        if isinstance(one, QLineEdit):
            one.deselect()
        if look(person, one) == before:
            found.append(f"{type(one).__name__} {one.accessibleName() or one.objectName()}")
    return found


@pytest.mark.parametrize("mode", ["1", "2", "3"])
def test_every_control_shows_that_it_has_the_focus(sit: Sit, mode: str) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.until_inspected()
    person.ctrl(getattr(Key, f"Key_{mode}"))
    assert len(controls(person)) > 6
    assert unseen(person) == []
