"""The world's process dies, or nothing can be drawn: the window stays open and says so."""

from __future__ import annotations

import os
import signal

import pytest
from PySide6.QtCore import QPoint, Qt

from smsl_studio import front
from smsl_studio.studio.running.scene import world_view
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

Key = Qt.Key
HANOI = SAMPLES / "hanoi-corrected.json"


def _pid(run: AtRun) -> int:
    found = run.pane.run.world_process
    assert found is not None
    return found


def test_a_killed_world_holds_the_run_and_loses_nothing(sit: Sit) -> None:
    person = sit(HANOI)
    corner = person.place("SB1/State_bbb")
    person.drag(corner, corner + QPoint(0, 30))
    drawn = person.blueprint.document.text
    assert person.window.session.edited
    run = AtRun(person)
    person.press(Key.Key_F5)
    run.until_runs()
    os.kill(_pid(run), signal.SIGKILL)
    run.until_phase("Ended: failed")
    assert (
        "killed by signal 9 (SIGKILL) in the middle of SB1/State_aaa/Op_1c"
        in run.pane.canvas.banner
    )
    assert {row[2] for row in run.facts()} == {"?"}
    assert not run.pane.run.exists
    assert person.window.session.edited
    assert person.blueprint.document.text == drawn
    person.press(Key.Key_F10)
    run.until_runs()
    assert run.pane.canvas.banner == ""
    person.press(Key.Key_F8)
    run.until_phase("Stopped")


def test_a_world_that_dies_while_the_run_is_paused_is_noticed_at_once(sit: Sit) -> None:
    person = sit(HANOI)
    run = AtRun(person)
    person.press(Key.Key_F5)
    run.until_runs()
    person.press(Key.Key_F6)
    run.until_phase("Paused")
    os.kill(_pid(run), signal.SIGKILL)
    run.until_phase("Ended: failed")
    assert "killed by signal 9 (SIGKILL)" in run.pane.canvas.banner


def test_without_graphics_the_run_goes_on_and_tells_the_same(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(world_view, "open_renderer", lambda: "no driver here")
    run = AtRun(sit(HANOI))
    run.choose(goal="caa")
    run.as_fast_as_it_goes()
    run.person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    assert run.pane.world.sentence == "No graphics here. The run goes on"
    assert "no driver here" in run.pane.world.toolTip()
    headless = front.run(front.read(HANOI), "hanoi", "State_caa", "State_aaa")
    assert [e.line() for e in run.events] == [e.line() for e in headless.events]


def test_a_world_that_cannot_be_built_says_why(sit: Sit) -> None:
    run = AtRun(sit(HANOI))
    run.pane.transport.world.addItem("nowhere", "nowhere")
    run.choose(world="nowhere")
    run.person.press(Key.Key_F5)
    run.person.qtbot.waitUntil(lambda: "there is no world" in run.pane.canvas.banner.lower())
    assert not run.pane.run.exists
