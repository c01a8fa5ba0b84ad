"""Find anything by typing, with the keyboard alone."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtCore import Qt

from smsl_studio.studio.base.rows import LINE
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
HANOI, HFSM = SAMPLES / "hanoi.json", SAMPLES / "hfsm.json"


@pytest.fixture
def noted(tmp_path: Path) -> Path:
    """A file in which everything has a plain name, too."""
    values = json.loads(HFSM.read_text())
    values["SB1"]["_states"] = {"State110": {"title": "Half way there"}}
    values["SB1"]["_operations"] = {"Operation100A": {"title": "Walk on"}}
    values["SB1"]["_facts"] = {"2": {"name": "Door open"}}
    values["_hazards"] = [{"name": "Open and away", "facts": {"SB1/2": "1", "SB1/0": "1"}}]
    path = tmp_path / "noted.json"
    path.write_text(json.dumps(values, indent=4))
    return path


def find(person: Person, text: str) -> list[str]:
    """Type into the box; the rows that were found."""
    person.window.canvas.setFocus()
    person.ctrl(Key.Key_K)
    person.type(text)
    rows = person.window.command_palette.list.rows.rows
    return [row.text for row in rows if row.kind == LINE]


@pytest.mark.parametrize(
    ("typed", "first", "selected"),
    [
        ("half", "State110", ["SB1/State110"]),
        ("there half", "State110", ["SB1/State110"]),
        ("110", "State110", ["SB1/State110"]),
        ("walk", "Operation100A", ["SB1/State100/Operation100A"]),
        ("op100b", "Operation100B", ["SB1/State100/Operation100B"]),
        ("State100/Operation100B", "Operation100B", ["SB1/State100/Operation100B"]),
        ("sb2", "SB2", []),
    ],
)
def test_places_are_found_by_name_title_and_facts(
    sit: Sit, noted: Path, typed: str, first: str, selected: list[str]
) -> None:
    person = sit(noted)
    assert find(person, typed)[0] == first
    person.press(Key.Key_Return)
    assert person.selected() == selected
    assert person.window.session.branch == ("SB2" if first == "SB2" else "SB1")
    assert person.window.canvas.hasFocus()


def test_a_fact_opens_its_form_and_a_hazard_its_row(sit: Sit, noted: Path) -> None:
    person = sit(noted)
    assert find(person, "door")[0] == "Door open"
    person.press(Key.Key_Return)
    assert person.window.properties.fact.name.text() == "Door open"
    assert person.window.properties.fact.isVisible()
    assert find(person, "and away")[0] == "Open and away"
    person.press(Key.Key_Return)
    page = person.window.features.inspection.panel
    assert page.isVisible()
    person.until(lambda: page.table.chosen is not None)
    assert page.table.chosen is not None
    assert page.table.chosen.name == "Open and away"
    assert page.table.hasFocus()


def test_findings_files_and_commands_stand_in_sections_of_their_own(sit: Sit, noted: Path) -> None:
    person = sit(HANOI)
    person.window.files.open(noted)
    person.window.files.open(HANOI)
    person.until_inspected()
    assert "noted.json" in find(person, "noted")
    person.press(Key.Key_Escape)
    assert find(person, "r15")
    rows = person.window.command_palette.list.rows.rows
    assert rows[0].text == "Findings"
    person.press(Key.Key_Return)
    assert person.selected()[0].startswith("SB1/State_cb")
    assert find(person, "noted.js")[0] == "noted.json"
    person.press(Key.Key_Return)
    assert "SB2" in person.blueprint.branches


def test_what_was_chosen_last_stands_first(sit: Sit, noted: Path) -> None:
    person = sit(noted)
    for typed in ("half", "fit every"):
        find(person, typed)
        person.press(Key.Key_Return)
    assert find(person, "")[:2] == ["Fit everything", "State110"]
    person.press(Key.Key_Down)
    person.press(Key.Key_Return)
    assert person.selected() == ["SB1/State110"]
    person.press(Key.Key_Delete)
    assert "State110" not in find(person, ""), "what is gone is not offered"


def test_a_recorded_run_is_found_by_its_other_name(sit: Sit) -> None:
    assert "Open recording" in find(sit(HANOI), "replay")


def test_what_is_found_nowhere_is_said(sit: Sit) -> None:
    person = sit(HANOI)
    assert find(person, "zzzqqq") == []
    palette = person.window.command_palette
    assert "Nothing is called “zzzqqq”" in palette.empty.text()
    person.press(Key.Key_Return)
    assert palette.isVisible(), "Enter on nothing does nothing"
