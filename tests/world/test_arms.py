"""Every shared arm as a value: its kinematics are those of its engine, and it stands where it is
sent."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from plugins.hanoi.disks import PEG_TOP, disks_for, pegs_for
from smsl_studio.errors import WorldError
from smsl_studio.library.arm_table import arm_named, arm_names
from smsl_studio.world.bodies import Jaw, Robot
from smsl_studio.world.bullet import BulletWorld
from smsl_studio.world.kinematics import rotation_of
from smsl_studio.world.motions import DOWN, tool, travel

ARMS = [arm_named(name) for name in arm_names()]
by_name = pytest.mark.parametrize("arm", ARMS, ids=arm_names())


def standing(arm: Robot) -> BulletWorld:
    world = BulletWorld(arm.name)
    world.add(arm)
    return world


def test_arms_are_found_by_their_names() -> None:
    assert {"panda", "iiwa", "dvrk"} <= set(arm_names())
    assert [arm.name for arm in ARMS] == list(arm_names())
    with pytest.raises(WorldError, match="there is no arm 'pandas'") as caught:
        arm_named("pandas")
    assert "panda" in caught.value.advice


@by_name
def test_the_tool_is_where_the_engine_has_it(arm: Robot) -> None:
    bent = tuple(joint + 0.05 * (-1) ** number for number, joint in enumerate(arm.rest))
    moved = replace(arm, rest=bent)
    world = standing(moved)
    position, turned = world.robot.frames()[arm.tool]
    expected, rotation = world.arm.tool(np.array(bent))
    along = rotation_of(turned) @ np.array(arm.point)
    assert np.allclose(np.array(position) + along, expected, atol=1e-5)
    assert np.allclose(rotation_of(turned), rotation, atol=1e-5)
    world.close()


@by_name
def test_the_tool_comes_down_on_each_peg_with_fingers_that_close_to_the_side(arm: Robot) -> None:
    world = standing(arm)
    for x, y in pegs_for(arm.size).values():
        for height in (0.01, PEG_TOP + 0.03):
            place = np.array([x, y, height * arm.size])
            joints = world.arm.solve(place, DOWN, near=world.arm.rest)
            found, turned = world.arm.tool(joints)
            assert np.abs(found - place).max() < 2e-5
            assert np.abs(turned - DOWN).max() < 1e-3
    world.close()


@by_name
def test_the_fingers_open_and_close_as_far_as_is_said(arm: Robot) -> None:
    world = standing(arm)
    largest = disks_for(3, arm.size)[-1].radius
    assert arm.opening > largest
    for opening in (largest, arm.opening):
        world.robot.grip(opening)
        for _ in range(60):
            world.step()
        told = world.robot.status()["gripper"]
        assert told == f"{2000 * opening:.0f} mm, {arm.force:.0f} N"
    world.close()


def test_a_finger_that_is_no_joint_is_refused_with_the_joints_that_are() -> None:
    wrong = replace(arm_named("panda"), fingers=("left_finger", "right_finger"))
    with pytest.raises(WorldError, match="no joint 'left_finger'") as refused:
        standing(wrong)
    assert "'panda_finger_joint1'" in refused.value.advice


def test_corners_of_a_way_may_be_plain_tuples() -> None:
    world = standing(arm_named("panda"))
    for _ in travel(world, [(0.45, 0.0, 0.3), (0.45, 0.1, 0.3)], 0.4):
        world.step()
    assert tool(world) == pytest.approx((0.45, 0.1, 0.3), abs=0.01)
    world.close()


def test_a_jaw_turns_as_far_as_it_opens() -> None:
    jaw = Jaw(0.02, 0.008)
    for opening in (0.0, 0.008, 0.0165):
        assert jaw.opening(jaw.angle(opening)) == pytest.approx(opening, abs=1e-12)
    assert jaw.angle(0.008) == pytest.approx(0.0, abs=1e-12)


@by_name
def test_each_link_of_an_arm_is_drawn_in_its_place(arm: Robot) -> None:
    world = standing(arm)
    shapes = world.shapes()
    assert len(shapes) > 8
    assert len(world.poses()) == 7 * len(shapes)
    assert sum(len(shape.mesh) for shape in shapes) // 9 < 40_000
    world.close()
