"""A new state beside states whose facts stand in ``_states`` gets its facts there, too."""

from __future__ import annotations

import json

from PySide6.QtCore import QPoint, Qt

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.json_form import parse_json
from tests.stories.conftest import Sit
from tests.stories.person import Person

Key = Qt.Key


def add(person: Person, name: str, at: QPoint) -> None:
    person.double_click_canvas(at)
    person.type(name)
    person.press(Key.Key_Return)


def test_a_state_that_is_drawn_later_has_facts_of_its_own(sit: Sit) -> None:
    person = sit()
    add(person, "Idle", QPoint(300, 300))
    add(person, "Ready", QPoint(500, 300))
    person.ctrl(Key.Key_T)
    person.click(person.window.facts.first)
    person.press(Key.Key_Return)
    assert person.blueprint["SB1"].facts("Idle") == ("0",)
    person.window.canvas.setFocus()
    before = person.blueprint.document.text
    add(person, "Done", QPoint(700, 300))
    branch = person.blueprint["SB1"]
    assert (branch.num_facts, branch.facts("Idle"), branch.facts("Done")) == (1, ("0",), ("1",))
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == before


def test_an_edit_that_adds_no_state_changes_no_facts() -> None:
    given = {"SB1": {"Idle": {}, "Done": {}, "_states": {"Idle": {"facts": ["0"]},
                                                         "Done": {"facts": ["1"]}}}}  # fmt: skip
    before = read_blueprint(parse_json(json.dumps(given), "given.json"))
    after = edit.add_operation(before, "SB1", "Idle", "go", "Done")
    assert edit.give_facts(before, after) is after
    third = edit.give_facts(before, edit.add_state(before, "SB1", "Third"))
    assert third["SB1"].facts("Third") == ("0",)
