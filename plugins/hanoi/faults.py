"""The faults of the table, for tests and exercises. They change the world, never the sensors.

A generator is resumed once per tick, after the command to the arm and before the world moves. Some
generators wait until a ring is in the hand.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import TYPE_CHECKING, Any

from smsl_studio.errors import WorldError
from smsl_studio.world.mishaps import seize

from .disks import CAP, CAP_HEIGHT, CAP_LID, MIDDLE, PEG_TOP, PEGS, Disk, cap_aside
from .fault_effects import EFFECTS

if TYPE_CHECKING:
    from smsl_studio.library.operation_library import OperationLibrary

    from .table import Table

Fault = Generator[None, None, None]

OTHER = "hanoi-mujoco"
"""The name of the world in the other engine."""

RAISED = 0.03
"""The height (m) of a held ring's lower side above the table from which it counts as lifted."""


def gripper_opens(table: Table, after: float = 0.6, seconds: float = 0.3) -> Fault:
    """The fingers open a given time (s) after a ring was lifted, and stay open for a while."""
    yield from _until_lifted(table)
    for _ in range(_ticks(table, after)):
        yield
    for _ in range(_ticks(table, seconds)):
        table.world.robot.open()
        yield


def slippery(table: Table, disk: int = 0, friction: float = 0.005) -> None:
    """A ring (0: every ring) gets a low friction, as if it were greased."""
    for one in table.disks if disk == 0 else (table.disk(disk),):
        table.world.rub(one.name, friction)


def blocked_peg(table: Table, peg: str, seconds: float = 0.0) -> Fault:
    """A cap is put over a peg, for ever or for a while. No ring goes on this peg."""
    if peg not in PEGS:
        raise WorldError(f"there is no peg {peg!r}", advice="There are the pegs a, b and c.")
    size = table.size
    tower = sum(disk.thickness for disk in table.on_peg(peg))
    rim = max(tower, (PEG_TOP - CAP_HEIGHT + CAP_LID) * size) + 0.0005 * size
    table.world.place(CAP, (*table.pegs[peg], rim + CAP_HEIGHT * size / 2))
    if seconds > 0.0:
        for _ in range(_ticks(table, seconds)):
            yield
        table.world.place(CAP, cap_aside(size))


def tower_carried(table: Table) -> Fault:
    """The next ring that is gripped sticks to the one below it, until it is let go."""
    held = None
    while (held := _gripped(table)) is None:
        yield
    below = _below(table, held)
    if below is None:
        return
    glue = table.world.stick(held.name, below.name)
    while table.world.fingers_on(held.name) == 2:
        yield
    table.world.unstick(glue)


def wrong_order(table: Table) -> Fault:
    """While a ring is in the hand, another ring is put on a smaller one: a ring of another peg, or
    the upper two rings of a tower change places."""
    if len(table.disks) < 3:
        raise WorldError("besides the ring in the hand there must be two, this table has fewer")
    yield from _until_lifted(table)
    towers = [(peg, table.on_peg(peg)) for peg in PEGS]
    tops = sorted((tower[-1] for _, tower in towers if tower), key=lambda disk: disk.number)
    if len(tops) > 1:
        _put_on(table, tops[1], tops[0])
        return
    peg, (*under, lower, upper) = next(found for found in towers if found[1])
    floor = sum(disk.thickness for disk in under) + upper.thickness / 2
    gap = 0.0005 * table.size
    for number, disk in enumerate((upper, lower)):
        height = floor + number * (upper.thickness + gap) + gap
        table.world.place(disk.name, (*table.pegs[peg], height))


def disk_pushed(table: Table, disk: int) -> None:
    """A ring lies beside its peg, flat on the table, towards the robot."""
    one = table.disk(disk)
    (_, y, _), _ = table.world.pose(one.name)
    x = MIDDLE - 0.10 * table.size
    table.world.place(one.name, (x, y, one.thickness / 2 + 0.001 * table.size))


def seized_joint(table: Table, joint: int = 1) -> None:
    """A joint of the arm (counted from 1 at the base) does not move any more."""
    seize(table.world, joint)


def disk_off_board(table: Table, disk: int) -> None:
    """A ring is out of reach of the arm and out of sight of the camera."""
    one = table.disk(disk)
    table.world.place(one.name, (0.45, 0.8, one.thickness / 2 + 0.001))


def weak_grip(table: Table, force: float = 0.1) -> None:
    """The fingers close with no more than this force (N)."""
    table.world.robot.weaken(force)


FAULTS: tuple[Callable[..., Any], ...] = (
    gripper_opens,
    slippery,
    blocked_peg,
    tower_carried,
    wrong_order,
    disk_pushed,
    seized_joint,
    disk_off_board,
    weak_grip,
)


def register_faults(library: OperationLibrary) -> None:
    """Register the nine faults of the worlds ``hanoi`` and ``hanoi-mujoco``."""
    for function in FAULTS:
        for world in ("hanoi", OTHER):
            name = function.__name__
            library.fault(world, name, effect=EFFECTS[name])(function)


def _until_lifted(table: Table) -> Fault:
    """Wait until a ring is in the hand and off the table."""
    while True:
        held = _gripped(table)
        if held is not None:
            (_, _, z), _ = table.world.pose(held.name)
            if z - held.thickness / 2 > RAISED * table.size:
                return
        yield


def _gripped(table: Table) -> Disk | None:
    return next((one for one in table.disks if table.world.fingers_on(one.name) == 2), None)


def _below(table: Table, disk: Disk) -> Disk | None:
    """Return the ring directly under a ring, around the same peg."""
    (x, y, z), _ = table.world.pose(disk.name)
    under = []
    for other in table.disks:
        (ox, oy, oz), _ = table.world.pose(other.name)
        near = 0.015 * table.size
        if other is not disk and abs(ox - x) < near and abs(oy - y) < near and oz < z:
            under.append((oz, other))
    return max(under, key=lambda found: found[0])[1] if under else None


def _put_on(table: Table, upper: Disk, lower: Disk) -> None:
    (x, y, z), _ = table.world.pose(lower.name)
    height = (lower.thickness + upper.thickness) / 2 + 0.0005 * table.size
    table.world.place(upper.name, (x, y, z + height))


def _ticks(table: Table, seconds: float) -> int:
    return max(1, round(seconds / table.world.tick))
