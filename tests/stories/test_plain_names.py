"""A state with a plain name, such as Idle, is that name and not a row of facts."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.json_form import parse_json
from tests.stories.conftest import Sit
from tests.stories.person import Person

Key = Qt.Key


def read(value: object) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(value), "plain.json"))


def add(person: Person, name: str, at: QPoint) -> None:
    person.double_click_canvas(at)
    person.type(name)
    person.press(Key.Key_Return)


@pytest.mark.parametrize("names", [("Idle",), ("Idle", "Wait"), ("S1", "S2"), ("Idle", "Ready")])
def test_plain_names_make_no_facts(sit: Sit, names: tuple[str, ...]) -> None:
    person = sit()
    before = person.blueprint.document.text
    for number, name in enumerate(names):
        add(person, name, QPoint(300 + 200 * number, 300))
    branch = person.blueprint["SB1"]
    assert list(branch.table) == list(names)
    assert branch.shape.opaque
    sheet = person.window.canvas.sheet
    assert sheet is not None
    assert sheet.picture.face(0).chips == ()
    assert person.steps() == [f"Add {name}" for name in names]
    person.ctrl(Key.Key_T)
    facts = person.window.facts
    person.until(facts.none.isVisible)
    assert facts.none.text() == "No facts yet."
    assert facts.first.isVisible()
    for _ in names:
        person.window.session.history.undo()
    assert person.blueprint.document.text == before


def test_a_state_that_gets_a_plain_name_has_no_facts_either(sit: Sit) -> None:
    person = sit()
    add(person, "State0", QPoint(300, 300))
    assert person.blueprint["SB1"].num_facts == 1
    assert not person.blueprint["SB1"].shape.opaque
    person.press(Key.Key_F2)
    person.type("Idle")
    person.press(Key.Key_Return)
    assert person.blueprint["SB1"].shape.opaque


def test_facts_are_added_to_plain_names_separately(sit: Sit) -> None:
    person = sit()
    add(person, "Idle", QPoint(300, 300))
    person.ctrl(Key.Key_T)
    person.click(person.window.facts.first)
    person.press(Key.Key_Return)
    branch = person.blueprint["SB1"]
    assert (branch.num_facts, branch.facts("Idle"), list(branch.table)) == (1, ("0",), ["Idle"])
    person.window.canvas.setFocus()
    add(person, "Done", QPoint(500, 300))
    branch = person.blueprint["SB1"]
    assert (branch.num_facts, branch.facts("Idle"), branch.facts("Done")) == (1, ("0",), ("1",))


def test_a_table_of_plain_names_is_pasted_without_facts(sit: Sit) -> None:
    person = sit()
    QApplication.clipboard().setText("Idle\tgo\tWait\nWait\tback\tIdle\n")
    person.window.canvas.setFocus()
    person.ctrl(Key.Key_V)
    person.until(person.window.clipping.table_card.isVisible)
    person.press(Key.Key_Return)
    assert list(person.blueprint["SB1"].table) == ["Idle", "Wait"]
    assert person.blueprint["SB1"].shape.opaque


@pytest.mark.parametrize("name", ["State_01", "State0", "01", "State_aaa", "x_a", "a1"])
def test_names_of_digits_carry_facts(name: str) -> None:
    before = read({"SB1": {}})
    after = edit.add_state(before, "SB1", name)
    assert edit.keep_plain_names(before, after) is after


def test_what_was_read_as_facts_before_stays_so() -> None:
    before = read({"SB1": {"Aaa": {}, "Aab": {}}})
    after = edit.add_state(before, "SB1", "Abb")
    assert edit.keep_plain_names(before, after) is after
    declared = read({"SB1": {"HEADER": {"NUM_FACTS": 2}}})
    after = edit.add_state(declared, "SB1", "Idle")
    assert edit.keep_plain_names(declared, after) is after


def test_names_of_one_length_that_are_left_are_no_facts() -> None:
    before = read({"SB1": {"Idle": {}, "Ready": {}}})
    after = edit.delete(before, [Address("SB1", "Ready")])
    assert not after["SB1"].shape.opaque
    assert edit.keep_plain_names(before, after)["SB1"].header.num_facts == 0


def test_num_facts_0_can_be_set_and_left(tmp_path: Path) -> None:
    before = read({"SB1": {"State_0": {}, "State_1": {}}})
    none = edit.set_header(before, "SB1", "NUM_FACTS", 0)
    assert none["SB1"].shape.opaque
    assert edit.set_header(none, "SB1", "NUM_FACTS", None) == before
