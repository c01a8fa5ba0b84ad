"""Miniature: the states and operations of a blueprint's largest SB, for a very small picture."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.picture import Picture

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
MOST_STATES = 1_000
"""An SB with more states has no miniature. A thumbnail could not show them apart."""


@dataclass(frozen=True, eq=False)
class Miniature:
    """A drawing without names.

    ``places`` are the centres of the states (n, 2), in pixels at 100 % zoom, y down. ``lines`` are
    pairs of states (m, 2), each pair once. ``activating`` is the number of the ACTIVATING state, -1
    if there is none.
    """

    places: Floats
    lines: Ints
    activating: int

    def within(self, width: float, height: float) -> Floats:
        """Return the centres, scaled into a box of this size and centred in it."""
        low, high = self.places.min(axis=0), self.places.max(axis=0)
        wide, tall = np.maximum(high - low, 1e-9)
        scale = min(width / wide, height / tall, 1.0)
        middle = (low + high) / 2
        placed: Floats = (self.places - middle) * scale + (width / 2, height / 2)
        return placed


def miniature_of(blueprint: Blueprint) -> Miniature | None:
    """Return the miniature of the SB with the most states.

    None if there are no states, or more than ``MOST_STATES`` in it.
    """
    branch = max(blueprint, key=lambda one: len(one.table), default=None)
    return miniature_of_branch(blueprint, branch.name) if branch is not None else None


def miniature_of_branch(blueprint: Blueprint, name: str) -> Miniature | None:
    """Return the miniature of one SB. None if it has no states, or more than ``MOST_STATES``."""
    branch = blueprint[name]
    if not 0 < len(branch.table) <= MOST_STATES:
        return None
    at, picture = place_states(branch), Picture(blueprint, branch.name)
    places = np.array([at[state] for state in picture.names], dtype=np.float64)
    pairs = np.stack([picture.source, picture.target], axis=1)[picture.target >= 0]
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    activating = picture.index.get(branch.activating, -1)
    return Miniature(places, pairs[pairs[:, 0] != pairs[:, 1]].astype(np.int32), activating)
