"""One thing at a time has the keyboard focus in the tree of assistive tools."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtWidgets import QApplication, QComboBox

from smsl_studio.studio.shell.accessible_factory import install
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
NAME = QAccessible.Text.Name


@pytest.fixture(autouse=True)
def _tree(qapp: QApplication) -> None:
    """The program installs it when it starts."""
    install(qapp)


def parts(found: QAccessibleInterface) -> Iterator[QAccessibleInterface]:
    """An interface and all below it."""
    yield found
    for at in range(found.childCount()):
        below = found.child(at)
        if below is not None:
            yield from parts(below)


def focused(person: Person) -> list[str]:
    """The roles and names of all that say that they have the keyboard focus."""
    window = QAccessible.queryAccessibleInterface(person.window)
    return [f"{one.role().name}: {one.text(NAME)}" for one in parts(window) if one.state().focused]


@pytest.mark.parametrize("chosen", ["SB1/State110", "SB1/State110/Operation110B"])
def test_what_is_selected_on_the_canvas(sit: Sit, chosen: str) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.select(chosen)
    found = focused(person)
    assert len(found) == 1, found
    assert found[0].startswith(f"ListItem: {chosen.rsplit('/', maxsplit=1)[-1]}, ")


def test_the_lists_at_the_side_and_below(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.until_inspected()
    window = person.window
    window.outline.tree.setFocus()
    person.press(Key.Key_Down)
    found = focused(person)
    assert len(found) == 1, found
    assert found[0].startswith("TreeItem: ")
    person.ctrl(Key.Key_T)
    found = focused(person)
    assert len(found) == 1, found
    window.findings.list.setFocus()
    person.press(Key.Key_Down)
    found = focused(person)
    assert len(found) == 1, found
    assert found[0].startswith("ListItem: ")


def test_an_open_choice_and_what_its_rows_do(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    combo: QComboBox = person.window.properties.header.initial
    combo.setFocus()
    assert focused(person) == ["ComboBox: Initial state: State000"]
    entries = QAccessible.queryAccessibleInterface(combo).child(0)
    assert entries.childCount() == combo.count()
    combo.showPopup()
    found = [one.text(NAME) for one in parts(entries) if one.state().focused]
    assert found == ["State000"]
    at = combo.findText("State110")
    entries.child(at).actionInterface().doAction("Press")
    assert person.blueprint["SB1"].initial == "State110"
    assert not combo.view().isVisible()
