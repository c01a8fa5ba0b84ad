"""The KUKA LBR iiwa of the engine's models, with a gripper of two parallel fingers.

The models have no gripper for it that is a URDF file, so the hand is made of boxes. Its strokes are
those of the Panda's hand, and its body has about the size of a Schunk WSG 50.
"""

from __future__ import annotations

import math

from smsl_studio.world.bodies import Box, Capsule, Robot, RobotLink, Solid

FLANGE = 0.045
"""The distance (m) of the flange from the middle of link 7."""

BODY = 0.07
"""The height (m) of the body of the hand."""

BELOW = 0.055
"""The distance (m) of the tool point from the body. A peg stands between the fingers there."""

DARK, LIGHT = (0.20, 0.21, 0.23), (0.75, 0.77, 0.80)


def _finger(side: int) -> RobotLink:
    """Return a finger: ``side`` is 1 on the left and -1 on the right. Its inner face is at its
    origin."""
    return RobotLink(
        f"iiwa_finger_{'left' if side > 0 else 'right'}",
        "iiwa_hand",
        "prismatic",
        xyz=(0.0, 0.0, BODY),
        axis=(0.0, float(side), 0.0),
        limits=(0.0, 0.045),
        effort=40.0,
        solids=(
            Solid(Box((0.010, 0.005, 0.031)), (0.0, 0.005 * side, 0.031), colour=LIGHT, hard=True),
            Solid(Box((0.014, 0.011, 0.008)), (0.0, 0.011 * side, 0.004), colour=DARK),
        ),
    )


HAND = (
    RobotLink(
        "iiwa_hand",
        "lbr_iiwa_link_7",
        xyz=(0.0, 0.0, FLANGE),
        rpy=(0.0, 0.0, math.pi),
        mass=0.9,
        solids=(
            Solid(Box((0.025, 0.073, BODY / 2)), (0.0, 0.0, BODY / 2), colour=DARK, hard=True),
            Solid(Capsule(0.030, 0.012), (0.0, 0.0, 0.004), colour=LIGHT),
        ),
    ),
    _finger(1),
    _finger(-1),
    RobotLink("iiwa_grasp", "iiwa_hand", xyz=(0.0, 0.0, BODY + BELOW), mass=0.0),
)

ARM = Robot(
    "iiwa",
    "kuka_iiwa/model.urdf",
    tool="iiwa_grasp",
    rest=(0.0, 0.55, 0.0, -1.45, 0.0, 1.14, 0.0),
    fingers=("iiwa_finger_left", "iiwa_finger_right"),
    opening=0.04,
    friction=1.2,
    links=HAND,
)
