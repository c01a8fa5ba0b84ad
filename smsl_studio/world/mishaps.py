"""What can go wrong with a piece in a gripper, written once for the faults of plugins. Each changes
the world, never a sensor.
"""

from __future__ import annotations

from collections.abc import Generator, Sequence
from typing import TYPE_CHECKING

from smsl_studio.errors import WorldError

if TYPE_CHECKING:
    from smsl_studio.world.bullet import BulletWorld

Fault = Generator[None, None, None]


def drop(world: BulletWorld, names: Sequence[str], after: float, seconds: float) -> Fault:
    """Open the fingers a given time (s) after a piece was gripped, and keep them open for a
    while."""
    while not any(world.fingers_on(name) == 2 for name in names):
        yield
    for _ in range(_ticks(world, after)):
        yield
    for _ in range(_ticks(world, seconds)):
        world.robot.open()
        yield


def grease(world: BulletWorld, names: Sequence[str], number: int, friction: float) -> None:
    """Give a piece (1 for the first, 0 for all) a low friction."""
    for name in names if number == 0 else (one_of(names, number),):
        world.rub(name, friction)


def topple(world: BulletWorld, names: Sequence[str], number: int) -> None:
    """Lay a piece down where it stands."""
    name = one_of(names, number)
    (x, y, z), _ = world.pose(name)
    world.place(name, (x, y, z), (0.7071068, 0.0, 0.0, 0.7071068))


def seize(world: BulletWorld, joint: int) -> None:
    """Block a joint of the arm, counted from 1 at its base."""
    count = len(world.robot.goal)
    if not 1 <= joint <= count:
        raise WorldError(f"the arm has no joint {joint}", advice=f"Its joints are 1 to {count}.")
    world.robot.seize(joint - 1)


def one_of(names: Sequence[str], number: int) -> str:
    """Return a piece by its number, 1 for the first. WorldError if there is none."""
    if not 1 <= number <= len(names):
        raise WorldError(f"there is no piece {number}", advice=f"There are {', '.join(names)}.")
    return names[number - 1]


def _ticks(world: BulletWorld, seconds: float) -> int:
    return max(1, round(seconds / world.tick))
