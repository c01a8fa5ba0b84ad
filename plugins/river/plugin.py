"""The river crossing in physics: Steve brings grass, a sheep and a wolf over a river (an example of
task families from publications of the paper's authors).

Each fact is the place of an item: ``0`` the red land, ``B`` the boat, ``1`` the green land. An item
in the hand reads ``h``; one that does not stand at a place reads ``x``. An operation fails at once
if the crossing forbids it: the boat lies where Steve is, and nobody may be eaten.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping
from typing import TYPE_CHECKING

from smsl_studio.world.arms.panda import ARM
from smsl_studio.world.grasps import move
from smsl_studio.world.mishaps import Fault, drop, grease, one_of, seize, topple

from .crossing import (
    BANKS,
    GRASP,
    HELD,
    ITEMS,
    PLACES,
    Crossing,
    forbidden,
    stations_of,
)
from .sensors import register_sensors

if TYPE_CHECKING:
    from smsl_studio.blueprint.model import Blueprint
    from smsl_studio.library.operation_library import OperationLibrary
    from smsl_studio.world.bullet import BulletWorld

Work = Generator[None, None, bool]


def bring(crossing: Crossing, item: str, start: str, value: str) -> Work:
    """Move an item from a place to the next one. Return False if it is not there, if the crossing
    forbids it, if there is no room, or if the grasp fails.

    An item that stands there already is not moved. Nothing moves while the hand holds another one.
    """
    places = {one: crossing.reading(one) for one in ITEMS}
    if places[item] == value:
        return True
    if any(places[other] == HELD for other in ITEMS if other != item):
        return False
    if places[item] != start or forbidden(places, item, value):
        return False
    place = crossing.seat(item, value)
    if place is None:
        return False
    return (yield from move(crossing.world, item, GRASP, place))


def step(item: str, start: str, value: str) -> Callable[[Crossing], Work]:
    """Return the function of the operation that moves an item to a place."""

    def carried(crossing: Crossing) -> Work:
        return (yield from bring(crossing, item, start, value))

    return carried


def gripper_opens(crossing: Crossing, after: float = 0.6, seconds: float = 0.3) -> Fault:
    """The fingers open a given time (s) after an item was gripped, and stay open for a while."""
    yield from drop(crossing.world, ITEMS, after, seconds)


def slippery(crossing: Crossing, item: int = 0, friction: float = 0.005) -> None:
    """An item (1 grass, 2 sheep, 3 Steve, 4 wolf; 0: every item) gets a low friction."""
    grease(crossing.world, ITEMS, item, friction)


def toppled(crossing: Crossing, item: int) -> None:
    """An item lies where it stood."""
    topple(crossing.world, ITEMS, item)


def third_aboard(crossing: Crossing, item: int) -> None:
    """An item stands across the boat, so nobody else has room there. WorldError if there is no
    such item."""
    y, ground = BANKS["B"]
    crossing.world.place(one_of(ITEMS, item), (0.495, y, ground + 0.0255))


def seized_joint(crossing: Crossing, joint: int = 1) -> None:
    """A joint of the arm (1 to 7, counted from the base) does not move any more."""
    seize(crossing.world, joint)


def weak_grip(crossing: Crossing, force: float = 0.1) -> None:
    """The fingers close with no more than this force (N)."""
    crossing.world.robot.weaken(force)


def register(library: OperationLibrary) -> None:
    """Register the world ``river`` with its operations, sensor and faults."""

    @library.world("river", settle=0.2, values=("0", "B", "1"))
    def build(world: BulletWorld, blueprint: Blueprint, seed: int) -> Crossing:
        crossing = Crossing(world, blueprint, seed)
        crossing.furnish()
        return crossing

    @library.arrange("river")
    def arrange(crossing: Crossing, facts: Mapping[tuple[str, int], str]) -> None:
        crossing.arrange({ITEMS[digit]: value for (_, digit), value in facts.items()})

    library.stations("river", robot=ARM)(stations_of)
    register_sensors(library)
    for item in ITEMS:
        for start, end in (("0", "B"), ("B", "0"), ("B", "1"), ("1", "B")):
            name = f"move_{item}_from_{PLACES[start]}_to_{PLACES[end]}"
            library.operation(name, stop="hold", timeout=30.0)(step(item, start, end))
    for fault in (gripper_opens, slippery, toppled, third_aboard, seized_joint, weak_grip):
        library.fault("river", fault.__name__)(fault)
