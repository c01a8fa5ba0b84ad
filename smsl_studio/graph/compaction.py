"""Compaction: what stands on one side of a gap in a layout moves nearer, if no reader loses by it.

States settle one by one, and each stays away from where the others stood. So wide gaps are left,
which only many states together can close.
"""

from __future__ import annotations

import numpy as np

from smsl_studio.graph.crossings import Floats, Ties, cost_of
from smsl_studio.graph.local_search import GAP
from smsl_studio.stop import heed


def compacted(ties: Ties, at: Floats, across: bool = True) -> Floats:
    """Return the places with narrower gaps. A layout is never dearer afterwards (see
    ``crossings``). Without ``across`` every state keeps its x.
    """
    best, cost = at, cost_of(ties, at)
    for axis in (0, 1) if across else (1,):
        step = float(ties.step[axis])
        for level in np.unique(at[:, axis])[:0:-1].tolist():
            beyond = best[:, axis] >= level
            while True:
                heed()
                trial = best.copy()
                trial[beyond, axis] -= step
                if not beyond.any() or not _has_room(ties, trial, beyond):
                    break
                found = cost_of(ties, trial)
                if found > cost:
                    break
                best, cost = trial, found
    return best


def _has_room(ties: Ties, at: Floats, beyond: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> bool:
    """Return whether no node that moved is too near to one that did not."""
    one, other = at[beyond], at[~beyond]
    room = ties.half[beyond][:, None] + ties.half[~beyond] + GAP
    return not bool((np.abs(one[:, None] - other) < room).all(axis=2).any())
