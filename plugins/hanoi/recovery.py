"""The recovery of a lost ring: it is found by its pose, gripped where it lies, and put on a peg.

The fingers come down in a direction without obstacles.
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator
from typing import TYPE_CHECKING

import numpy as np

from smsl_studio.world.motions import DOWN, Array, tool, travel, wait

from .disks import CAP, CAP_RADIUS, PEG_RADIUS, TIPS, Disk
from .moves import (
    CAREFUL,
    CLOSING,
    SQUEEZE,
    TRAVEL,
    above,
    bring,
    centre_of,
)

if TYPE_CHECKING:
    from .table import Table

UPRIGHT = 0.85
"""The smallest vertical part of the axis of a ring that can be gripped from above: the cosine of 32
degrees."""

WAYS = tuple(math.radians(angle) for angle in (0, 45, -45, 90))
"""The turns (rad) of the hand from its usual direction, in the order of preference."""

SPREAD = 0.05
"""The distance (m) of an opened finger's outer side from the middle."""

FINGER = 0.012
"""Half of the width of a finger with a small clearance (m)."""


def recover(table: Table, disk: Disk, peg: str) -> Generator[None, None, bool]:
    """Bring a ring onto a peg, from any place on the table or from the hand. Return False if that
    fails.

    The operation fails at once if the ring is too tilted, out of sight, or under another ring.
    """
    return (yield from bring(table, disk, peg, _can_be_gripped, _pick))


def _can_be_gripped(table: Table, disk: Disk) -> bool:
    if table.reading(disk) is None:
        return False
    (x, y, z), (qx, qy, _, _) = table.world.pose(disk.name)
    if abs(1.0 - 2.0 * (qx * qx + qy * qy)) < UPRIGHT:
        return False
    for other in table.disks:
        (ox, oy, oz), _ = table.world.pose(other.name)
        near = math.hypot(ox - x, oy - y) < 0.9 * (other.radius + disk.radius)
        if other is not disk and near and oz > z + disk.thickness / 2:
            return False
    return True


def _pick(table: Table, disk: Disk) -> Generator[None, None, None]:
    """Turn the hand to a free direction, move it down around the ring, and close the fingers."""
    world = table.world
    centre = centre_of(world, disk)
    turned = _about_z(_clearest(table, disk)) @ DOWN
    grasp = np.add(centre, (0.0, 0.0, TIPS * table.size - disk.thickness / 2))
    world.robot.open()
    yield from travel(world, [above(table, tool(world)), above(table, centre)], TRAVEL)
    yield from travel(world, [grasp], CAREFUL, turned)
    world.robot.grip(disk.radius - SQUEEZE * table.size)
    yield from wait(CLOSING)


def _clearest(table: Table, disk: Disk) -> float:
    """Return the turn of the hand (rad) with which the fingers come down beside all obstacles."""
    (x, y, z), _ = table.world.pose(disk.name)
    size, obstacles = table.size, list(_obstacles(table, disk, z))

    def room(angle: float) -> float:
        """Return the smallest distance (m) of an opened finger to an obstacle, up to a sufficient
        distance."""
        along = np.array([-math.sin(angle), math.cos(angle)])
        free = 0.02 * size
        for place, radius in obstacles:
            for side in (along, -along):
                inner, outer = disk.radius * side, SPREAD * size * side
                gap = _distance(np.array(place) - (x, y), inner, outer) - radius - FINGER * size
                free = min(free, gap)
        return round(free / size, 3)

    return max(WAYS, key=room)


def _obstacles(
    table: Table, disk: Disk, height: float
) -> Iterator[tuple[tuple[float, float], float]]:
    """Return middle and radius (m) of each obstacle that is as high as the fingers come."""
    (x, y, _), _ = table.world.pose(disk.name)
    size, peg = table.size, PEG_RADIUS * table.size
    for place in table.pegs.values():
        if math.dist(place, (x, y)) > peg + 0.006 * size:  # not the peg inside the ring
            yield place, peg
    for other in table.disks:
        (ox, oy, oz), _ = table.world.pose(other.name)
        low = height - disk.thickness / 2 + 0.002 * size
        if other is not disk and oz + other.thickness / 2 > low:
            yield (ox, oy), other.radius
    (cx, cy, cz), _ = table.world.pose(CAP)
    if cz > height:
        yield (cx, cy), CAP_RADIUS * size


def _distance(point: Array, start: Array, end: Array) -> float:
    """Return the distance (m) of a point to a line segment in the plane of the table."""
    way = end - start
    share = float(np.clip(np.dot(point - start, way) / np.dot(way, way), 0.0, 1.0))
    return float(np.linalg.norm(point - start - share * way))


def _about_z(angle: float) -> Array:
    turned: Array = np.array(
        [
            [math.cos(angle), -math.sin(angle), 0.0],
            [math.sin(angle), math.cos(angle), 0.0],
            [0.0, 0.0, 1.0],
        ]
    )
    return turned
