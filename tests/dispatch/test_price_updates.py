"""Adaptive costs are asked at every arrival and when facts change; changes are reported."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from smsl_studio.host.local import LocalHost
from tests.dispatch.runs import Story, blueprint, branch, short
from tests.plugin_folder import write_plugin

PLUGIN = """
def register(library):
    @library.world("maze", engine="table", settle=0.0)
    def build(world, blueprint, seed): ...

    @library.arrange("maze")
    def arrange(world, facts):
        world.set_facts(facts)

    @library.sensor("place_{n}", fact="{n}", period=0.1)
    def place(world, n: int):
        return world.fact("SB1", n - 1)

    @library.operation("to_{place}")
    def go(world, place: str):
        world.set_facts({("SB1", 0): place})
        yield

    @library.cost("to_{place}")
    def worn(state, scene, history, place: str):
        if place == "x":
            raise RuntimeError("nobody knows")
        return 1.0 + sum(edge.endswith(f"/to_{place}") for edge, outcome in history)
"""
MAZE: Any = branch(
    {"a": "to_b>b, to_c>c, to_x>x", "b": "to_d>d", "c": "to_d>d", "d": "to_a>a", "x": ""},
    initial="a",
    activating="d",
)


@pytest.fixture
def story(tmp_path: Path) -> Story:
    write_plugin(tmp_path, "maze", PLUGIN)
    made = blueprint({"SB1": MAZE})
    return Story(made, LocalHost(made, "maze", 0, [tmp_path]), automatic=False)


def test_the_way_follows_what_cost_functions_say(story: Story) -> None:
    story.ask("to_b", "to_d", "to_a").tick()
    worn = ["Statea/to_b", "Stateb/to_d", "Statec/to_d", "Stated/to_a"]
    assert story.of("costs_changed")[-1].costs == {f"SB1/{edge}": 2.0 for edge in worn}
    story.dispatcher.resume()
    story.run()
    assert short(story.started) == ["to_b", "to_d", "to_a", "to_c", "to_d"]
    assert story.of("route_planned")[0].cost == 3.0


def test_only_edges_whose_cost_changed_are_told(story: Story) -> None:
    story.ask("to_b").tick(3)
    changes = [event.costs for event in story.of("costs_changed")]
    assert changes == [{"SB1/Statea/to_b": 2.0}]


def test_a_function_that_fails_costs_one_fault_and_is_told_once(story: Story) -> None:
    story.tick(3).ask("to_b", "to_d", "to_a").tick(3)
    faults = [fault for event in story.of("costs_changed") for fault in event.faults]
    assert len(faults) == 1
    assert "maze.worn raised an error for SB1/Statea/to_x: RuntimeError: nobody knows" in faults[0]


def test_what_a_person_says_stands_over_what_a_function_says(story: Story) -> None:
    edge = story.blueprint.resolve("SB1/Statea/to_c")
    story.dispatcher.set_cost(edge, 9)
    story.ask("to_b", "to_d", "to_a").tick()
    story.dispatcher.resume()
    story.run()
    assert short(story.started)[-2:] == ["to_b", "to_d"]
