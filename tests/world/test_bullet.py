"""The engine's promises to any plugin, with a few boxes."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator

import numpy as np
import pytest

from smsl_studio.errors import WorldError
from smsl_studio.world.bodies import Body, Box, Floor, Robot
from smsl_studio.world.bullet import BulletWorld

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
