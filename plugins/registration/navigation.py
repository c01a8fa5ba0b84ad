"""The navigation: what was planned, measured and registered, and what of it still counts.

``fit`` is the least-squares fit of two sets of points (Arun, Huang and Blostein 1987; Umeyama
1991): the rotation and translation that bring the planned landmarks to the measured ones.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from .phantom import COUNT
from .tracker import Stand

Array = NDArray[np.float64]

GOOD = 0.0005
"""The largest root-mean-square distance (m) of the landmarks after a fit that is accepted."""

NOTHING: Array = np.zeros((0, 3))


@dataclass(frozen=True)
class Fit:
    """A registration: ``rotation`` (3, 3) and ``translation`` (m) from the image to the reference.

    ``error`` is the fiducial registration error (FRE, m): the root-mean-square distance of the
    landmarks. ``stand`` is where the phantom stood.
    """

    rotation: Array
    translation: Array
    error: float
    stand: Stand

    def to_reference(self, points: Array) -> Array:
        """Return points of the image, (n, 3), in the frame of the reference."""
        return points @ self.rotation.T + self.translation


@dataclass(frozen=True)
class Navigation:
    """What is known of one patient. Points of the image are planned, points of the reference are
    measured, (n, 3) in metres.

    ``stand`` is where the phantom stood when a landmark was measured last. ``pose`` is the
    planned pose of the tool in the image: entry and direction. ``saved`` is the registration that
    was saved last, with the landmarks of which it was made.
    """

    plans: int = 0
    planned: Array = field(default_factory=lambda: NOTHING)
    measured: dict[int, Array] = field(default_factory=dict)
    stand: Stand | None = None
    pose: tuple[Array, Array] | None = None
    fit: Fit | None = None
    saved: Navigation | None = None

    @property
    def complete(self) -> bool:
        """Whether every landmark was measured."""
        return len(self.measured) == COUNT

    def with_plan(self, planned: Array) -> Navigation:
        """A new plan; what was measured and registered for another one is void."""
        return replace(self.without_measures(), plans=self.plans + 1, planned=planned)

    def with_measure(self, number: int, point: Array, stand: Stand) -> Navigation:
        """One landmark was measured while the phantom stood at ``stand``."""
        measured = {**self.measured, number: point}
        return replace(self, measured=measured, stand=stand, fit=None)

    def without_touches(self) -> Navigation:
        """Nothing is measured; a registration that was made stays."""
        return replace(self, measured={}, stand=None)

    def without_measures(self) -> Navigation:
        """Nothing is measured, so nothing is registered."""
        return replace(self.without_touches(), fit=None)

    def without_plan(self) -> Navigation:
        """No landmark is planned, so nothing is measured and registered."""
        return replace(self.without_measures(), planned=NOTHING)

    def with_pose(self, entry: Array, direction: Array) -> Navigation:
        """The pose of the tool is planned, in the image."""
        return replace(self, pose=(entry, direction))

    def without_pose(self) -> Navigation:
        """No pose of the tool is planned."""
        return replace(self, pose=None)

    def without_fit(self) -> Navigation:
        """Nothing is registered; what was saved stays."""
        return replace(self, fit=None)

    def registered(self, fit: Fit) -> Navigation:
        """The registration is kept, and saved."""
        now = replace(self, fit=fit, saved=None)
        return replace(now, saved=now)

    def saving(self, saved: Navigation | None) -> Navigation:
        """The same with another registration that was saved; None for none."""
        return replace(self, saved=saved)

    def restored(self) -> Navigation:
        """The saved registration counts again, with its landmarks; the planned pose stays."""
        saved = self.saved
        assert saved is not None
        return replace(saved, pose=self.pose, plans=self.plans, saved=saved)


def fit(planned: Array, measured: Array, stand: Stand) -> Fit:
    """Return the fit of planned landmarks (image) to measured ones (reference), both (n, 3)."""
    middle, other = planned.mean(axis=0), measured.mean(axis=0)
    u, _, vt = np.linalg.svd((planned - middle).T @ (measured - other))
    mirror = np.diag([1.0, 1.0, float(np.sign(np.linalg.det(vt.T @ u.T)))])
    rotation = vt.T @ mirror @ u.T
    translation = other - rotation @ middle
    apart = planned @ rotation.T + translation - measured
    return Fit(rotation, translation, float(np.sqrt((apart**2).sum(axis=1).mean())), stand)
