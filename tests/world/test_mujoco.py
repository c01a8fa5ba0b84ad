"""The world in MuJoCo keeps the protocol of worlds: it comes back bit-equally, and refuses what it
cannot have. ``benches/physics.py`` sweeps Hanoi in it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.errors import WorldError
from smsl_studio.front.single_edge import try_edge
from smsl_studio.runlog.events import Committed
from smsl_studio.shipped import samples_dir
from smsl_studio.world.arms.iiwa import ARM as IIWA
from smsl_studio.world.arms.panda import ARM as PANDA
from smsl_studio.world.bodies import Body, Box, Floor
from smsl_studio.world.mujoco_world import MujocoWorld

OTHER = "hanoi-mujoco"
CORRECTED = samples_dir() / "hanoi-corrected.json"


def cube(name: str, z: float = 0.02) -> Body:
    return Body(name, Box((0.02, 0.02, 0.02)), (0.4, 0.0, z), mass=0.1)


@pytest.fixture
def world() -> Iterator[MujocoWorld]:
    found = MujocoWorld("here")
    found.add(Body("floor", Floor(), (0.0, 0.0, 0.0)))
    found.add(cube("low"))
    found.add(cube("high", 0.10))
    found.add(PANDA)
    yield found
    found.close()


def test_it_runs_on_with_equal_bits_from_a_snapshot(world: MujocoWorld) -> None:
    """Also in the middle of a fall, and of a motion."""
    world.robot.drive(world.robot.goal + 0.2, np.full(7, 0.1))
    for _ in range(5):
        world.step()
    snapshot, fork = world.snapshot(), world.fork()
    assert fork.snapshot() == snapshot
    for one in (world, fork):
        for _ in range(40):
            one.step()
    later = world.snapshot()
    assert later == fork.snapshot() != snapshot
    world.apply(snapshot)
    assert (world.snapshot(), world.time) == (snapshot, 5 * world.tick)
    for _ in range(40):
        world.step()
    assert world.snapshot() == later
    fork.close()


def test_bodies_fall_rest_and_can_be_glued(world: MujocoWorld) -> None:
    world.settle()
    assert world.time == 0.0
    assert world.pose("high")[0][2] == pytest.approx(0.06, abs=0.001)
    glue = world.stick("high", "low")
    world.place("high", (0.4, 0.015, 0.06))
    assert _beside(world) == pytest.approx(0.015)
    for _ in range(60):
        world.step()
    assert _beside(world) < 0.003
    world.unstick(glue)
    world.place("high", (0.4, 0.015, 0.06))
    for _ in range(60):
        world.step()
    assert _beside(world) > 0.012
    world.rebuild()
    assert world.pose("high")[0] == pytest.approx((0.4, 0.0, 0.10))


def _beside(world: MujocoWorld) -> float:
    """How far the upper cube is beside the lower one (m)."""
    return float(np.hypot(*np.subtract(world.pose("high")[0], world.pose("low")[0])[:2]))


def test_the_arm_holds_still_and_a_seized_joint_does_not_move(world: MujocoWorld) -> None:
    world.settle()
    assert world.robot.joints() == pytest.approx(np.array(PANDA.rest), abs=0.002)
    world.robot.seize(1)
    world.robot.drive(np.array(PANDA.rest) + 0.1)
    for _ in range(240):
        world.step()
    moved = world.robot.joints() - np.array(PANDA.rest)
    assert abs(moved[1]) < 0.01
    assert moved[3] == pytest.approx(0.1, abs=0.01)
    world.brake()
    assert world.robot.goal == pytest.approx(world.robot.joints())


def test_what_it_cannot_have_is_refused(world: MujocoWorld) -> None:
    with pytest.raises(WorldError, match="stands in the world already"):
        world.add(cube("low"))
    with pytest.raises(WorldError, match="has a robot already"):
        world.add(replace(PANDA, name="another"))
    with pytest.raises(WorldError, match="there is no body 'lou'"):
        world.pose("lou")
    with pytest.raises(WorldError, match="cannot stand at"):
        world.place("low", (0.0, float("nan"), 0.0))
    with pytest.raises(WorldError, match="has no joint 9"):
        world.robot.seize(9)
    with pytest.raises(WorldError, match="cannot be"):
        world.robot.drive(np.zeros(3))
    with pytest.raises(WorldError, match="not of a world built like"):
        world.apply(b"12345678")
    empty = MujocoWorld("empty")
    with pytest.raises(WorldError, match="has links of its own"):
        empty.add(IIWA)
    with pytest.raises(WorldError, match="there is no robot"):
        empty.robot.open()
    empty.close()
    empty.close()


def test_the_same_blueprint_takes_the_same_way_in_both_engines() -> None:
    blueprint = smsl.read(CORRECTED)
    ways = []
    for world in ("hanoi", OTHER):
        done = smsl.run(blueprint, world, goal="State_bba", seed=3, host="local")
        assert done.reason == "goal_reached", done.sentence
        ways.append([e.configuration["SB1"] for e in done.events if isinstance(e, Committed)])
    assert ways[0] == ways[1]
    assert len(ways[0]) == 3


@pytest.mark.parametrize(
    ("state", "operation"), [("State_abc", "Op_1c"), ("State_ccc", "Op_1a"), ("State_cba", "Op_1b")]
)
def test_edges_of_hanoi_pass_alone(state: str, operation: str) -> None:
    edge = Address("SB1", state, operation)
    assert try_edge(smsl.read(CORRECTED), edge, OTHER, host="local").passed


def test_a_child_tells_what_this_process_tells() -> None:
    blueprint = smsl.read(CORRECTED)
    here, there = (
        smsl.run(blueprint, OTHER, goal="State_caa", seed=1, host=host)
        for host in ("local", "process")
    )
    assert here == there
    assert here.reason == "goal_reached"


def test_a_fault_holds_there_too() -> None:
    dispatcher = smsl.open_run(smsl.read(CORRECTED), OTHER, goal="State_caa", host="local")
    list(dispatcher.open())
    try:
        dispatcher.inject("gripper_opens", by="a test")
        while not dispatcher.finished:
            told = dispatcher.tick()
    finally:
        dispatcher.close()
    assert told[-1].as_json()["reason"] == "held"
