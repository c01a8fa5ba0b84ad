"""What the window says about a run is possible, and what it shows is of the run or the file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import Qt

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.execution.status import DispatchStatus, Offer, Possible
from smsl_studio.dispatch.status_now import look_at_nothing
from smsl_studio.front.views.hold_advice import ways_out
from smsl_studio.front.views.timeline_lanes import Block, lanes
from smsl_studio.runlog import events as told
from smsl_studio.runlog.playback import RunObserver
from tests.stories.at_run import AtRun
from tests.stories.at_supervise import AtSupervise
from tests.stories.at_tasks import NURSE, AtTasks, asking
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, sample

Key = Qt.Key
HFSM, HANOI = SAMPLES / "hfsm.json", SAMPLES / "hanoi-corrected.json"
TWO = {"confirm": ["nurse", "surgeon"], "title": "Drill"}


def test_a_run_that_waits_for_a_person_can_be_paused_in_run_mode_too(
    sit: Sit, tmp_path: Path
) -> None:
    room = AtTasks(sit(asking(tmp_path, go=TWO)), NURSE)
    room.start()
    room.until_phase("waiting")
    room.person.ctrl(Key.Key_2)
    play = room.person.window.features.run.pane.transport.play
    assert play.text() == "Pause"
    room.person.click(play)
    room.until_phase("paused")
    assert play.text() == "Play"


def test_what_is_taken_over_offers_no_play_and_a_key_says_why(sit: Sit) -> None:
    at = AtSupervise(sit(HFSM))
    at.start_paused()
    at.run.take_over()
    at.until_phase("Taken over")
    at.person.ctrl(Key.Key_2)
    run = AtRun(at.person)
    transport = run.pane.transport
    assert transport.play.isHidden()
    assert transport.step.isHidden()
    assert not transport.stop.isHidden()
    for key in (Key.Key_F10, Key.Key_F5):
        at.person.press(key)
        at.person.until(lambda: "has taken over" in run.word())


@pytest.mark.parametrize("width", [1280, 1432])
def test_reset_keeps_its_word(sit: Sit, width: int) -> None:
    at = AtSupervise(sit(HFSM, (width, 800)))
    at.start_paused()
    at.person.ctrl(Key.Key_2)
    play = at.person.window.features.run.pane.transport.play
    at.run.stop()
    at.until_phase("Stopped")
    at.person.until(lambda: play.text() == "Reset")
    words = play.fontMetrics().horizontalAdvance("Reset")
    at.person.until(lambda: play.width() >= play.sizeHint().width() > 40 + words)
    assert at.person.window.features.run.pane.transport.world.isVisible()


def test_the_result_of_a_closed_file_says_what_play_runs(sit: Sit) -> None:
    person = sit(HFSM)
    run = AtRun(person)
    person.click(run.pane.transport.step)
    run.until_done(1)
    assert person.window.files.open_copy(HANOI)
    assert run.phase == "Paused"
    name = Path(person.blueprint.file).name
    assert "Play starts" not in run.pane.canvas.banner
    run.pane.run.stop()
    run.until_phase("Stopped")
    run.pane.run.end()
    person.until(lambda: not run.pane.run.exists)
    assert f"Play starts a run of {name}" in run.pane.canvas.banner
    assert "new run" not in run.pane.canvas.banner


def test_an_outline_of_another_drawing_shows_no_states_of_the_run(sit: Sit) -> None:
    person = sit(HFSM)
    run = AtRun(person)
    person.click(run.pane.transport.play)
    run.until_phase("Goal reached")
    assert person.window.outline.tree.active
    person.ctrl(Key.Key_1)
    person.select("SB1/State110")
    person.press(Key.Key_Delete)
    assert not person.window.outline.tree.active
    person.ctrl(Key.Key_Z)
    assert person.window.outline.tree.active == run.active()


def _status(phase: str) -> DispatchStatus:
    return look_at_nothing(phase, (), None)


def _held(*items: Possible, offers: tuple[str, ...] = ()) -> DispatchStatus:
    found = tuple(Offer(command, "", "") for command in offers)
    return replace(_status("fault_hold"), possible=items, offers=found)


def _item(permitted: bool, pruned: bool = False, risky: bool = False) -> Possible:
    address = Address("S", "A", "go")
    return Possible(address, "B", permitted, (), 1.0, False, pruned=pruned, risky=risky)


def test_only_what_is_possible_is_advised() -> None:
    assert ways_out(_held()) == "End the run."
    assert ways_out(_held(_item(False), offers=("resume", "take_over", "end"))) == (
        "Resume, take over or end the run."
    )
    assert ways_out(_held(_item(True), _item(False, pruned=True), offers=("adopt",))) == (
        "Choose an operation, restore an operation, adopt where it stands or end the run."
    )
    assert ways_out(_held(_item(True, risky=True))) == "Restore an operation or end the run."


def test_the_time_before_a_start_that_was_held_stays_on_the_timeline() -> None:
    blueprint, telling = sample("hfsm.json"), RunObserver()
    telling.tell([told.Relocalised(t=3.0, configuration={"SB1": "State100", "SB2": "State0"})])
    found = lanes(blueprint, _status("paused"), telling.story)
    rows = {lane.label: lane.blocks for lane in found}
    assert rows["SB1"][0] == Block(0.0, 3.0, "?", "unknown")
    assert rows["SB1"][1].start == 3.0
