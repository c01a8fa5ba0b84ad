"""The engine's promises to any plugin, with a few boxes."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

from smsl_studio.errors import WorldError
from smsl_studio.world.bodies import Body, Box, Floor, Robot
from smsl_studio.world.bullet import BulletWorld
from smsl_studio.world.paths import waypoints

ARM = Robot(
    "arm",
    "franka_panda/panda.urdf",
    "panda_grasptarget",
    (0.0, 0.05, 0.0, -2.25, 0.0, 2.3, 0.785),
    ("panda_finger_joint1", "panda_finger_joint2"),
    0.04,
)


def _box(name: str, z: float) -> Body:
    return Body(name, Box((0.02, 0.02, 0.02)), (1.0, 0.0, z), mass=0.1, mesh=(0.0,) * 9)


@pytest.fixture
def world() -> Iterator[BulletWorld]:
    found = BulletWorld("boxes")
    found.add(Body("floor", Floor(), (0.0, 0.0, 0.0)))
    found.add(_box("low", 0.05))
    yield found
    found.close()


def test_things_fall_and_come_to_rest(world: BulletWorld) -> None:
    world.step()
    assert world.speed("low") == pytest.approx(9.81 / 240, rel=0.05)
    world.settle()
    assert world.pose("low")[0][2] == pytest.approx(0.02, abs=1e-3)
    assert world.time == pytest.approx(1 / 240)


def test_a_sleeping_body_is_woken_by_what_falls_on_it(world: BulletWorld) -> None:
    world.settle()
    world.add(_box("high", 0.4))
    rest = world.pose("low")
    for _ in range(20):
        world.step()
    assert world.pose("low") == rest
    world.place("high", (1.015, 0.0, 0.08))
    for _ in range(60):
        world.step()
    assert world.pose("low") != rest


def _run(world: BulletWorld, seconds: float) -> None:
    for _ in range(round(seconds / world.tick)):
        world.step()


def _stack(world: BulletWorld) -> list[float]:
    """Two more boxes on the first, at rest; how high the middles are."""
    world.add(_box("middle", 0.0905))
    world.add(_box("high", 0.131))
    world.settle()
    return [world.pose(name)[0][2] for name in ("low", "middle", "high")]


def test_what_is_put_into_the_air_falls(world: BulletWorld) -> None:
    world.settle()
    world.place("low", (1.0, 0.3, 0.5))
    _run(world, 1.0)
    assert world.pose("low")[0][2] == pytest.approx(0.02, abs=1e-3)


def test_what_stood_on_it_falls_too(world: BulletWorld) -> None:
    heights = _stack(world)
    assert heights == pytest.approx([0.02, 0.06, 0.10], abs=1e-3)
    world.place("low", (1.0, 0.3, 0.02))
    _run(world, 1.0)
    found = [world.pose(name)[0][2] for name in ("low", "middle", "high")]
    assert found == pytest.approx([0.02, 0.02, 0.06], abs=2e-3)


def test_what_stands_on_a_body_without_mass_wakes_when_that_is_taken_away(
    world: BulletWorld,
) -> None:
    world.add(Body("shelf", Box((0.05, 0.05, 0.01)), (1.0, 0.5, 0.2)))
    world.add(Body("cup", Box((0.02, 0.02, 0.02)), (1.0, 0.5, 0.231), mass=0.1))
    world.settle()
    world.place("shelf", (2.0, 0.5, 0.2))
    _run(world, 1.0)
    assert world.pose("cup")[0][2] == pytest.approx(0.02, abs=1e-3)


def test_what_a_body_without_mass_is_put_into_wakes_and_gives_way(world: BulletWorld) -> None:
    world.add(Body("shelf", Box((0.05, 0.05, 0.01)), (2.0, 0.0, 0.2)))
    world.settle()
    world.place("shelf", (1.0, 0.0, 0.001))
    _run(world, 1.0)
    assert world.pose("low")[0][2] == pytest.approx(0.031, abs=2e-3)


def test_what_is_glued_wakes_when_the_other_is_put_elsewhere_or_the_glue_is_gone(
    world: BulletWorld,
) -> None:
    world.add(Body("sign", Box((0.02, 0.02, 0.02)), (1.0, 0.06, 0.2), mass=0.001))
    world.place("low", (1.0, 0.0, 0.02))
    world.stick("low", "sign")
    world.settle()
    resting = world.snapshot()
    assert world.pose("sign")[0][2] == pytest.approx(0.2, abs=1e-3), "it is held up"
    world.place("low", (1.0, 0.0, 0.4))
    _run(world, 0.1)
    assert world.pose("sign")[0][2] > 0.25
    world.apply(resting)
    glue = world.stick("low", "sign")
    world.settle()
    world.unstick(glue)
    _run(world, 1.0)
    assert world.pose("sign")[0][2] == pytest.approx(0.02, abs=1e-3)


def test_who_lies_elsewhere_sleeps_on(world: BulletWorld) -> None:
    world.add(Body("far", Box((0.02, 0.02, 0.02)), (0.0, 1.0, 0.0201), mass=0.1))
    world.settle()
    rest = world.pose("far")
    world.place("low", (1.0, 0.3, 0.1))
    _run(world, 1.0)
    assert world.pose("far") == rest


def test_a_world_that_does_not_come_to_rest_says_what_moves_and_how_fast(
    world: BulletWorld,
) -> None:
    world.add(_box("high", 30.0))
    with pytest.raises(WorldError, match=r"does not come to rest within 1 s: high at 8.55 m/s"):
        world.settle()
    assert world.time == 0.0, "settling takes no simulated time"
    height = world.pose("high")[0][2]
    _run(world, 0.1)
    assert world.pose("high")[0][2] < height - 0.5, "it was not frozen in the air"
    world.place("high", (1.0, 0.5, 2.0))
    world.settle(limit=2.0)
    assert world.pose("high")[0][2] == pytest.approx(0.02, abs=1e-3)


NAN, INF = float("nan"), float("inf")


@pytest.mark.parametrize(
    "position",
    [(NAN, 0.0, 0.0), (0.0, INF, 0.0), (0.0, 0.0, -1e9), (0.0, 0.0), (0.0, 0.0, "up"), None],
)
def test_a_position_that_is_none_is_refused_wherever_it_enters(
    world: BulletWorld, position: Any
) -> None:
    before = world.pose("low")
    with pytest.raises(WorldError, match="'low' cannot stand at"):
        world.place("low", position)
    with pytest.raises(WorldError, match="'new' cannot stand at"):
        world.add(Body("new", Box((0.02, 0.02, 0.02)), position, mass=0.1))
    assert world.pose("low") == before
    with pytest.raises(WorldError, match="no body 'new' in the world 'boxes'"):
        world.pose("new")


@pytest.mark.parametrize(
    "orientation", [(0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 2.0), (NAN, 0.0, 0.0, 1.0), (0.0, 1.0)]
)
def test_an_orientation_that_is_none_is_refused(world: BulletWorld, orientation: Any) -> None:
    with pytest.raises(WorldError, match="'low' cannot be turned by"):
        world.place("low", (1.0, 0.0, 0.1), orientation)
    world.place("low", (1.0, 0.0, 0.1), (0.6, 0.0, 0.0, 0.8))


def test_what_is_no_number_reaches_no_motor_and_no_body(world: BulletWorld) -> None:
    world.add(ARM)
    rest = np.array(ARM.rest)
    calls: dict[str, Callable[[], object]] = {
        "angles of 'arm'": lambda: world.robot.drive(np.full(7, NAN)),
        "It has 7": lambda: world.robot.drive(rest[:3]),
        "speeds of 'arm'": lambda: world.robot.drive(rest, np.full(7, INF)),
        "opening of 'arm'": lambda: world.robot.grip(NAN),
        "force of 'arm'": lambda: world.robot.grip(0.01, -1.0),
        "the force of 'arm'": lambda: world.robot.weaken(NAN),
        "no joint 7": lambda: world.robot.seize(7),
        "friction of 'low'": lambda: world.rub("low", -0.1),
        "'a way' cannot stand": lambda: waypoints([np.zeros(3), np.array([0.0, 0.0, INF])]),
        "numbers of a snapshot": lambda: world.apply(b"\xff" * len(world.snapshot())),
        "mass and friction of": lambda: world.add(Body("x", Floor(), (0.0,) * 3, mass=NAN)),
        "rest posture": lambda: BulletWorld().add(Robot("x", ARM.urdf, ARM.tool, (NAN,) * 7)),
        "no body 'lo'": lambda: world.place("lo", (0.0, 0.0, 0.0)),
    }
    for words, call in calls.items():
        with pytest.raises(WorldError) as caught:
            call()
        assert words in f"{caught.value} {caught.value.advice}"
    _run(world, 0.1)
    assert np.abs(world.robot.joints() - rest).max() < 0.01


def test_the_plan_takes_a_name_and_a_robot_once(world: BulletWorld) -> None:
    with pytest.raises(WorldError, match="stands in the world already"):
        world.add(_box("low", 1.0))
    world.add(ARM)
    with pytest.raises(WorldError, match="has a robot already"):
        world.add(Robot("other", ARM.urdf, ARM.tool, ARM.rest))
    with pytest.raises(WorldError, match="7 joints, but its rest posture 1"):
        BulletWorld().add(Robot("short", ARM.urdf, ARM.tool, (0.0,)))


def test_a_world_without_a_robot_says_so(world: BulletWorld) -> None:
    assert world.status() == {}
    world.brake()
    with pytest.raises(WorldError, match="no robot in the world 'boxes'"):
        world.robot.joints()
    with pytest.raises(WorldError, match="no robot in the world 'boxes'"):
        _ = world.arm


def test_a_braked_arm_stands_within_a_tenth_of_a_second(world: BulletWorld) -> None:
    world.add(ARM)
    rest = np.array(ARM.rest)
    for tick in range(60):
        world.robot.drive(rest - 0.005 * tick, np.full(7, -1.2))
        world.step()
    world.brake()
    braked = world.robot.joints()
    for _ in range(24):
        world.step()
    stopped = world.robot.joints()
    for _ in range(240):
        world.step()
    assert np.abs(braked - rest).min() > 0.2
    assert np.abs(stopped - braked).max() < 0.02
    assert np.abs(world.robot.joints() - stopped).max() < 2e-4


def test_only_what_has_a_mesh_is_drawn(world: BulletWorld) -> None:
    assert [shape.name for shape in world.shapes()] == ["low"]
    assert world.poses()[:3] == pytest.approx((1.0, 0.0, 0.05))
    world.add(_box("high", 0.5))
    assert len(world.poses()) == 14


def test_closing_twice_is_harmless_and_leaves_others_alone(world: BulletWorld) -> None:
    other = world.fork()
    other.close()
    other.close()
    world.step()


def test_nothing_is_printed_where_data_goes() -> None:
    code = (
        "from tests.world.test_bullet import ARM\n"
        "from smsl_studio.world.bullet import BulletWorld\n"
        "world = BulletWorld(); world.add(ARM); world.step(); world.fork().close()\n"
        "world.rebuild(); world.close(); print('data')"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("data\n", "")
