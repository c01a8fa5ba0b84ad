"""The motions with which a robot carries a ring from peg to peg. Each ``yield`` is one tick.

Lengths and speeds are those of a robot of the size 1. The table makes them smaller.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from smsl_studio.errors import WorldError
from smsl_studio.world.motions import Motion, tool, travel, wait

from .disks import CLEAR, PEGS, TIPS, Disk
from .table import HELD

if TYPE_CHECKING:
    from smsl_studio.world.bullet import BulletWorld

    from .table import Table

Array = NDArray[np.float64]

TRAVEL, CAREFUL, GENTLE = 0.6, 0.35, 0.15
"""The greatest speeds (m/s): between pegs, while rings are lifted or lowered, and on short ways."""

SQUEEZE = 0.006
"""The distance (m) inside the ring's radius to which the closing fingers are sent."""

YIELDS = 0.005
"""The distance (m) that a ring is pushed up in the fingers before it counts as blocked."""

BESIDE = 0.03
"""The largest distance (m) of the tool beside a ring from which it comes down straight."""

CLOSING, OPENING = 36, 24
"""The number of ticks that the fingers take to open or close."""


def carry(table: Table, disk: Disk, peg: str) -> Generator[None, None, bool]:
    """Pick a ring up and put it on a peg. Return False if the grasp fails.

    A ring that is on this peg already is not moved. The operation fails at once if the hand holds
    another ring, or if other rings lie on top.
    """
    if peg not in PEGS:
        raise WorldError(f"there is no peg {peg!r}: there are the pegs a, b and c")
    return (yield from bring(table, disk, peg, _is_free, _pick))


def bring(
    table: Table,
    disk: Disk,
    peg: str,
    can_be_picked: Callable[[Table, Disk], bool],
    pick: Callable[[Table, Disk], Motion],
) -> Generator[None, None, bool]:
    """Pick a ring up with ``pick`` and put it on a peg. Return False if that fails.

    A ring that is on this peg already is not moved. A ring that is held already is not picked.
    """
    if table.reading(disk) == peg:
        return True
    if table.reading(disk) != HELD:
        hand_is_full = any(table.reading(other) == HELD for other in table.disks)
        if hand_is_full or not can_be_picked(table, disk):
            return False
        yield from pick(table, disk)
    if not (yield from lift(table, disk)):
        yield from let_go(table.world)
        return False
    return (yield from put(table, disk, peg))


def _is_free(table: Table, disk: Disk) -> bool:
    """Return whether no ring lies on top of this one."""
    stacks = (table.on_peg(peg) for peg in PEGS)
    return not any(disk in stack and stack[-1] is not disk for stack in stacks)


def _pick(table: Table, disk: Disk) -> Motion:
    """Move the tool down around the ring and close the fingers on it."""
    world = table.world
    centre = centre_of(world, disk)
    grasp = np.add(centre, (0.0, 0.0, TIPS * table.size - disk.thickness / 2))
    here = tool(world)
    # Right over the ring there is no way round, and a turn back in mid-way would be taken at speed.
    world.robot.open()
    if np.hypot(*(centre - here)[:2]) < BESIDE * table.size:
        yield from travel(world, [grasp], GENTLE)
    else:
        way = [above(table, here), above(table, centre), grasp]
        yield from travel(world, way, TRAVEL)
    world.robot.grip(disk.radius - SQUEEZE * table.size)
    yield from wait(CLOSING)


def lift(table: Table, disk: Disk) -> Generator[None, None, bool]:
    """Raise a gripped ring over the pegs, without turning the hand. Return whether the ring is
    still in the hand."""
    world = table.world
    if world.fingers_on(disk.name) < 2:
        return False
    turned = world.arm.tool(world.robot.goal)[1]
    yield from travel(world, [above(table, tool(world))], CAREFUL, turned)
    return world.fingers_on(disk.name) == 2


def put(table: Table, disk: Disk, peg: str) -> Generator[None, None, bool]:
    """Bring the middle of the ring over the peg, lower the ring onto the stack and release it.

    If the ring moves in the fingers on the way down, it has met an obstacle. Then it is raised
    again and stays in the hand.
    """
    world, size = table.world, table.size
    shift = tool(world) - centre_of(world, disk)
    over = np.array([*table.pegs[peg], CLEAR * size + disk.thickness / 2]) + shift
    yield from travel(world, [over], TRAVEL)
    if world.fingers_on(disk.name) < 2:
        yield from let_go(world)
        return False
    shift = tool(world) - centre_of(world, disk)
    height = sum(other.thickness for other in table.on_peg(peg)) + 0.001 * size
    down = np.array([*table.pegs[peg], height + disk.thickness / 2]) + shift
    for _ in travel(world, [down], CAREFUL):
        if (shift - tool(world) + centre_of(world, disk))[2] > YIELDS * size:
            yield from travel(world, [above(table, tool(world))], CAREFUL)
            return False
        yield
    yield from let_go(world)
    yield from travel(world, [above(table, tool(world))], CAREFUL)
    return True


def let_go(world: BulletWorld) -> Motion:
    world.robot.open()
    yield from wait(OPENING)


def centre_of(world: BulletWorld, disk: Disk) -> Array:
    return np.array(world.pose(disk.name)[0])


def above(table: Table, point: Array) -> Array:
    """Return the position (m) above a point at which a held ring passes over the pegs."""
    return np.array([point[0], point[1], (CLEAR + TIPS) * table.size])
