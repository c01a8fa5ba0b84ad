"""Motions of an arm, written once for all plugins. Each ``yield`` is one tick of the world.

A motion may be dropped at any ``yield``. The arm then holds its last commanded position.
"""

from __future__ import annotations

from collections.abc import Generator, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from smsl_studio.world.paths import minimum_jerk, rounded, timetable, waypoints

if TYPE_CHECKING:
    from smsl_studio.world.bullet import BulletWorld

Array = NDArray[np.float64]
Motion = Generator[None, None, None]

DOWN: Array = np.diag([1.0, -1.0, -1.0])
"""The rotation of a tool that points down, with fingers that close along y."""

TURNING = 0.6
"""The time (s) for a quarter turn of the hand."""

SWING = 0.8
"""The greatest speed (rad/s) of a joint on its way to another posture."""

CORNER, SPACING = 0.03, 0.012
"""The distance (m) from a corner at which a way begins to be rounded, and that of the points at
which the joints are computed, for a robot of the size 1."""


def travel(
    world: BulletWorld, corners: Sequence[ArrayLike], speed: float, rotation: Array = DOWN
) -> Motion:
    """Move the tool smoothly from its commanded position through the corners (x, y, z in m).

    ``speed`` is the greatest speed (m/s) of a robot of the size 1; a smaller robot is slower.
    ``rotation`` (3, 3) is that of the tool on the whole way.
    WorldError if the arm does not reach a point of the way.
    """
    yield from turn(world, rotation)
    start, size = world.robot.goal, world.robot.size
    path = rounded([world.arm.tool(start)[0], *map(np.asarray, corners)], CORNER * size)
    points, ways = waypoints(path, SPACING * size)
    if ways[-1] < 1e-6:
        return
    joints = [start]
    for point in points[1:]:
        joints.append(world.arm.solve(point, rotation, near=joints[-1]))
    before = start
    for segment, share in timetable(ways, speed * size, world.tick):
        here = joints[segment] + (joints[segment + 1] - joints[segment]) * share
        world.robot.drive(here, (here - before) / world.tick)
        before = here
        yield
    world.robot.drive(joints[-1])
    yield


def swing(world: BulletWorld, position: Array, rotation: Array) -> Motion:
    """Move all joints smoothly to the posture in which the tool has a position (m) and a rotation
    (3, 3). The tool's way between is no straight line.

    WorldError if the arm does not reach the pose.
    """
    yield from bend(world, world.arm.solve(position, rotation, near=world.robot.goal))


def bend(world: BulletWorld, joints: Sequence[float] | Array) -> Motion:
    """Move all joints smoothly to other angles (rad)."""
    start, end = world.robot.goal, np.asarray(joints, dtype=np.float64)
    longest = float(np.abs(end - start).max())
    ticks = int(1.875 * longest / SWING / world.tick)
    before = start
    for tick in range(1, ticks + 1):
        here = start + (end - start) * minimum_jerk(tick / ticks)
        world.robot.drive(here, (here - before) / world.tick)
        before = here
        yield
    world.robot.drive(end)
    yield


def turn(world: BulletWorld, rotation: Array) -> Motion:
    """Turn the tool at its place. Nothing happens if it has this rotation already."""
    start = world.robot.goal
    place, turned = world.arm.tool(start)
    if np.abs(turned - rotation).max() < 0.01:
        return
    end = world.arm.solve(place, rotation, near=start)
    ticks = int(TURNING / world.tick)
    for tick in range(1, ticks + 1):
        world.robot.drive(start + (end - start) * minimum_jerk(tick / ticks))
        yield


def wait(ticks: int) -> Motion:
    """Let the world go on for some ticks."""
    for _ in range(ticks):
        yield


def tool(world: BulletWorld) -> Array:
    """Return the real position of the tool (m)."""
    return world.arm.tool(world.robot.joints())[0]
