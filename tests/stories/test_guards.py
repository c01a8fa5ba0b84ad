"""Guards across State Branches: a lock at the label shows the state of the required facts in a
run."""

from __future__ import annotations

import json
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.canvas.accessible import edge_tip, words_for
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

Key = Qt.Key
MOVE = Address("ROBOT", "State_0", "Move")


def _rooms(folder: Path) -> Path:
    plan = {
        "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
        "_facts": {"0": {"name": "Target chosen"}},
        "State_0": {"Choose": "State_1"},
        "State_1": {"Clear": "State_0"},
    }
    robot = {
        "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
        "_operations": {"Move": {"requires": {"PLAN/0": "1"}}},
        "State_0": {"Move": "State_1"},
        "State_1": {"Back": "State_0"},
    }
    path = folder / "rooms.json"
    path.write_text(json.dumps({"PLAN": plan, "ROBOT": robot}, indent=4))
    return path


def _how(run: AtRun) -> str:
    return run.pane.canvas.canvas.marks.guards.get(MOVE, ("", ""))[0]


def test_a_lock_says_how_what_is_needed_stands_while_the_run_goes_on(
    sit: Sit, tmp_path: Path
) -> None:
    run = AtRun(sit(_rooms(tmp_path)))
    until = run.person.until
    run.choose(world="table")
    run.person.click(run.pane.transport.by_hand)
    run.person.press(Key.Key_F5)
    until(lambda: run.pane.run.phase == "ready")
    canvas = run.pane.canvas
    canvas.show_branch("ROBOT")
    until(lambda: _how(run) == "false")
    assert not canvas.canvas.marks.held_back
    edge = canvas.canvas.sheet.picture.edge(MOVE) if canvas.canvas.sheet else -1
    assert edge_tip(canvas.canvas, edge).splitlines()[-1] == (
        "Needs Target chosen of PLAN to be 1: it is 0"
    )

    run.pane.ask(Address("PLAN", "State_0", "Choose"))
    until(lambda: _how(run) == "true")
    assert "what it needs holds" in words_for(canvas.canvas, MOVE)

    # Its sensor falls silent: not known is held back, and neither true nor false.
    run.pane.run.disturb("PLAN/0", "dropout")
    until(lambda: _how(run) == "unknown")
    until(lambda: canvas.canvas.marks.held_back == {MOVE})
    assert "unknown" in edge_tip(canvas.canvas, edge)
    run.pane.ask(MOVE)
    until(lambda: "requires PLAN/0" in run.word() or "unknown" in run.word())
    assert run.active()["ROBOT"] == "State_0"

    run.pane.run.disturb("PLAN/0", "none")
    until(lambda: _how(run) == "true")
    assert not canvas.canvas.marks.held_back
    run.pane.ask(MOVE)
    until(lambda: run.active()["ROBOT"] == "State_1")


def test_a_critical_fact_that_is_lost_holds_and_says_which(sit: Sit, tmp_path: Path) -> None:
    path = _rooms(tmp_path)
    values = json.loads(path.read_text())
    values["PLAN"]["_facts"]["0"]["critical"] = True
    path.write_text(json.dumps(values))
    run = AtRun(sit(path))
    run.choose(world="table")
    run.person.click(run.pane.transport.by_hand)
    run.person.press(Key.Key_F5)
    run.until_phase("Ready")
    run.pane.run.disturb("PLAN/0", "stuck", value="1")
    run.until_phase("Fault hold")
    assert run.pane.canvas.banner.startswith(
        "Fault hold: Target chosen of PLAN, a critical fact, reads 1, not 0"
    )
    run.person.ctrl(Key.Key_3)
    words = [
        label.text() for label in run.person.window.features.supervise.pane.findChildren(QLabel)
    ]
    assert "Guarded fact lost" in words


def test_a_route_that_bypasses_its_subs_is_announced_across_the_top(
    sit: Sit, tmp_path: Path
) -> None:
    values = json.loads((SAMPLES / "registration-digitization.json").read_text())
    path = tmp_path / "two.json"
    path.write_text(json.dumps({"ROOM": {"State_0": {"Open": "State_1"}, "State_1": {}}, **values}))
    run = AtRun(sit(path))
    run.choose(world="table")
    run.person.press(Key.Key_F10)
    run.until_phase("Paused")
    assert run.active()["ROOM"] == "State_1"
    words = "no operation of DIGITIZATION is carried out."
    assert run.pane.canvas.banner.endswith(words)
    listed = run.pane.events
    assert any(words in listed.item(row).text() for row in range(listed.count()))
    run.person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    assert run.pane.canvas.banner == ""


def test_what_is_needed_is_told_while_it_is_drawn(sit: Sit) -> None:
    person = sit(SAMPLES / "three-roots.json")
    canvas = person.window.canvas
    person.window.session.show_branch("ROBOT")
    edge = Address("ROBOT", "State10", "MoveToTarget")
    assert canvas.sheet is not None
    number = canvas.sheet.picture.edge(edge)
    assert canvas.sheet.text(number).guard == "declared"
    assert canvas.sheet.text(0).guard == ""
    person.move_to(person.place(str(edge)))
    person.until(lambda: "Needs Registered of REGISTRATION" in canvas.viewport().toolTip())
    assert canvas.overlays.legend.accessibleName() == "needs other facts first"
