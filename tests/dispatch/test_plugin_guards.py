"""Guards of a plugin: an operation that cannot be used now is avoided, told, and never begins."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.front.logs import verify
from smsl_studio.front.runs import run
from smsl_studio.front.sweeps import sweep
from smsl_studio.host.local import LocalHost
from smsl_studio.runlog.events import EdgeSwept
from tests.dispatch.runs import Story, blueprint, branch, short
from tests.plugin_folder import write_plugin

PLUGIN = """
from smsl_studio.library.operation_library import Availability

class Desk:
    def __init__(self, world):
        self.world, self.saved = world, False

def register(library):
    @library.world("desk", engine="table", settle=0.0)
    def build(world, blueprint, seed):
        return Desk(world)

    @library.arrange("desk")
    def arrange(desk, facts):
        desk.world.set_facts(facts)
        desk.saved = False

    @library.sensor("place_{n}", fact="{n}", period=0.1)
    def place(desk, n: int):
        return desk.world.fact("SB1", n - 1)

    @library.operation("to_{place}")
    def go(desk, place: str):
        desk.world.set_facts({("SB1", 0): place})
        desk.saved = desk.saved or place == "c"
        yield

    def is_saved(desk, place):
        if place == "x":
            raise RuntimeError("nobody knows")
        return "" if desk.saved else "nothing is\\nsaved"

    def save(desk, place):
        desk.saved = True

    @library.operation("load_{place}", available=Availability(is_saved, save))
    def load(desk, place: str):
        if not desk.saved:
            raise AssertionError("it was called")
        desk.world.set_facts({("SB1", 0): place})
        yield

    @library.fault("desk", "lose")
    def lose(desk):
        desk.saved = False
"""
DESK: Any = branch(
    {"a": "load_d>d, to_b>b", "b": "to_c>c", "c": "to_d>d", "d": "to_a>a, load_x>x", "x": ""},
    initial="a",
    activating="d",
)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_plugin(tmp_path, "desk", PLUGIN)
    return tmp_path


def story_in(folder: Path, automatic: bool = True) -> Story:
    made = blueprint({"SB1": DESK})
    return Story(made, LocalHost(made, "desk", 0, [folder]), automatic=automatic)


def test_the_route_goes_round_an_operation_that_is_not_available(folder: Path) -> None:
    story = story_in(folder)
    story.run()
    assert short(story.started) == ["to_b", "to_c", "to_d"]
    first, second = story.of("costs_changed")
    assert first.closed == {
        "SB1/Statea/load_d": "nothing is saved",
        "SB1/Stated/load_x": "its guard raised an error: RuntimeError: nobody knows"
        " (desk/plugin.py:30)",
    }
    assert second.closed == {"SB1/Statea/load_d": ""}


def test_a_person_cannot_begin_it_and_hears_why(folder: Path) -> None:
    story = story_in(folder, automatic=False)
    story.tick()
    story.ask("load_d").tick(3)
    assert not story.started
    assert "nothing is saved" in story.of("operation_refused")[-1].reasons[0]
    story.ask("to_b", "to_c", "to_d", "to_a", "load_d").tick(3)
    assert short(story.started)[-1] == "load_d"


def test_what_is_lost_in_the_middle_is_not_used(folder: Path) -> None:
    story = story_in(folder, automatic=False)
    story.ask("to_b", "to_c", "to_d", "to_a").tick()
    story.dispatcher.inject("lose")
    story.ask("load_d").tick(3)
    ended = [event for event in story.of("operation_ended") if "load_d" in event.address]
    assert all(event.outcome == "failed" for event in ended)
    assert story.dispatcher.standing.configuration == {"SB1": "Statea"}


def test_a_sweep_tries_it_where_its_guard_agrees(folder: Path) -> None:
    made = blueprint({"SB1": DESK})
    swept = {
        one.address: one
        for one in sweep(made, "desk", plugin_paths=[folder])
        if isinstance(one, EdgeSwept)
    }
    assert swept["SB1/Statea/load_d"].passed
    assert not swept["SB1/Stated/load_x"].passed
    assert "nobody knows" in swept["SB1/Stated/load_x"].sentence


@pytest.mark.parametrize("host", ["local", "process"])
def test_the_log_of_such_a_run_is_a_true_story(folder: Path, tmp_path: Path, host: str) -> None:
    log = tmp_path / "run.jsonl"
    made = blueprint({"SB1": DESK})
    found = run(made, "desk", host=host, plugin_paths=[folder], log=log)
    assert found.reason == "goal_reached"
    verdict = verify(str(log), made)
    assert (verdict.doubt, verdict.order) == (None, None)
    lines = [json.loads(line) for line in log.read_text("utf-8").splitlines()]
    closed = [one["closed"] for one in lines if one.get("event") == "costs_changed"]
    assert list(closed[0]) == ["SB1/Statea/load_d", "SB1/Stated/load_x"]
