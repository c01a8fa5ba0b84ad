"""The kinematics of the arm without an engine: from joints to the tool's pose, and back."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.errors import WorldError
from smsl_studio.world.bodies import Robot
from smsl_studio.world.bullet import BulletWorld
from smsl_studio.world.kinematics import Arm, rotation_of, rotation_of_rpy
from smsl_studio.world.planned_world import MODELS
from smsl_studio.world.urdf import read_urdf
from tests.counts import share_of

PANDA = read_urdf(MODELS / "franka_panda" / "panda.urdf")
REST = (0.0, 0.05, 0.0, -2.25, 0.0, 2.3, 0.785)
ARM = Arm(PANDA.chain("panda_grasptarget"), REST)
DOWN = np.diag([1.0, -1.0, -1.0])


def test_the_file_is_read_whole() -> None:
    assert PANDA.root == "panda_link0"
    assert ARM.names == tuple(f"panda_joint{n}" for n in range(1, 8))
    assert len(PANDA.visuals) == 11
    assert all(visual.mesh.is_file() for visual in PANDA.visuals)
    with pytest.raises(WorldError, match="no link 'elbow'"):
        PANDA.chain("elbow")


@pytest.mark.parametrize("joints", [REST, (0.4, 0.3, -0.5, -1.7, 0.6, 1.9, 1.1)])
def test_the_tool_is_where_the_engine_has_it(joints: tuple[float, ...]) -> None:
    world = BulletWorld()
    world.add(Robot("arm", "franka_panda/panda.urdf", "panda_grasptarget", joints))
    position, turned = world.robot.frames()["panda_grasptarget"]
    expected, rotation = ARM.tool(np.array(joints))
    assert np.allclose(position, expected, atol=1e-5)
    assert np.allclose(rotation_of(turned), rotation, atol=1e-5)
    world.close()


@settings(max_examples=share_of(60))
@given(st.floats(0.35, 0.6), st.floats(-0.3, 0.3), st.floats(0.01, 0.4))
def test_the_arm_gets_where_it_is_sent(x: float, y: float, z: float) -> None:
    joints = ARM.solve(np.array([x, y, z]), DOWN, near=np.array(REST))
    position, rotation = ARM.tool(joints)
    assert np.abs(position - [x, y, z]).max() < 2e-5
    assert np.abs(rotation - DOWN).max() < 1e-3


def test_out_of_reach_is_said() -> None:
    with pytest.raises(WorldError, match=r"does not reach \[2\.0, 0\.0, 0\.5\]"):
        ARM.solve(np.array([2.0, 0.0, 0.5]), DOWN, near=np.array(REST))


def test_roll_pitch_yaw_turns_about_fixed_axes() -> None:
    turned = rotation_of_rpy((np.pi / 2, 0.0, np.pi / 2))
    assert np.allclose(turned @ [0.0, 1.0, 0.0], [0.0, 0.0, 1.0])
    assert np.allclose(turned @ [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
