"""The ground of the groups of a drawing, on which a tidy drawing leaves only their own states.

A group is a frame around its states. A state that stands in the frame of a group to which it does
not belong looks like a member, so it goes to the nearest free place outside.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import cache

import numpy as np
from numpy.typing import NDArray

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.arrangement import LETTER
from smsl_studio.graph.crossings import Floats
from smsl_studio.stop import heed

Point = tuple[float, float]
FRAME, TITLE, LOOP, ROW = 20.0, 24.0, 24.0, 17.0
"""The room in a frame around its states, the height of its title, of a loop below a state, and of a
name beside it (pixels)."""
APART = 20.0
"""The least room between two states (pixels), beyond that around each."""
STEP, RINGS = (36.0, 30.0), 24
"""The distance of the places that are tried, and how many there are in each direction."""


def without_strangers(
    branch: StateBranch, places: Mapping[str, Point], half: Floats, moving: Collection[str]
) -> dict[str, Point]:
    """Return the places, with those of the states in ``moving`` that are in no group and stand in
    the frame of one changed. A state for which there is no place stays.

    ``half`` has half the width and height of each node and the room around it, in the order of the
    table, (n, 2).
    """
    found = dict(places)
    groups = [group.states for group in branch.drawn.groups.values()]
    if not groups:
        return found
    number = {name: at for at, name in enumerate(branch.table)}
    at = np.array([found[name] for name in branch.table], dtype=np.float64)
    frames = np.array([_frame(branch, own, at, half, number) for own in groups])
    member = {name for own in groups for name in own}
    for name in branch.table:
        heed()
        state = number[name]
        if name in member or name not in moving or not _meets(at[state], half[state], frames).any():
            continue
        place = _free(state, at, half, frames)
        if place is not None:
            at[state] = place
            found[name] = (float(place[0]), float(place[1]))
    return found


def _frame(
    branch: StateBranch,
    own: Collection[str],
    at: Floats,
    half: Floats,
    number: Mapping[str, int],
) -> list[float]:
    """Return left, top, right and bottom of a group with its title, and with the loops of its
    states and their names.
    """
    states = [number[name] for name in own]
    low, high = (at[states] - half[states]).min(axis=0), (at[states] + half[states]).max(axis=0)
    for name in own:
        loops = [operation for operation, to in branch.table[name].items() if to == name]
        if loops:
            x, y = at[number[name]] + half[number[name]]
            wide = LETTER * max(map(len, loops))
            high = np.maximum(high, (x + wide, y + LOOP + ROW * (len(loops) - 1)))
    return [low[0] - FRAME, low[1] - FRAME - TITLE, high[0] + FRAME, high[1] + FRAME]


def _meets(at: Floats, half: Floats, frames: Floats) -> NDArray[np.bool_]:
    """Return whether nodes around points, (..., 2), touch one of the frames, (m, 4)."""
    low, high = (at - half)[..., None, :], (at + half)[..., None, :]
    touched = ((low < frames[:, 2:]) & (high > frames[:, :2])).all(axis=-1)
    return np.asarray(touched.any(axis=-1))


def _free(state: int, at: Floats, half: Floats, frames: Floats) -> Floats | None:
    """Return the nearest place for a state outside all frames and away from all other states."""
    tried = np.round(at[state] + _around())
    reach = np.array(STEP) * RINGS + 2.0 * half[state] + half.max(axis=0) + APART
    others = (np.abs(at - at[state]) < reach).all(axis=1)
    others[state] = False
    apart = half[others] + half[state] + APART / 2
    near = (np.abs(tried[:, None, :] - at[others]) < apart).all(axis=2).any(axis=1)
    free = np.nonzero(~near & ~_meets(tried, half[state], frames))[0]
    return tried[free[0]] if len(free) else None


@cache
def _around() -> Floats:
    """Return steps to places around one, the nearest first. Of equal ones, down and right are
    first.
    """
    reach = np.arange(-RINGS, RINGS + 1, dtype=np.float64)
    steps = np.array([(x * STEP[0], y * STEP[1]) for x in reach for y in reach])
    away = np.hypot(*steps.T).round(6)
    return steps[np.lexsort((-steps[:, 0], -steps[:, 1], away))]
