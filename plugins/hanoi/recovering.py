"""How a ring that was lost is brought back: found by its pose, gripped where it lies, put on a peg.

The fingers close along the direction in which nothing else stands in their way.
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator
from typing import TYPE_CHECKING

import numpy as np

from .disks import CAP, CAP_RADIUS, PEG_RADIUS, PEGS, Disk
from .moves import (
    CAREFUL,
    CLOSING,
    DOWN,
    SQUEEZE,
    TIPS,
    TRAVEL,
    Array,
    above,
    centre_of,
    let_go,
    lift,
    put,
    tool,
    travel,
    wait,
)
from .table import HELD

if TYPE_CHECKING:
    from .table import Table

UPRIGHT = 0.85
"""The least upward part of the axis of a ring that can be gripped from above: 32 degrees askew."""

WAYS = tuple(math.radians(angle) for angle in (0, 45, -45, 90))
"""How far (rad) the hand may be turned from its usual direction, the best liked first."""

SPREAD = 0.05
"""How far (m) from the middle an opened finger's outer side is."""

FINGER = 0.012
"""Half the width of a finger, with a little room (m)."""


def recover(table: Table, disk: Disk, peg: str) -> Generator[None, None, bool]:
    """Bring a ring onto a peg from wherever it lies, or from the hand; False where that fails.

    It is not even tried where the ring lies too much askew, out of sight, or under another.
    """
    if table.reading(disk) == peg:
        return True
    if table.reading(disk) != HELD:
        others = [other for other in table.disks if other is not disk]
        if any(table.reading(other) == HELD for other in others) or not _can_be_gripped(
            table, disk
        ):
            return False
        yield from _pick(table, disk)
    if not (yield from lift(table, disk)):
        yield from let_go(table.world)
        return False
    return (yield from put(table, disk, peg))


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
    """Come down around the ring, the hand turned as there is room, and close the fingers."""
    world = table.world
    centre = centre_of(world, disk)
    turned = _about_z(_clearest(table, disk)) @ DOWN
    grasp = np.add(centre, (0.0, 0.0, TIPS - disk.thickness / 2))
    world.robot.open()
    yield from travel(world, [above(tool(world)), above(centre)], TRAVEL)
    yield from travel(world, [grasp], CAREFUL, turned)
    world.robot.grip(disk.radius - SQUEEZE)
    yield from wait(CLOSING)


def _clearest(table: Table, disk: Disk) -> float:
    """The turn of the hand (rad) with which the fingers come down past everything else."""
    (x, y, z), _ = table.world.pose(disk.name)
    obstacles = list(_obstacles(table, disk, z))

    def room(angle: float) -> float:
        """The least distance (m) of an opened finger to anything; enough is enough."""
        along = np.array([-math.sin(angle), math.cos(angle)])
        free = 0.02
        for place, radius in obstacles:
            for side in (along, -along):
                inner, outer = disk.radius * side, SPREAD * side
                gap = _distance(np.array(place) - (x, y), inner, outer) - radius - FINGER
                free = min(free, gap)
        return round(free, 3)

    return max(WAYS, key=room)


def _obstacles(
    table: Table, disk: Disk, height: float
) -> Iterator[tuple[tuple[float, float], float]]:
    """What stands up to where the fingers come: the middle and radius (m) of each."""
    (x, y, _), _ = table.world.pose(disk.name)
    for place in PEGS.values():
        if math.dist(place, (x, y)) > PEG_RADIUS + 0.006:  # not the peg it lies around
            yield place, PEG_RADIUS
    for other in table.disks:
        (ox, oy, oz), _ = table.world.pose(other.name)
        if other is not disk and oz + other.thickness / 2 > height - disk.thickness / 2 + 0.002:
            yield (ox, oy), other.radius
    (cx, cy, cz), _ = table.world.pose(CAP)
    if cz > height:
        yield (cx, cy), CAP_RADIUS


def _distance(point: Array, start: Array, end: Array) -> float:
    """The distance (m) of a point to a stretch, in the plane of the table."""
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
