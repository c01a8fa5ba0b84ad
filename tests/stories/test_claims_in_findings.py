"""Hazards and properties in the list of findings: answered when the person pauses."""

from __future__ import annotations

import json
from pathlib import Path

from PySide6.QtCore import Qt

from tests.stories.conftest import Sit
from tests.stories.person import Person

BRANCH = {
    "HEADER": {"INITIAL": "State_00", "ACTIVATING": "State_11", "NUM_FACTS": 2},
    "State_00": {"on": "State_10", "skip": "State_01"},
    "State_10": {"end": "State_11"},
    "State_01": {"end": "State_11"},
    "State_11": {"again": "State_00"},
}
HAZARD = {"name": "Blind cut", "facts": {"SB/0": "0", "SB/1": "1"}}


def at_guarded(sit: Sit, folder: Path) -> Person:
    """Somebody at a file whose hazard can be reached."""
    file = folder / "guarded.json"
    file.write_text(json.dumps({"_hazards": [HAZARD], "SB": BRANCH}, indent=1))
    person = sit(file)
    person.until(lambda: person.window.inspector.proof is not None)
    return person


def rules(person: Person) -> set[str]:
    return {one.rule for one in person.window.findings.findings}


def test_a_hazard_is_found_after_an_edit_and_gone_after_its_undo(sit: Sit, tmp_path: Path) -> None:
    person = at_guarded(sit, tmp_path)
    window = person.window
    assert "R19" in rules(person)
    assert window.findings.summary.text() == "1 error blocks approval"
    window.canvas.setFocus()
    person.select("SB/State_00/skip")
    person.press(Qt.Key.Key_Delete)
    assert not person.window.inspector.current
    person.until(lambda: window.inspector.proof is not None)
    assert "R19" not in rules(person)
    person.ctrl(Qt.Key.Key_Z)
    person.until(lambda: window.inspector.proof is not None)
    assert "R19" in rules(person)


def test_f3_leads_to_the_hazard(sit: Sit, tmp_path: Path) -> None:
    person = at_guarded(sit, tmp_path)
    window = person.window
    person.press(Qt.Key.Key_F3)
    assert window.findings.chosen_rule == "R19"
    row = window.findings.list.currentIndex().data()
    assert "_hazards/Blind cut" in row
    assert "By SB/State_00/skip" in row
    panel = window.features.inspection.panel
    assert panel.isVisible()
    assert panel.table.chosen is not None
    assert panel.table.chosen.name == "Blind cut"
