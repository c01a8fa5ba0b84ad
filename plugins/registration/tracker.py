"""The tracker: it sees the pointer and the reference frame, with noise, unless something is in the
way. What it measures is in the frame of the reference (metres)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from smsl_studio.world.bodies import Body, Box, Capsule
from smsl_studio.world.kinematics import rotation_of
from smsl_studio.world.meshes import Mesh, moved, slab, soup, turned
from smsl_studio.world.protocol import Vector

from .phantom import CENTRE, NAME

if TYPE_CHECKING:
    from smsl_studio.world.bullet import BulletWorld

Array = NDArray[np.float64]
Stand = tuple[Array, Array]
"""Where a marker stands: its position (m) and its rotation (3, 3)."""

REFERENCE, CAMERA = "reference", "tracker"
STAND: Vector = (0.57, -0.22, 0.09)
"""Where the reference frame stands (m) before anybody bumps it."""

EYE: Vector = (0.25, -0.75, 0.75)
"""Where the camera stands (m)."""

FIELD, THIN = (0.30, 0.20), 0.0007
"""Half of the width and of the height (m) of what it sees at the phantom, and half of the thickness
of the drawn edges."""

NOISE = 0.00025
"""The standard deviation (m) of one sample along each axis."""

SAMPLES = 30
"""How many samples of a landmark are averaged."""

MOVED = 0.0005
"""How far (m) reference and phantom may move against each other before what was measured is
void."""


class Tracker:
    """A camera that samples positions in the frame of the reference.

    ``occluded`` says that something is between it and what it looks at. ``noise`` is in metres.
    """

    def __init__(self, world: BulletWorld, seed: int) -> None:
        self._world = world
        self._seed = seed
        self.restart()

    def restart(self) -> None:
        """Begin again: nothing is in the way, and the noise is as usual."""
        self.occluded = False
        self.noise = NOISE
        self._draw = np.random.default_rng([self._seed, 7919])

    @property
    def stand(self) -> Stand:
        """The pose of the phantom's marker in the frame of the reference."""
        turn = rotation_of(self._world.pose(REFERENCE)[1])
        place, turned = self._world.pose(NAME)
        return self.exactly(np.array(place)), turn.T @ rotation_of(turned)

    def sample(self, point: Array) -> Array:
        """Return one measurement of a point of the room, in the frame of the reference."""
        return self.exactly(point) + self._draw.normal(0.0, self.noise, 3)

    def exactly(self, point: Array) -> Array:
        """Return a point of the room in the frame of the reference, without noise."""
        position, turn = self._world.pose(REFERENCE)
        found: Array = rotation_of(turn).T @ (point - np.array(position))
        return found

    def averaged(self, points: Sequence[Array]) -> Array:
        """Return the means of ``SAMPLES`` measurements of each point, (n, 3)."""
        return np.array([np.mean([self.sample(p) for _ in range(SAMPLES)], axis=0) for p in points])


def apart(one: Stand, other: Stand, arm: float = 0.2) -> float:
    """Return how far (m) two poses are apart. A turn counts as the way of a point at ``arm``."""
    angle = float(np.arccos(np.clip((np.trace(one[1].T @ other[1]) - 1) / 2, -1.0, 1.0)))
    return float(np.linalg.norm(one[0] - other[0])) + arm * angle


def reference_body() -> Body:
    """Return the reference frame: a small block with a ball that the tracker sees."""
    mesh = turned([(0.0, -0.02), (0.02, -0.02), (0.02, 0.012), (0.012, 0.02), (0.0, 0.02)], 24)
    blue = (0.2, 0.45, 0.9)
    cube = Box((0.02, 0.02, 0.02))
    return Body(REFERENCE, cube, STAND, mesh=soup(mesh), colour=blue, label=REFERENCE)


def camera_body() -> Body:
    """Return the tracker's camera, which stands aside and looks at the phantom, with the edges of
    its field of view."""
    bar = turned([(0.0, -0.16), (0.03, -0.16), (0.03, 0.16), (0.0, 0.16)], 24)
    mesh = np.concatenate([bar, *_field_of_view()])
    return Body(CAMERA, Capsule(0.03, 0.26), EYE, mesh=soup(mesh), colour=(0.42, 0.46, 0.53))


def _field_of_view() -> list[Mesh]:
    """Return the edges of the pyramid that the camera sees, in the frame of the camera."""
    middle = CENTRE - np.array(EYE)
    side = np.cross(middle, (0.0, 0.0, 1.0))
    side *= FIELD[0] / np.linalg.norm(side)
    up = np.cross(side, middle)
    up *= FIELD[1] / np.linalg.norm(up)
    corners = [middle + side + up, middle - side + up, middle - side - up, middle + side - up]
    around = zip(corners, [*corners[1:], corners[0]], strict=True)
    ends = [*((np.zeros(3), corner) for corner in corners), *around]
    return [_edge(start, end) for start, end in ends]


def _edge(start: Array, end: Array) -> Mesh:
    """Return a thin rod between two points (m)."""
    length = float(np.linalg.norm(end - start))
    along = (end - start) / length
    across = np.cross(along, (0.3, 0.5, 0.8))
    across /= np.linalg.norm(across)
    rotation = np.stack([across, np.cross(along, across), along], axis=1)
    return moved(slab((THIN, THIN, length / 2)), rotation, ((start + end) / 2).tolist())
