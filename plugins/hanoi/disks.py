"""The bodies on the table: sizes, colours and meshes of rings and pegs (metres, kilograms).

All lengths are those for a robot of the size 1. ``size`` makes them smaller.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from smsl_studio.errors import WorldError
from smsl_studio.world.bodies import Body, Capsule, Hulls
from smsl_studio.world.meshes import hulls_obj, soup, turned
from smsl_studio.world.protocol import Vector

PEGS: dict[str, tuple[float, float]] = {"a": (0.50, -0.14), "b": (0.50, 0.0), "c": (0.50, 0.14)}
MIDDLE = 0.50
"""The distance (m) of the middle peg from the robot, for every size."""

PEG_RADIUS = 0.008
PEG_TOP = 0.045
CLEAR = PEG_TOP + 0.02
"""The height (m) of a carried ring's lower side on its way over the pegs."""

TIPS = 0.010
"""The height (m) of the tool above the lower side of a held ring. The tips of the fingers stay 3 mm
above this side."""

HOLE = 0.0135
"""Half of the distance (m) between opposite walls of a ring's hole."""

MARGIN = 0.001
"""The margin (m) by which Bullet thickens every convex piece. Pieces are made smaller by it."""

WEDGES = 8
COLOURS: tuple[Vector, ...] = (
    (0.88, 0.48, 0.10),
    (0.06, 0.52, 0.53),
    (0.20, 0.29, 0.76),
    (0.56, 0.26, 0.62),
)
RADII = {2: (0.022, 0.029), 3: (0.022, 0.029, 0.036), 4: (0.021, 0.026, 0.031, 0.036)}
THICKNESS = {2: 0.018, 3: 0.018, 4: 0.0135}


@dataclass(frozen=True, slots=True)
class Disk:
    """One ring. Number 1 is the smallest. Lengths are in metres."""

    number: int
    radius: float
    thickness: float
    size: float = 1.0

    @property
    def name(self) -> str:
        return f"disk_{self.number}"

    def body(self, position: Vector) -> Body:
        """Return the ring as a body of the world."""
        volume = math.pi * (self.radius**2 - self._hole**2) * self.thickness
        outline = self._outline()
        return Body(
            self.name,
            Hulls(self._wedges()),
            position,
            friction=0.7,
            mass=1200.0 * volume,
            mesh=soup(turned(outline)),
            colour=COLOURS[self.number - 1],
        )

    @property
    def _hole(self) -> float:
        return HOLE * self.size

    def _outline(self) -> list[tuple[float, float]]:
        """Return the outline (radius, height) in metres: up the outer wall, over the top, down the
        hole, and back along the bottom."""
        r, h, edge, hole = self.radius, self.thickness / 2, 0.0012 * self.size, self._hole
        top = [(r, edge - h), (r, h - edge), (r - edge, h), (hole + edge, h), (hole, h - edge)]
        bottom = [(hole, edge - h), (hole + edge, -h), (r - edge, -h), (r, edge - h)]
        return top + bottom

    def _wedges(self) -> str:
        """Return OBJ text with the wedges that the engine uses for the ring, smaller by its
        margin."""
        half = self.thickness / 2 - MARGIN
        return _hulls(_tube(self._hole + MARGIN, self.radius - MARGIN, -half, half))


def disks_for(count: int, size: float = 1.0) -> tuple[Disk, ...]:
    """Return the rings of a game, smallest first. WorldError if the world cannot have ``count``
    rings."""
    if count not in RADII:
        raise WorldError(
            f"the hanoi world has 2, 3 or 4 disks, and this blueprint has {count} facts",
            advice="Use a blueprint with one fact a disk, or the world table.",
        )
    thick = THICKNESS[count] * size
    return tuple(Disk(i + 1, r * size, thick, size) for i, r in enumerate(RADII[count]))


def pegs_for(size: float) -> dict[str, tuple[float, float]]:
    """Return where the pegs stand (m)."""
    return {name: (MIDDLE, y * size) for name, (_, y) in PEGS.items()}


def peg_body(name: str, size: float = 1.0) -> Body:
    """Return a peg as a body: a rod with a round top, whose foot is below the table."""
    x, y = pegs_for(size)[name]
    length, radius = 0.06 * size, PEG_RADIUS * size
    centre = PEG_TOP * size - radius - length / 2
    arc = np.linspace(0.0, math.pi / 2, 7)
    dome = [(radius * math.cos(a), length / 2 + radius * math.sin(a)) for a in arc.tolist()]
    outline = [(radius, -centre), *dome[:-1], (0.0, length / 2 + radius)]
    return Body(
        f"peg_{name}",
        Capsule(radius, length),
        (x, y, centre),
        friction=0.2,
        mesh=soup(turned(outline, 24)),
        colour=(0.32, 0.34, 0.38),
        label=name,
    )


CAP = "cap"
"""The name of the cap. No ring goes over a peg with the cap. It stands aside until a fault puts it
on a peg."""

CAP_ASIDE = (-0.38, -0.34)
"""Where it stands aside (m), from the middle peg."""

CAP_RADIUS, CAP_HOLE, CAP_HEIGHT, CAP_LID = 0.0175, 0.0115, 0.018, 0.004


def cap_aside(size: float) -> Vector:
    """Return where the cap stands aside (m)."""
    x, y = CAP_ASIDE
    return (MIDDLE + x * size, y * size, CAP_HEIGHT * size / 2)


def cap_body(size: float) -> Body:
    """Return the cap as a body. It fits over a peg, and stands on its rim beside the robot."""
    r, hole, half = CAP_RADIUS * size, CAP_HOLE * size, CAP_HEIGHT * size / 2
    lid, edge = half - CAP_LID * size, 0.002 * size
    outline = [(r, -half), (r, half - edge), (r - edge, half), (0.0, half)]
    inside = [(0.0, lid), (hole, lid), (hole, -half), (r, -half)]
    pieces = _tube(hole + MARGIN, r - MARGIN, MARGIN - half, lid)
    pieces += _tube(MARGIN, r - MARGIN, lid + MARGIN, half - MARGIN)
    return Body(
        CAP,
        Hulls(_hulls(pieces)),
        cap_aside(size),
        friction=0.7,
        mass=0.05,
        mesh=soup(turned(outline + inside, 24)),
        colour=(0.55, 0.57, 0.60),
    )


Corners = list[tuple[float, float, float]]


def _tube(inner: float, outer: float, low: float, high: float) -> list[Corners]:
    """Return the corners (m) of the wedges of a tube. Its hole is ``inner`` metres from wall to
    middle."""
    tight = inner / math.cos(math.pi / WEDGES)
    wedges: list[Corners] = []
    for wedge in range(WEDGES):
        angles = (wedge + np.array([0, 1 / 3, 2 / 3, 1])) * (2 * math.pi / WEDGES)
        ring = [(tight, angles[0]), (tight, angles[3]), *((outer, a) for a in angles[::-1])]
        flat = [(r * math.cos(a), r * math.sin(a)) for r, a in ring]
        wedges.append([(x, y, z) for z in (low, high) for x, y in flat])
    return wedges


def _hulls(wedges: list[Corners]) -> str:
    count = len(wedges[0]) // 2
    sides = [(i, (i + 1) % count, (i + 1) % count + count, i + count) for i in range(count)]
    return hulls_obj(wedges, [tuple(range(count))[::-1], tuple(range(count, 2 * count)), *sides])
