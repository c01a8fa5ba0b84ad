"""The board: nine blocks in the shape of a T, and two pieces. It knows where each piece stands."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from smsl_studio.errors import WorldError
from smsl_studio.world.arms.panda import ARM
from smsl_studio.world.bodies import Body, Box, Floor, Hulls, Robot
from smsl_studio.world.grasps import Grasp
from smsl_studio.world.known_values import refuse_impossible, refuse_others
from smsl_studio.world.meshes import hulls_obj, slab, soup, turned
from smsl_studio.world.protocol import Vector
from smsl_studio.world.stations import Station

if TYPE_CHECKING:
    from smsl_studio.blueprint.model import Blueprint
    from smsl_studio.world.bullet import BulletWorld

Array = NDArray[np.float64]
Corners = list[tuple[float, float]]

PIECES = ("star", "circle")
"""The pieces in the order of the facts."""

PITCH = 0.04
"""The distance (m) of neighbouring blocks."""

ROWS = ("ABCD", "a.cd", "0..1")
"""The blocks as they lie: rows along x away from the arm's middle line, columns along y."""

MIDDLE = (0.50, 0.0)
BLOCKS: dict[str, tuple[float, float]] = {
    block: (MIDDLE[0] + PITCH * (1 - row), MIDDLE[1] + PITCH * (column - 1.5))
    for row, blocks in enumerate(ROWS)
    for column, block in enumerate(blocks)
    if block != "."
}
"""The middle of each block (m)."""

NEAR = {
    block: tuple(one for one, at in BLOCKS.items() if 0 < math.dist(at, middle) < 1.2 * PITCH)
    for block, middle in BLOCKS.items()
}
"""The blocks beside each block."""

BOTTOM, TOP = "B", "T"
HELD, NOWHERE = "hh", "xx"
PLACES = tuple(block + layer for block in BLOCKS for layer in (BOTTOM, TOP))
"""The places of a piece: each block, and there on the other piece."""

GROUND = 0.006
"""The height (m) of the blocks."""

HEIGHT = 0.026
RADIUS = 0.0115
"""The height of a piece, and its radius (m): that of the circle, and half of the star's square."""

JITTER = 0.015
"""The largest distance (m) of a piece's start from the middle of its block, along x and along y."""

APART = 0.034
"""The smallest distance (m) of two pieces at the start, so that fingers fit between them."""

LEVEL, TILT = 0.004, 0.98
"""The largest distance (m) of a standing piece from its height, and the smallest vertical part of
its axis: the cosine of 11 degrees."""

ON = 0.010
"""The largest distance (m) beside the middle of the piece below."""

HOLD, ABOVE = 0.006, 0.14
"""The height (m) of the tool above the middle of a piece, and on its way over everything."""

SETTLE = 4.0
"""The time (s) in which all must come to rest: a piece on another one rocks a little."""

WAYS = tuple(math.radians(angle) for angle in (0, 45, -45, 90))
"""The turns (rad) of the hand, in the order of preference."""


class Board:
    """The board with its two pieces in a physical world."""

    def __init__(self, world: BulletWorld, blueprint: Blueprint, seed: int) -> None:
        branches = list(blueprint)
        if len(branches) != 1 or branches[0].num_facts != len(PIECES):
            raise WorldError(
                "the chess world needs one State Branch with 2 facts: the star and the circle",
                advice="Use the world table, which runs any blueprint.",
            )
        refuse_others(branches[0], PIECES, (*PLACES, HELD, NOWHERE))
        refuse_impossible(branches[0], impossible)
        self.world, self.seed = world, seed

    def furnish(self) -> None:
        """Put all bodies into the empty world: the star on block 0, the circle on block 1."""
        self.world.add(Body("floor", Floor(), (0.0, 0.0, 0.0)))
        for block in _blocks():
            self.world.add(block)
        for name, place in self._starts({"star": "0B", "circle": "1B"}):
            self.world.add(_piece(name, place))
        self.world.add(ARM)
        self.world.settle(SETTLE)

    def arrange(self, facts: Mapping[str, str]) -> None:
        """Begin again with each piece at its place. Equal places and an equal seed give an equal
        world. WorldError if the places cannot be built, such as a piece on top of nothing."""
        starts = list(self._starts(facts))
        self.world.rebuild()
        for name, place in starts:
            self.world.place(name, place)
        self.world.settle(SETTLE)

    def reading(self, piece: str) -> str:
        """Return the block of a piece and its layer, ``hh`` if it is held, and ``xx`` if it stands
        neither on a block nor on the other piece."""
        if self.world.fingers_on(piece) == 2:
            return HELD
        x, y, z = self.middle(piece)
        if not self._is_upright(piece):
            return NOWHERE
        if abs(z - HEIGHT / 2 - GROUND) < LEVEL:
            block = self._block_at(x, y)
            return block + BOTTOM if block else NOWHERE
        other = self.other(piece)
        ox, oy, oz = self.middle(other)
        stands = self._is_upright(other) and abs(oz - HEIGHT / 2 - GROUND) < LEVEL
        above = abs(z - oz - HEIGHT) < LEVEL and math.hypot(x - ox, y - oy) < ON
        block = self._block_at(ox, oy)
        return block + TOP if stands and above and block else NOWHERE

    def is_free(self, piece: str) -> bool:
        """Whether nothing stands on a piece."""
        x, y, z = self.middle(piece)
        ox, oy, oz = self.middle(self.other(piece))
        return not (oz > z + HEIGHT / 2 and math.hypot(x - ox, y - oy) < 2 * RADIUS)

    def place_on(self, piece: str, block: str) -> Array:
        """Return where a piece would stand (m): on the other one, if that is on this block, or in
        the middle of the block."""
        other = self.other(piece)
        if self.reading(other) == block + BOTTOM:
            x, y, z = self.middle(other)
            return np.array([x, y, z + HEIGHT])
        return np.array([*BLOCKS[block], GROUND + HEIGHT / 2])

    def grasp(self, piece: str, place: Array) -> Grasp:
        """Return how the fingers hold a piece so that they have room at its place and where it
        goes."""
        x, y, z = self.middle(piece)
        ox, oy, oz = self.middle(self.other(piece))

        def room(turn: float) -> float:
            """Return how far the fingers stay beside the other piece (m), up to enough."""
            along = np.array([-math.sin(turn), math.cos(turn)])
            free = 0.04
            for here, height in (((x, y), z), (place[:2].tolist(), float(place[2]))):
                off = np.array([ox - here[0], oy - here[1]])
                if height - oz < HEIGHT / 2 and np.hypot(*off) > 0.001:
                    ends = (along * 0.03, along * -0.03)
                    free = min(free, *(float(np.hypot(*(off - end))) for end in ends))
            return round(free, 3)

        return Grasp(RADIUS, HOLD, ABOVE, 0.02, max(WAYS, key=room))

    def other(self, piece: str) -> str:
        """Return the other piece."""
        return PIECES[1 - PIECES.index(piece)]

    def middle(self, piece: str) -> tuple[float, float, float]:
        """Return the middle of a piece (m)."""
        (x, y, z), _ = self.world.pose(piece)
        return x, y, z

    def _is_upright(self, piece: str) -> bool:
        _, (qx, qy, _, _) = self.world.pose(piece)
        return 1.0 - 2.0 * (qx * qx + qy * qy) > TILT

    def _block_at(self, x: float, y: float) -> str:
        """Return the block under a point, or the empty text."""
        for block, (bx, by) in BLOCKS.items():
            if abs(x - bx) < PITCH / 2 and abs(y - by) < PITCH / 2:
                return block
        return ""

    def _starts(self, facts: Mapping[str, str]) -> Iterator[tuple[str, Vector]]:
        """Return the start (m) of each piece, moved from the middle of its block by the jitter of
        the seed; a piece on the other one stands in the middle of that."""
        for piece in PIECES:
            block, layer = (facts.get(piece) or "  ")[:1], (facts.get(piece) or "  ")[1:]
            if block not in BLOCKS or layer not in (BOTTOM, TOP):
                raise WorldError(
                    f"the {piece} cannot start at {facts.get(piece)!r}",
                    advice=f"Blocks are {' '.join(BLOCKS)}, layers are B and T.",
                )
        blocks = [facts[piece][0] for piece in PIECES]
        layers = "".join(facts[piece][1] for piece in PIECES)
        reason = impossible([facts[piece] for piece in PIECES])
        if reason:
            raise WorldError(reason)
        z = GROUND + HEIGHT / 2 + 0.0005
        below = layers.index(BOTTOM)
        draw = np.random.default_rng(self.seed)
        while True:
            moved = draw.uniform(-JITTER, JITTER, (2, 2)).tolist()
            at = [np.add(BLOCKS[block], off) for block, off in zip(blocks, moved, strict=True)]
            if TOP in layers or np.hypot(*(at[0] - at[1])) > APART:
                break
        for number, piece in enumerate(PIECES):
            if layers[number] == TOP:
                x, y = at[below].tolist()
                yield piece, (x, y, z + HEIGHT + 0.0005)
            else:
                x, y = at[number].tolist()
                yield piece, (x, y, z)


def stations_of(_: Robot) -> dict[str, tuple[Station, ...]]:
    """Return where the tool is at each block, for the operations that bring a piece there."""
    low, high = GROUND + HEIGHT / 2 + HOLD, ABOVE
    found: dict[str, tuple[Station, ...]] = {}
    for block, (x, y) in BLOCKS.items():
        stations = (Station(f"block {block}", (x, y, low)), Station(f"above {block}", (x, y, high)))
        found[f"move-{{piece}}-chess-to-block-{case_of(block)}"] = stations
    return found


def case_of(block: str) -> str:
    """Return the name of a block in the names of operations."""
    case = "uppercase-" if block.isupper() else "lowercase-" if block.islower() else ""
    return f"{case}{block}"


def impossible(places: Sequence[str]) -> str:
    """Return why two pieces cannot stand at these places, or the empty text. Of a piece that is
    held or stands nowhere nothing is said."""
    if not all(place in PLACES for place in places):
        return ""
    one, other = places
    if one == other and one[1] == BOTTOM:
        return f"both pieces would be in one place, on block {one[0]}"
    tops = [place[1] for place in places].count(TOP)
    if tops == 2 or (one[0] == other[0]) != (tops == 1):
        return "a piece on top needs the other one below it on the same block"
    return ""


def _piece(name: str, place: Vector) -> Body:
    half = HEIGHT / 2
    star = name == "star"
    corners = 4 if star else 12
    reach = RADIUS / math.cos(math.pi / corners)
    angles = [(2 * k + 1) * math.pi / corners for k in range(corners)]
    ring = [(reach * math.cos(a), reach * math.sin(a)) for a in angles]
    return Body(
        name,
        Hulls(_prism(ring, half)),
        place,
        friction=0.8,
        mass=0.03,
        mesh=soup(_star(half) if star else turned(_round(half), 32)),
        colour=(0.88, 0.48, 0.10) if star else (0.20, 0.29, 0.76),
        label=name,
    )


def _prism(ring: Corners, half: float) -> str:
    """Return OBJ text of an upright prism, smaller by the engine's margin (1 mm)."""
    small = 1.0 - 0.001 / RADIUS
    count = len(ring)
    low, high = 0.001 - half, half - 0.001
    corners = [(small * x, small * y, z) for z in (low, high) for x, y in ring]
    sides = [(i, (i + 1) % count, (i + 1) % count + count, i + count) for i in range(count)]
    return hulls_obj([corners], [tuple(range(count))[::-1], tuple(range(count, 2 * count)), *sides])


def _round(half: float) -> Corners:
    edge = RADIUS - 0.0015
    return [(0.0, -half), (RADIUS, -half), (RADIUS, half - 0.0015), (edge, half), (0.0, half)]


def _star(half: float) -> NDArray[np.float32]:
    """Return the mesh of an upright star with eight points. Between two points there are the flat
    sides for the fingers."""
    ring = [
        (reach * math.cos(angle), reach * math.sin(angle))
        for k in range(16)
        for reach in (RADIUS if k % 2 == 0 else 1.3 * RADIUS,)
        for angle in (k * math.pi / 8,)
    ]
    found = []
    for (ax, ay), (bx, by) in zip(ring, [*ring[1:], ring[0]], strict=True):
        low = [(ax, ay, -half), (bx, by, -half), (0.0, 0.0, -half)]
        high = [(ax, ay, half), (bx, by, half), (0.0, 0.0, half)]
        found += [low[::-1], high, [low[0], low[1], high[1]], [low[0], high[1], high[0]]]
    return np.array(found, dtype=np.float32)


def _blocks() -> Iterator[Body]:
    half = (PITCH / 2 - 0.001, PITCH / 2 - 0.001, GROUND / 2)
    for number, (block, (x, y)) in enumerate(BLOCKS.items()):
        dark = number % 2
        yield Body(
            f"block_{block}",
            Box((PITCH / 2, PITCH / 2, GROUND / 2)),
            (x, y, GROUND / 2),
            friction=0.6,
            mesh=soup(slab(half)),
            colour=(0.62, 0.62, 0.60) if dark else (0.86, 0.85, 0.82),
            label=block,
        )
