"""The crossing: two banks, a boat between them, and four items. It knows where each item stands."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from smsl_studio.errors import WorldError
from smsl_studio.world.arms.panda import ARM
from smsl_studio.world.bodies import Body, Box, Floor, Robot
from smsl_studio.world.grasps import Grasp
from smsl_studio.world.known_values import refuse_impossible, refuse_others
from smsl_studio.world.meshes import slab, soup, turned
from smsl_studio.world.protocol import Vector
from smsl_studio.world.stations import Station

if TYPE_CHECKING:
    from smsl_studio.blueprint.model import Blueprint
    from smsl_studio.world.bullet import BulletWorld

Array = NDArray[np.float64]

ITEMS = ("grass", "sheep", "steve", "wolf")
"""The items in the order of the facts."""

COLOURS: tuple[Vector, ...] = (
    (0.30, 0.60, 0.22),
    (0.93, 0.92, 0.88),
    (0.20, 0.29, 0.76),
    (0.35, 0.36, 0.40),
)
PLACES = {"0": "red_land", "B": "boat", "1": "green_land"}
"""The values of a fact, and the words for them in the names of operations."""

HELD, NOWHERE = "h", "x"
HALF, HEIGHT = 0.014, 0.05
"""Half of the width of an item and its height (m)."""

BANKS = {"0": (-0.20, 0.004), "B": (0.0, 0.008), "1": (0.20, 0.004)}
"""The middle along y of both banks and of the boat, and the height of their ground (m)."""

SEATS = {"0": (0.39, 0.46, 0.53, 0.60), "B": (0.46, 0.53), "1": (0.39, 0.46, 0.53, 0.60)}
"""The places along x (m): one for each item on a bank, and two for anybody in the boat."""

DEPTH = {"0": 0.07, "B": 0.035, "1": 0.07}
"""Half of the width along y (m) of banks and boat."""

JITTER = 0.004
"""The largest distance (m) of an item's start from its place, along x and along y."""

LEVEL, TILT = 0.004, 0.98
"""The largest distance (m) of a standing item from its height, and the smallest vertical part of
its axis: the cosine of 11 degrees."""

GRASP = Grasp(HALF, 0.012, 0.16)


class Crossing:
    """The items of one river crossing in a physical world."""

    def __init__(self, world: BulletWorld, blueprint: Blueprint, seed: int) -> None:
        branches = list(blueprint)
        if len(branches) != 1 or branches[0].num_facts != len(ITEMS):
            raise WorldError(
                "the river world needs one State Branch with 4 facts: grass, sheep, steve, wolf",
                advice="Use the world table, which runs any blueprint.",
            )
        refuse_others(branches[0], ITEMS, (*PLACES, HELD, NOWHERE))
        refuse_impossible(branches[0], impossible)
        self.world, self.seed = world, seed

    def furnish(self) -> None:
        """Put all bodies into the empty world, with all items on the red land."""
        self.world.add(Body("floor", Floor(), (0.0, 0.0, 0.0)))
        for ground in _grounds():
            self.world.add(ground)
        start = self._starts(dict.fromkeys(ITEMS, "0"))
        for (item, place), colour in zip(start, COLOURS, strict=True):
            self.world.add(_item(item, place, colour))
        self.world.add(ARM)
        self.world.settle()

    def arrange(self, places: Mapping[str, str]) -> None:
        """Begin again with each item at its place. Equal places and an equal seed give an equal
        world. WorldError if a place cannot be built, such as three in the boat."""
        self.world.rebuild()
        for item, place in self._starts(places):
            self.world.place(item, place)
        self.world.settle()

    def reading(self, item: str) -> str:
        """Return where an item is: ``0``, ``B`` or ``1`` if it stands there, ``h`` if it is held,
        and ``x`` elsewhere."""
        if self.world.fingers_on(item) == 2:
            return HELD
        (x, y, z), (qx, qy, _, _) = self.world.pose(item)
        if 1.0 - 2.0 * (qx * qx + qy * qy) < TILT:
            return NOWHERE
        for value, (middle, ground) in BANKS.items():
            low, high = SEATS[value][0] - 0.04, SEATS[value][-1] + 0.04
            inside = low < x < high and abs(y - middle) < DEPTH[value]
            if inside and abs(z - HEIGHT / 2 - ground) < LEVEL:
                return value
        return NOWHERE

    def seat(self, item: str, value: str) -> Array | None:
        """Return where an item would stand (m): its own place on a bank, a free one in the boat.
        None if there is no free place."""
        y, ground = BANKS[value]
        seats = SEATS[value]
        wanted = seats if value == "B" else (seats[ITEMS.index(item)],)
        for x in wanted:
            if not any(self._stands_near(other, x, y) for other in ITEMS if other != item):
                return np.array([x, y, ground + HEIGHT / 2])
        return None

    def _stands_near(self, item: str, x: float, y: float) -> bool:
        (ix, iy, _), _ = self.world.pose(item)
        return abs(ix - x) < 2.2 * HALF and abs(iy - y) < 2.2 * HALF

    def _starts(self, places: Mapping[str, str]) -> Iterator[tuple[str, Vector]]:
        """Return the start (m) of each item, moved from its place by the jitter of the seed."""
        jitter = np.random.default_rng(self.seed).uniform(-JITTER, JITTER, (len(ITEMS), 2))
        aboard = iter(SEATS["B"])
        for number, item in enumerate(ITEMS):
            value = places.get(item, "")
            if value not in BANKS:
                raise WorldError(f"{item} cannot start at {value!r}: there are 0, B and 1")
            y, ground = BANKS[value]
            x = next(aboard, None) if value == "B" else SEATS[value][number]
            if x is None:
                raise WorldError(FULL, advice="Choose another start.")
            dx, dy = jitter[number].tolist()
            yield item, (x + dx, y + dy, ground + HEIGHT / 2 + 0.0005)


def stations_of(_: Robot) -> dict[str, tuple[Station, ...]]:
    """Return where the tool is at each seat of a bank or of the boat, for the operations that bring
    an item there."""
    found = {}
    for value, (y, ground) in BANKS.items():
        low, high = ground + HEIGHT / 2 + GRASP.high, GRASP.clear
        words = PLACES[value].replace("_", " ")
        found[f"move_{{item}}_from_{{other}}_to_{PLACES[value]}"] = tuple(
            Station(f"{where} {number} of the {words}", (x, y, z))
            for number, x in enumerate(SEATS[value], 1)
            for where, z in (("place", low), ("above place", high))
        )
    return found


FULL = "at most two can be in the boat"


def impossible(places: Sequence[str]) -> str:
    """Return why the items cannot be at these places, or the empty text."""
    return FULL if places.count("B") > len(SEATS["B"]) else ""


BOTH = ("grass", "wolf")
"""What the sheep eats, and what eats the sheep."""


def forbidden(places: Mapping[str, str], item: str, value: str) -> str:
    """Return why nobody may bring an item to a place now, or the empty text.

    The boat lies where Steve is. Two can be in it, and one of two is Steve. He leaves no sheep
    alone with the grass or the wolf.
    """
    steve = places["steve"]
    bank = value if value != "B" else places[item]
    if item != "steve" and steve not in ("B", bank):
        return "the boat lies at the other bank"
    after = {**places, item: value}
    aboard = list(after.values()).count("B")
    if aboard > 2:
        return FULL
    if aboard == 2 and after["steve"] != "B":
        return "one of two in the boat is Steve"
    sheep = after["sheep"]
    if sheep in ("0", "1") and after["steve"] != sheep:
        eaten = next((one for one in BOTH if after[one] == sheep), "")
        return f"sheep and {eaten} would be alone" if eaten else ""
    return ""


def _item(name: str, place: Vector, colour: Vector) -> Body:
    """Return an item: a block that looks like a figure with a head."""
    half = HEIGHT / 2
    body, head = HALF, 0.009
    outline = [(0.0, -half), (body, -half), (body, 0.4 * half), (head, 0.5 * half)]
    outline += [(head, half - 0.002), (head - 0.002, half), (0.0, half)]
    return Body(
        name,
        Box((HALF, HALF, half)),
        place,
        friction=0.8,
        mass=0.06,
        mesh=soup(turned(outline, 24)),
        colour=colour,
        label=name,
    )


def _grounds() -> Iterator[Body]:
    colours: dict[str, Vector] = {
        "0": (0.78, 0.44, 0.38),
        "B": (0.55, 0.42, 0.28),
        "1": (0.50, 0.66, 0.42),
    }
    for value, (y, ground) in BANKS.items():
        wide = (SEATS[value][-1] - SEATS[value][0]) / 2 + 0.04
        middle = (SEATS[value][-1] + SEATS[value][0]) / 2
        half = (wide, DEPTH[value], ground / 2)
        yield Body(
            PLACES[value],
            Box(half),
            (middle, y, ground / 2),
            mesh=soup(slab(half)),
            colour=colours[value],
            label=PLACES[value].replace("_", " "),
        )
