"""Hanoi on other robots than the usual one: one plugin, smaller things, the same way to the goal.

``benches/worlds.py`` sweeps all edges and solves the game from many starts.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import smsl_studio as smsl
from plugins.hanoi.moves import carry
from plugins.hanoi.table import Table, stations_of
from smsl_studio.errors import WorldError
from smsl_studio.front.inputs import read
from smsl_studio.host.plugin_offers import describe
from smsl_studio.library.arm_table import arm_named
from smsl_studio.library.loading import discover
from smsl_studio.runlog.events import Committed, RunStarted
from smsl_studio.shipped import samples_dir
from smsl_studio.world.arms.dvrk import CENTRE
from smsl_studio.world.bullet import BulletWorld
from smsl_studio.world.kinematics import rotation_of
from smsl_studio.world.reach import reach_of, unreached

TWO = samples_dir() / "hanoi-2.json"
OTHERS = ("iiwa", "dvrk")
WAY = ["State_ba", "State_bc", "State_cc"]


@pytest.mark.parametrize("robot", OTHERS)
def test_a_run_tells_the_same_here_in_a_child_and_in_its_log(robot: str, tmp_path: Path) -> None:
    blueprint, log = read(TWO), tmp_path / "run.jsonl"
    here = smsl.run(blueprint, "hanoi", goal="State_cc", seed=1, robot=robot)
    there = smsl.run(
        blueprint, "hanoi", goal="State_cc", seed=1, robot=robot, host="process", log=log
    )
    assert here.reason == "goal_reached", here.sentence
    told = [event.line() for event in here.events]
    assert [event.line() for event in there.events] == told
    recorded = smsl.replay(log)
    assert [event.line() for event in recorded.events] == told
    assert recorded.header["robot"] == robot
    started = next(event for event in here.events if isinstance(event, RunStarted))
    assert (started.world, started.robot) == ("hanoi", robot)
    way = [
        state for e in here.events if isinstance(e, Committed) for state in e.configuration.values()
    ]
    assert way == WAY


def test_the_usual_robot_is_told_nowhere(tmp_path: Path) -> None:
    log = tmp_path / "run.jsonl"
    blueprint = read(TWO)
    plain = smsl.run(blueprint, "hanoi", start="State_bc", goal="State_cc", log=log)
    named = smsl.run(blueprint, "hanoi", start="State_bc", goal="State_cc", robot="panda")
    assert [e.line() for e in plain.events] == [e.line() for e in named.events]
    assert "robot" not in smsl.replay(log).header
    assert '"robot"' not in "".join(event.line() for event in plain.events)


def test_the_shaft_goes_through_the_centre_of_motion_all_the_time() -> None:
    table = Table(BulletWorld("hanoi"), 2, 0, arm_named("dvrk"))
    table.furnish()
    world, worst = table.world, 0.0
    for _ in carry(table, table.disk(1), "c"):
        world.step()
        place, turned = world.robot.frames()["dvrk_outer_roll"]
        along = rotation_of(turned)[:, 2]
        off = np.cross(np.subtract(CENTRE, place), along)
        worst = max(worst, float(np.linalg.norm(off)))
    assert table.reading(table.disk(1)) == "c"
    assert worst < 0.0001
    world.close()


def test_a_robot_that_does_not_reach_is_refused_before_anything_moves() -> None:
    far = replace(arm_named("iiwa"), name="far", base=(-0.35, 0.0, 0.0))
    world = BulletWorld("hanoi")
    with pytest.raises(WorldError, match=r"'far' does not reach the foot of peg a .* \(0.500"):
        Table(world, 3, 0, far).furnish()
    world.close()


@pytest.mark.parametrize("world", ["hanoi", "hanoi-mujoco", "chess", "river", "registration"])
def test_every_robot_of_a_shipped_world_reaches_all_its_stations(world: str) -> None:
    here, told = discover(), describe()
    for robot in here.robots(world) or ("",):
        reach = here.reach(world, robot)
        assert reach is not None
        assert len(reach.stations) > 5
        assert unreached(reach) == ()
        assert told.reach(world, robot) == reach


def test_the_stations_that_a_robot_does_not_reach_are_named() -> None:
    far = replace(arm_named("iiwa"), name="far", base=(-0.42, 0.0, 0.0))
    reach = reach_of(far, stations_of(far))
    assert reach is not None
    missed = unreached(reach)
    assert ("Op_{disk}a", "the foot of peg a (0.500, -0.140, 0.010 m)") in missed
    assert {pattern for pattern, _ in missed} == {"Op_{disk}a", "Op_{disk}b", "Op_{disk}c"}
