"""A person who chooses a world sees what it lacks among the findings, until another file is
opened."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

from smsl_studio.shipped import samples_dir
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import Person

SHARED = {
    "_operations": {"cut": {"actor": "shared", "risk": "high"}},
    "State_0": {"cut": "State_1"},
    "State_1": {"back": "State_0"},
}


def rules(person: Person) -> set[str]:
    return {one.rule for one in person.window.findings.findings}


def test_the_rules_of_a_chosen_world_are_asked(sit: Sit, tmp_path: Path) -> None:
    file = tmp_path / "shared.json"
    file.write_text(json.dumps({"SB": SHARED}, indent=1))
    person = sit(file)
    inspector = person.window.inspector
    person.until(lambda: inspector.current)
    assert "R26" not in rules(person), "no world was chosen"
    run = AtRun(person)
    worlds = run.pane.transport.world
    person.until(lambda: worlds.findText("table") >= 0)
    person.choose(worlds, "table")
    person.until(lambda: inspector.current and "R26" in rules(person))
    assert inspector.world == "table"
    other = tmp_path / "other.json"
    other.write_text(file.read_text())
    person.window.open_path(other)
    person.until(lambda: inspector.current and "R26" not in rules(person))
    assert inspector.world == ""


def test_a_world_is_offered_with_each_of_its_robots(sit: Sit, tmp_path: Path) -> None:
    person = sit(Path(shutil.copy(samples_dir() / "hanoi-2.json", tmp_path)))
    run = AtRun(person)
    worlds, pane = run.pane.transport.world, run.pane
    person.until(lambda: worlds.findText("hanoi, iiwa") >= 0)
    assert [worlds.itemText(at) for at in range(worlds.count())] == [
        "hanoi", "hanoi, iiwa", "hanoi, dvrk", "hanoi-mujoco", "table",
    ]  # fmt: skip
    person.choose(worlds, "hanoi, iiwa")
    asked = pane.next.choice
    assert (asked.world, asked.robot) == ("hanoi", "iiwa")
    assert asked.request(person.window.session.blueprint).robot == "iiwa"
    person.choose(worlds, "hanoi")
    assert (pane.next.choice.world, pane.next.choice.robot) == ("hanoi", "")
