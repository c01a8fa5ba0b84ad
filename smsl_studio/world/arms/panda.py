"""The Franka Panda of the engine's models, with its hand."""

from __future__ import annotations

from smsl_studio.world.bodies import Robot

ARM = Robot(
    "panda",
    "franka_panda/panda.urdf",
    tool="panda_grasptarget",
    rest=(0.0, 0.05, 0.0, -2.25, 0.0, 2.3, 0.785),
    fingers=("panda_finger_joint1", "panda_finger_joint2"),
    opening=0.04,
    friction=1.2,
)
