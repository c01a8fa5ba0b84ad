"""The canvas without a pointer: from a state to its operations, to their targets, and back."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtWidgets import QApplication

from smsl_studio.studio.shell.accessible_factory import install
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Shift = Qt.Key, Qt.KeyboardModifier.ShiftModifier
NAME, DETAILS = QAccessible.Text.Name, QAccessible.Text.Description
FLOWS_TO, FLOWS_FROM = QAccessible.RelationFlag.FlowsTo, QAccessible.RelationFlag.FlowsFrom


@pytest.fixture(autouse=True)
def _tree(qapp: QApplication) -> None:
    """The program installs it when it starts."""
    install(qapp)


def tree_of(person: Person) -> QAccessibleInterface:
    return QAccessible.queryAccessibleInterface(person.window.canvas)


def part(person: Person, *names: str) -> QAccessibleInterface:
    """A state, or an operation of a state, by the first word of its name in the tree."""
    found = tree_of(person)
    for name in names:
        children = (found.child(at) for at in range(found.childCount()))
        found = next(one for one in children if one.text(NAME).split(",")[0] == name)
    return found


def act(thing: QAccessibleInterface, name: str) -> None:
    thing.actionInterface().doAction(name)


def test_keys_lead_along_every_operation_and_back(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    table = person.blueprint["SB1"].table
    person.select("SB1/State100")
    for name in [*table["State100"], next(iter(table["State100"]))]:
        person.press(Key.Key_O)
        assert person.selected() == [f"SB1/State100/{name}"]
    person.press(Key.Key_O, [Shift])
    last = list(table["State100"])[-1]
    assert person.selected() == [f"SB1/State100/{last}"]
    person.press(Key.Key_G, [Shift])
    assert person.selected() == ["SB1/State100"]
    person.press(Key.Key_O, [Shift])
    person.press(Key.Key_G)
    assert person.selected() == [f"SB1/{table['State100'][last]}"]
    # From the state that G came to, Shift+G leads back to the operation, and then to its source.
    person.press(Key.Key_G, [Shift])
    assert person.selected() == [f"SB1/State100/{last}"]
    person.press(Key.Key_G, [Shift])
    assert person.selected() == ["SB1/State100"]
    # The menu has the same, and waits as long as it has no meaning.
    person.select("SB1/State000")
    assert not person.window.actions_table["go_to_target"].isEnabled()
    person.window.actions_table["next_operation"].trigger()
    assert person.window.actions_table["go_to_target"].isEnabled()


def test_a_state_without_operations_says_so(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    branch = person.blueprint["SB1"]
    end = next((name for name, out in branch.table.items() if not out), "")
    assert end
    person.select(f"SB1/{end}")
    person.press(Key.Key_O)
    assert person.selected() == [f"SB1/{end}"]
    assert f"No operation leaves {end}" in person.window.canvas.overlays.word.text


def test_hidden_names_are_read_when_a_key_comes_to_one(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi-corrected.json")
    canvas = person.window.canvas
    canvas.zoom_to(0.4)
    canvas.camera.finish()
    sheet = canvas.sheet
    assert sheet is not None
    hidden = [e for e in range(len(sheet.picture.operations)) if sheet.geometry.is_hidden(e)]
    assert hidden, "at this zoom some names have no room"
    address = sheet.picture.address(hidden[0])
    person.window.session.select([address])
    operations = list(person.blueprint[address.branch].table[address.state])
    for _ in operations:
        person.press(Key.Key_O)
        if person.selected() == [str(address)]:
            break
    assert "no room for" in canvas.overlays.word.text


def test_the_tree_has_relations_and_details(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    table = person.blueprint["SB1"].table
    for state, operations in table.items():
        for operation, target in operations.items():
            leads = part(person, state, operation).relations(FLOWS_FROM)
            assert [(one.text(NAME).split(",")[0], way) for one, way in leads] == [
                (target, FLOWS_FROM)
            ]
        leading = part(person, state).relations(FLOWS_TO)
        into = {(", ".join(one.text(NAME).split(", ")[:2]), way) for one, way in leading}
        expected = {
            (f"{name}, {source} to {state}", FLOWS_TO)
            for source, out in table.items()
            for name, target in out.items()
            if target == state
        }
        assert into == expected
    assert "Fact 2 is expanded by SB2" in part(person, "State100").text(DETAILS)
    assert "Fact 1: 1" in part(person, "State100").text(DETAILS)
    assert "Cost 1." in part(person, "State000", "Operation000").text(DETAILS)


def test_the_acts_of_the_tree_do_what_the_keys_do(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    window = person.window
    act(part(person, "State100"), "Press")
    assert person.selected() == ["SB1/State100"]
    act(part(person, "State000", "Operation000"), "Go to target")
    assert person.selected() == ["SB1/State100"]
    act(part(person, "State000", "Operation000"), "Go to source")
    assert person.selected() == ["SB1/State000"]
    act(part(person, "State000"), "Rename")
    person.type("State001")
    person.press(Key.Key_Return)
    assert "State001" in person.blueprint["SB1"].table
    act(part(person, "State001"), "Add operation")
    person.type("Spin")
    person.press(Key.Key_Return)
    assert "Spin" in person.blueprint["SB1"].table["State001"]
    act(part(person, "State001", "Spin"), "Delete")
    assert "Spin" not in person.blueprint["SB1"].table["State001"]
    act(part(person, "State001"), "ShowMenu")
    person.choose_in_menu("Make initial")
    assert person.blueprint["SB1"].initial == "State001"
    act(part(person, "State001"), "Show SB2")
    assert window.session.branch == "SB2"
    # In Run mode nothing can be edited.
    person.ctrl(Key.Key_2)
    run = window.features.run.pane.canvas.canvas
    first = QAccessible.queryAccessibleInterface(run).child(0)
    assert "Rename" not in first.actionInterface().actionNames()
