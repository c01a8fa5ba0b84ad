"""The patient-side manipulator of the da Vinci Research Kit (dVRK), in primitive shapes.

Six joints: outer yaw, outer pitch, insertion, outer roll, wrist pitch and wrist yaw, and a jaw. The
first two axes and the shaft meet in one point, the remote centre of motion, where the trocar sits.

The lengths are those that the community publishes: l_RCC 431.8 mm, l_tool 416.2 mm, wrist pitch to
yaw 9.1 mm, yaw to control point 10.2 mm. They stand so in ``dVRK_PSMmodel.m`` of
HuangJingGitHub/PracMakePert_m and in ``model_instrument.m`` of linhongbin-ws/soft-rcm-control,
which also has the limits of the wrist; ``dvrkVariables.py`` of BerkeleyAutomation/FLSpegtransferHO
has the same but 9.5 mm to the tip. Instruments differ in their jaws. The control point of this one
is between the roots of long jaws, as those of forceps are, so that a ring is held from outside
while its peg stands between the jaws. All shapes are of our own.
"""

from __future__ import annotations

import math

from smsl_studio.world.bodies import Box, Capsule, Jaw, Robot, RobotLink, Solid
from smsl_studio.world.protocol import Vector

L_RCC, L_TOOL, PITCH_TO_YAW, YAW_TO_POINT = 0.4318, 0.4162, 0.0091, 0.0102
"""The published lengths (m)."""

CENTRE = (0.50, 0.0, 0.15)
"""The remote centre of motion (m): above the middle of the place of work."""

BEYOND = 0.010
"""The distance (m) of the tool point, between the tips of the jaws, from the control point."""

APART = 0.008
"""The distance (m) of each jaw from the middle when both are parallel."""

SHAFT = 0.0042
"""The radius (m) of the shaft."""

WHITE, GREY, DARK, STEEL, BLUE = (
    (0.92, 0.93, 0.94),
    (0.62, 0.65, 0.69),
    (0.20, 0.21, 0.24),
    (0.72, 0.74, 0.78),
    (0.16, 0.42, 0.62),
)
ALONG_Y, ALONG_X = (math.pi / 2, 0.0, 0.0), (0.0, math.pi / 2, 0.0)
"""Turns (roll, pitch, yaw) that lay a rod along y and along x."""


def _rod(radius: float, start: Vector, end: Vector, colour: Vector) -> Solid:
    """Return a rod between two points (m) in the plane x = 0."""
    _, y, z = (b - a for a, b in zip(start, end, strict=True))
    x0, y0, z0 = ((a + b) / 2 for a, b in zip(start, end, strict=True))
    turn = (-math.atan2(y, z), 0.0, 0.0)
    return Solid(Capsule(radius, math.hypot(y, z)), (x0, y0, z0), turn, colour)


def _jaw(side: int) -> RobotLink:
    """Return a jaw: ``side`` is 1 on the left and -1 on the right."""
    reach = YAW_TO_POINT + BEYOND
    thick, bow = 0.0012, 0.006
    return RobotLink(
        f"dvrk_jaw_{'left' if side > 0 else 'right'}",
        "dvrk_yaw",
        "revolute",
        rpy=(math.pi, 0.0, 0.0),
        axis=(-float(side), 0.0, 0.0),
        limits=(-0.6, 0.7),
        effort=1.0,
        mass=0.0005,  # much heavier jaws would shake the wrist through their gear
        solids=(
            _rod(0.0016, (0.0, 0.0, 0.0), (0.0, side * (APART + thick), bow), STEEL),
            Solid(
                Box((0.0035, thick, (reach + 0.002 - bow) / 2)),
                (0.0, side * (APART + thick), (reach + 0.002 + bow) / 2),
                colour=STEEL,
                hard=True,
            ),
        ),
    )


def _links() -> tuple[RobotLink, ...]:
    height = CENTRE[2]
    return (
        RobotLink(
            "dvrk_stand",
            mass=0.0,
            solids=(
                Solid(Box((0.10, 0.10, 0.012)), (-0.54, 0.0, 0.012 - height), colour=DARK),
                Solid(Capsule(0.045, height), (-0.54, 0.0, -height / 2), colour=WHITE),
                Solid(Capsule(0.048, 0.10), (-0.48, 0.0, 0.0), ALONG_X, WHITE),
            ),
        ),
        # Seen from here, y points away from the stand: the yaw axis.
        RobotLink("dvrk_centre", "dvrk_stand", rpy=(0.0, 0.0, -math.pi / 2), mass=0.0),
        RobotLink(
            "dvrk_outer_yaw",
            "dvrk_centre",
            "revolute",
            axis=(0.0, -1.0, 0.0),
            limits=(-1.58, 1.58),
            effort=40.0,
            mass=0.5,
            solids=(
                Solid(Capsule(0.046, 0.035), (0.0, -0.395, 0.0), ALONG_Y, BLUE),
                _rod(0.028, (0.0, -0.38, 0.02), (0.0, -0.335, 0.40), WHITE),
            ),
        ),
        RobotLink(
            "dvrk_outer_pitch",
            "dvrk_outer_yaw",
            "revolute",
            axis=(-1.0, 0.0, 0.0),
            limits=(-0.93, 0.93),
            effort=40.0,
            mass=0.5,
            solids=(
                *(
                    Solid(Capsule(0.011, 0.25), (x, -0.195, z), ALONG_Y, GREY)
                    for z in (0.24, 0.38)
                    for x in (-0.018, 0.018)
                ),
                Solid(Box((0.024, 0.013, 0.225)), (0.0, -0.055, 0.265), colour=WHITE),
                _rod(0.008, (0.0, -0.055, 0.045), (0.0, -0.012, 0.030), GREY),
                # The trocar: its tube goes through the centre of motion.
                Solid(Capsule(0.0065, 0.055), (0.0, 0.0, -0.002), colour=STEEL),
                Solid(Capsule(0.0115, 0.006), (0.0, 0.0, 0.033), colour=DARK),
                Solid(Capsule(0.0078, 0.001), colour=BLUE),
            ),
        ),
        RobotLink(
            "dvrk_insertion",
            "dvrk_outer_pitch",
            "prismatic",
            xyz=(0.0, 0.0, L_RCC),
            axis=(0.0, 0.0, -1.0),
            limits=(0.0, 0.24),
            effort=60.0,
            mass=0.3,
            solids=(
                Solid(Box((0.030, 0.020, 0.030)), (0.0, -0.020, 0.010), colour=GREY),
                Solid(Box((0.026, 0.022, 0.038)), (0.0, 0.020, 0.012), colour=BLUE),
            ),
        ),
        RobotLink(
            "dvrk_outer_roll",
            "dvrk_insertion",
            "revolute",
            axis=(0.0, 0.0, -1.0),
            limits=(-4.53, 4.53),
            effort=4.0,
            mass=0.1,
            solids=(Solid(Capsule(SHAFT, L_TOOL - 0.008), (0.0, 0.0, -L_TOOL / 2), colour=DARK),),
        ),
        RobotLink(
            "dvrk_wrist_pitch",
            "dvrk_outer_roll",
            "revolute",
            xyz=(0.0, 0.0, -L_TOOL),
            axis=(0.0, 1.0, 0.0),
            limits=(-1.39, 1.39),
            effort=3.0,
            mass=0.5,
            solids=(
                Solid(Capsule(0.0032, PITCH_TO_YAW), (0.0, 0.0, -PITCH_TO_YAW / 2), colour=STEEL),
            ),
        ),
        RobotLink(
            "dvrk_yaw",
            "dvrk_wrist_pitch",
            "revolute",
            xyz=(0.0, 0.0, -PITCH_TO_YAW),
            axis=(1.0, 0.0, 0.0),
            limits=(-1.39, 1.39),
            effort=3.0,
            mass=0.5,
            solids=(Solid(Capsule(0.0024, 0.005), rpy=ALONG_X, colour=STEEL),),
        ),
        _jaw(1),
        _jaw(-1),
        RobotLink(
            "dvrk_point",
            "dvrk_yaw",
            xyz=(0.0, 0.0, -YAW_TO_POINT),
            rpy=(math.pi, 0.0, 0.0),
            mass=0.0,
        ),
    )


ARM = Robot(
    "dvrk",
    "",
    tool="dvrk_point",
    rest=(0.0, 0.0, 0.10, -math.pi / 2, 0.0, 0.0),
    fingers=("dvrk_jaw_left", "dvrk_jaw_right"),
    opening=0.0165,
    friction=2.0,
    point=(0.0, 0.0, BEYOND),
    links=_links(),
    force=3.0,
    jaw=Jaw(YAW_TO_POINT + BEYOND, APART),
    base=CENTRE,
    size=0.38,
)
