"""An operation is renamed here only or everywhere: the name field and Properties ask where."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.smsl.json_form import parse_json, write_json
from smsl_studio.studio.base.overlays.choices import ROW
from smsl_studio.studio.features.draw.canvas.rename_field import RenameField
from tests.stories.conftest import Sit
from tests.stories.person import LEFT, SAMPLES, Person

Key = Qt.Key
HANOI = SAMPLES / "hanoi.json"
VALUES = {
    "_levels": {"SB1/go": "human", "SB1/State1/go": "shared", "SB2/go": "shared"},
    "SB1": {
        "State0": {"go": "State1", "back": "State0"},
        "State1": {"go": "State2"},
        "State2": {"once": "State0"},
        "_operations": {
            "go": {"cost": 2, "requires": {"SB2/0": "1"}},
            "State1/go": {"risk": "low"},
        },
    },
    "SB2": {"State0": {"go": "State1"}, "State1": {}},
}
A = Address


def blueprint() -> Blueprint:
    return read_blueprint(parse_json(write_json(VALUES), "f.json"))


@pytest.fixture
def person(sit: Sit, tmp_path: Path) -> Person:
    path = tmp_path / "go.json"
    path.write_text(json.dumps(VALUES, indent=4))
    return sit(path)


def edges(blueprint: Blueprint, name: str) -> list[str]:
    return [f"{branch.name}/{state}" for branch in blueprint
            for state, operations in branch.table.items() if name in operations]  # fmt: skip


def type_name(person: Person, at: str, name: str) -> None:
    """Select an operation, press F2 and type a new name. Nothing is renamed yet."""
    person.select(at)
    person.press(Key.Key_F2)
    person.type(name)


def rename_field(person: Person) -> RenameField:
    """The field that asks where."""
    field = person.window.editor.field
    assert isinstance(field, RenameField)
    return field


# The edit


def test_edges_of_all_sbs_are_renamed_and_all_that_names_them_follows() -> None:
    before = blueprint()
    chosen = [A("SB1", "State0", "go"), A("SB1", "State1", "go"), A("SB2", "State0", "go")]
    after = edit.rename_operations(before, chosen, "move")
    assert edges(after, "move") == ["SB1/State0", "SB1/State1", "SB2/State0"]
    assert list(after["SB1"].table["State0"]) == ["move", "back"], "in its place"
    assert after["SB1"].fields["_operations"] == {
        "move": {"cost": 2, "requires": {"SB2/0": "1"}}, "State1/move": {"risk": "low"}
    }  # fmt: skip
    assert after.levels == {
        "SB1/move": "human", "SB1/State1/move": "shared", "SB2/move": "shared"
    }  # fmt: skip
    back = edit.rename_operations(after, [A(a.branch, a.state, "move") for a in chosen], "go")
    assert back.document.text == before.document.text


def test_some_edges_of_a_name_leave_the_entries_of_the_name_to_the_others() -> None:
    after = edit.rename_operations(blueprint(), [A("SB1", "State1", "go")], "move")
    assert after["SB1"].fields["_operations"]["go"]["cost"] == 2
    own = after["SB1"].fields["_operations"]["State1/move"]
    assert own == {"cost": 2, "requires": {"SB2/0": "1"}, "risk": "low"}
    assert (after.levels["SB1/go"], after.levels["SB1/State1/move"]) == ("human", "shared")


@pytest.mark.parametrize(
    ("chosen", "name", "words"),
    [
        ([A("SB1", "State0", "go")], "back", "in State0 an operation 'back'"),
        ([A("SB1", "State0", "go"), A("SB1", "State0", "back")], "x", "several names"),
        ([A("SB1", "State0")], "x", "is no operation"),
        ([A("SB1", "State0", "go")], "", "needs a name"),
        ([A("SB1", "State0", "gone")], "x", "no operation 'gone'"),
    ],
)
def test_edges_that_cannot_get_one_name_are_refused(
    chosen: list[Address], name: str, words: str
) -> None:
    with pytest.raises(EditRefused, match=words):
        edit.rename_operations(blueprint(), chosen, name)


# On the canvas


def test_enter_renames_here_only_and_the_number_of_places_is_told(person: Person) -> None:
    person.select("SB1/State0/go")
    person.press(Key.Key_F2)
    field = rename_field(person)
    assert field.choices.names == ("Here only", "All 2 in SB1", "All 3 in 2 State Branches")
    person.type("start")
    person.press(Key.Key_Return)
    assert edges(person.blueprint, "go") == ["SB1/State1", "SB2/State0"]
    assert person.steps() == ["Rename go to start"]
    assert person.selected() == ["SB1/State0/start"]


@pytest.mark.parametrize(("downs", "left"), [(1, ["SB2/State0"]), (2, [])])
def test_arrows_choose_where_and_all_of_it_is_one_step(
    person: Person, downs: int, left: list[str]
) -> None:
    before = person.blueprint.document.text
    type_name(person, "SB1/State1/go", "move")
    for _ in range(downs):
        person.press(Key.Key_Down)
    field = rename_field(person)
    assert field.scope.words in field.field.accessibleDescription()
    person.press(Key.Key_Return)
    assert edges(person.blueprint, "go") == left
    assert person.steps() == [f"Rename go to move in {downs + 1} places"]
    assert person.selected() == ["SB1/State1/move"]
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == before


def test_a_click_on_an_answer_renames_at_once(person: Person) -> None:
    type_name(person, "SB1/State0/go", "move")
    choices = rename_field(person).choices
    QTest.mouseClick(choices, LEFT, pos=QPoint(40, ROW + ROW // 2))
    assert edges(person.blueprint, "move") == ["SB1/State0", "SB1/State1"]
    assert person.window.editor.field is None


def test_a_name_that_is_taken_somewhere_is_refused_in_the_field(person: Person) -> None:
    type_name(person, "SB1/State1/go", "back")
    person.press(Key.Key_Down)
    person.press(Key.Key_Return)
    assert "in State0 an operation 'back'" in rename_field(person).complaint
    assert person.steps() == []
    person.press(Key.Key_Up)
    person.press(Key.Key_Return)
    assert edges(person.blueprint, "back") == ["SB1/State0", "SB1/State1"]


def test_a_name_that_is_used_once_asks_nothing(person: Person) -> None:
    person.select("SB1/State2/once")
    person.press(Key.Key_F2)
    assert not isinstance(person.window.editor.field, RenameField)
    person.type("again")
    person.press(Key.Key_Return)
    assert edges(person.blueprint, "again") == ["SB1/State2"]


# In Properties


def test_properties_ask_where_and_begin_with_here_only(person: Person) -> None:
    person.select("SB1/State0/go")
    form = person.window.properties.operation
    assert [form.scope.itemText(at) for at in range(form.scope.count())] == [
        "Here only", "All 2 in SB1", "All 3 in 2 State Branches"
    ]  # fmt: skip
    person.choose(form.scope, "All 2 in SB1")
    person.write(form.name, "move")
    assert edges(person.blueprint, "go") == ["SB2/State0"]
    assert person.steps() == ["Rename go to move in 2 places"]
    assert form.scope.currentText() == "Here only", "it is asked anew"
    person.select("SB1/State2/once")
    assert not form.scope.isVisible()


def test_several_operations_of_one_name_are_renamed_together(person: Person) -> None:
    person.select("SB1/State0/go", "SB1/State1/go")
    form = person.window.properties.operation
    assert form.name.text() == "go"
    assert form.scope.currentText() == "These 2 only"
    person.write(form.name, "move")
    assert edges(person.blueprint, "go") == ["SB2/State0"]
    assert person.selected() == ["SB1/State0/move", "SB1/State1/move"]


def test_several_operations_lead_elsewhere_together(person: Person) -> None:
    before = person.blueprint.document.text
    person.select("SB1/State0/go", "SB1/State1/go")
    form = person.window.properties.operation
    assert form.target.currentText() == "Various"
    person.choose(form.target, "Various")
    assert person.steps() == []
    person.choose(form.target, "State0")
    assert person.steps() == ["Lead 2 operations to State0"]
    assert person.blueprint["SB1"].table["State1"] == {"go": "State0"}
    assert form.target.currentText() == "State0"
    person.select("SB1/State2/once", "SB1/State1/go")
    assert not form.naming.isVisible()
    assert form.target.isVisible()
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == before


def test_an_operation_of_many_states_is_renamed_in_all_of_them(sit: Sit) -> None:
    person = sit(HANOI)
    text = person.blueprint.document.text
    person.window.session.jump(person.blueprint.resolve("SB1/State_aaa/Op_1b"))
    person.window.canvas.setFocus()
    person.press(Key.Key_F2)
    places = len(edges(person.blueprint, "Op_1b"))
    person.type("Op_1x")
    person.press(Key.Key_Down)
    person.press(Key.Key_Return)
    assert len(edges(person.blueprint, "Op_1x")) == places
    assert person.steps() == [f"Rename Op_1b to Op_1x in {places} places"]
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == text


NOTED = {
    "SB1": {
        "State_0": {"go": "State_1", "halt": "State_1"},
        "State_1": {"go": "State_0", "halt": "State_0"},
        "_operations": {"go": {"requires": {"SB1/0": "1"}, "cost": 2}, "halt": {"cost": 7}},
    }
}


@pytest.fixture
def noted(sit: Sit, tmp_path: Path) -> Person:
    path = tmp_path / "noted.json"
    path.write_text(json.dumps(NOTED, indent=4))
    return sit(path)


def test_here_only_keeps_what_the_name_required(noted: Person) -> None:
    before = noted.blueprint.document.text
    type_name(noted, "SB1/State_0/go", "start")
    noted.press(Key.Key_Return)
    note = noted.blueprint["SB1"].operation_note("State_0", "start")
    assert dict(note.requires) == {"SB1/0": "1"}
    assert note.cost == 2
    assert noted.steps() == ["Rename go to start"]
    noted.ctrl(Key.Key_Z)
    assert noted.blueprint.document.text == before


def test_what_another_name_says_is_told_before_it_counts(noted: Person) -> None:
    noted.select("SB1/State_0/halt")
    noted.press(Key.Key_Delete)
    type_name(noted, "SB1/State_0/go", "halt")
    noted.press(Key.Key_Return)
    assert "halt has another value of cost" in rename_field(noted).complaint
    noted.press(Key.Key_Return)
    note = noted.blueprint["SB1"].operation_note("State_0", "halt")
    assert (dict(note.requires), note.cost) == ({"SB1/0": "1"}, 7)


def test_properties_tell_it_too_and_leaving_the_field_is_no_yes(noted: Person) -> None:
    noted.select("SB1/State_0/halt")
    noted.press(Key.Key_Delete)
    noted.select("SB1/State_0/go")
    form = noted.window.properties.operation
    noted.write(form.name, "halt")
    assert "halt has another value of cost" in form.naming.refusal.text()
    noted.window.canvas.setFocus()
    assert noted.steps()[1:] == []
    noted.click(form.name)
    noted.press(Key.Key_Return)
    assert noted.steps()[1:] == ["Rename go to halt"]


def test_a_function_that_is_bound_by_the_name_is_told_before_it_is_lost(sit: Sit) -> None:
    person = sit(HANOI)
    person.window.session.jump(person.blueprint.resolve("SB1/State_aaa/Op_1b"))
    person.window.canvas.setFocus()
    person.press(Key.Key_F2)
    person.type("Lift")
    person.press(Key.Key_Return)
    complaint = rename_field(person).complaint
    assert "hanoi.move_disk is bound by the name Op_1b, and nothing by Lift." in complaint
    assert person.steps() == []
    person.press(Key.Key_Return)
    assert person.steps() == ["Rename Op_1b to Lift"]
