"""A new state beside states whose facts stand in ``_states`` gets its facts there, too."""

from __future__ import annotations

import json
from pathlib import Path

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


def test_values_may_be_typed_as_names_have_them(sit: Sit, tmp_path: Path) -> None:
    facts = {"Idle": ["0", "0", "0"], "Homing": ["1", "0", "1"], "Ready": ["0", "1", "0"]}
    notes = {name: {"facts": values} for name, values in facts.items()}
    path = tmp_path / "arm.json"
    path.write_text(json.dumps({"SB1": {**{name: {} for name in facts}, "_states": notes}}))
    person = sit(path)
    person.select("SB1/Ready")
    person.write(person.window.properties.state.values, "110")
    assert person.blueprint["SB1"].facts("Ready") == ("1", "1", "0")
    person.write(person.window.properties.state.values, "1100")
    assert person.blueprint["SB1"].facts("Ready") == ("1", "1", "0"), "it is refused as ever"


def test_an_undo_brings_values_back_and_calls_none_new(sit: Sit, tmp_path: Path) -> None:
    notes = {name: {"facts": [value]} for name, value in (("Idle", "0"), ("Ready", "1"))}
    path = tmp_path / "arm.json"
    path.write_text(json.dumps({"SB1": {"Idle": {"go": "Ready"}, "Ready": {}, "_states": notes}}))
    person = sit(path)
    person.select("SB1/Ready")
    person.press(Key.Key_Delete)
    person.ctrl(Key.Key_Z)
    assert person.blueprint["SB1"].facts("Ready") == ("1",)
    assert "got the free" not in person.window.toast.words
    add(person, "Third", QPoint(60, 80))
    assert "Third has the fact values of Idle (0)" in person.window.toast.words


def test_short_names_need_no_key_where_the_names_stand(sit: Sit, tmp_path: Path) -> None:
    notes = {name: {"facts": [value]} for name, value in (("Idle", "0"), ("Ready", "1"))}
    path = tmp_path / "arm.json"
    path.write_text(json.dumps({"SB1": {"Idle": {"go": "Ready"}, "Ready": {}, "_states": notes}}))
    person = sit(path)
    canvas = person.window.canvas
    canvas.camera.motion = False
    canvas.zoom_to(0.5)
    assert canvas.sheet is not None
    assert canvas.sheet.compact
    assert canvas.overlays.key.rows == ()


def test_values_that_nobody_gave_are_called_a_proposal(sit: Sit, tmp_path: Path) -> None:
    facts = {"Idle": ["0", "0"], "Ready": ["1", "1"]}
    notes = {name: {"facts": values} for name, values in facts.items()}
    path = tmp_path / "arm.json"
    path.write_text(json.dumps({"SB1": {**{name: {} for name in facts}, "_states": notes}}))
    person = sit(path)
    form = person.window.properties.state
    line = form.line("facts")
    add(person, "Third", QPoint(60, 80))
    person.select("SB1/Third")
    assert (form.values.text(), line.hint.text()[:8]) == ("0, 1", "Proposed")
    person.write(form.name, "Last")
    assert line.hint.text() == "Proposed for the new state. Type those that hold."
    person.write(form.values, "1, 0")
    assert line.hint.text() == "Given here."
    person.select("SB1/Idle")
    assert line.hint.text() == "Given here."
