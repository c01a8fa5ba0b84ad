"""A tidy drawing around states that stay where they are: pinned ones, or those not selected.

The states that may move are laid out as ever and moved to where the staying ones are. Those that
would cover a staying state go to the nearest free place. Then they settle. All computed places are
whole numbers, and places that stay are rounded for the computation alone, so all sums are exact.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from smsl_studio.graph.crossings import CROSSING, Floats, Ints, Ties, cost_of
from smsl_studio.graph.local_search import GAP, settle
from smsl_studio.graph.taken_places import TakenPlaces

GOOD = 1.1
"""The former drawing is kept if its cost is at most so many times the cost of a new one."""
IN_ROWS = 0.8
"""A former drawing counts as tidy if at least this share of its states stands in rows."""
_ROUNDS = 12
"""So often the states settle at most. Most drawings need two rounds."""


@dataclass(frozen=True, eq=False)
class Staying:
    """The states that stay and those that may move, by number. ``settles`` says whether the local
    search may improve a new drawing."""

    ties: Ties
    stays: Ints
    moves: Ints
    settles: bool

    def anew(self, wanted: Floats) -> Floats:
        """Return places near the wanted ones, (n, 2), at which nothing covers a staying state."""
        gap = 2.0 * self.ties.half.max(axis=0) + GAP
        taken = self._taken(wanted, gap)
        clear = [taken.is_free(_point(wanted, state)) for state in self.moves.tolist()]
        for state in self.moves[clear].tolist():
            taken.take(_point(wanted, state))
        at, aside = wanted.copy(), self.moves[[not one for one in clear]].tolist()
        for state in aside:
            at[state] = np.round(taken.free(_point(wanted, state)))
        if not self.settles:
            return at
        at = self._apart(at)
        stays = [state for state in range(len(at)) if state not in set(aside)]
        return self._settled(settle(self.ties, at, stays=stays))

    def kept(self, former: Floats, most: float) -> Floats | None:
        """Return the former drawing after the states have settled. None if it costs more than
        ``most``, or if it was not tidy.
        """
        high, own = float(self.ties.step[1]), np.round(former)
        rests = np.mod(own[self.moves, 1], high).tolist()
        ((rest, count),) = Counter(rests).most_common(1)
        if count < IN_ROWS * len(self.moves):
            return None
        own[self.moves, 1] = np.round((own[self.moves, 1] - rest) / high) * high + rest
        found = self._settled(self._apart(own))
        return found if cost_of(self.ties, found) <= most else None

    def _settled(self, at: Floats) -> Floats:
        """Return places at which no state can stand better in its column."""
        stays = self.stays.tolist()
        for _ in range(_ROUNDS):
            found = settle(self.ties, at, stays=stays, across=False)
            if np.array_equal(found, at):
                break
            at = found
        return at

    def _apart(self, at: Floats) -> Floats:
        """Return places at which no state that may move covers another one."""
        taken, at = self._taken(at, 2.0 * self.ties.half.max(axis=0)), at.copy()
        for state in self.moves.tolist():
            at[state] = np.round(taken.free(_point(at, state)))
        return at

    def _taken(self, at: Floats, gap: Floats) -> TakenPlaces:
        points = [_point(at, state) for state in self.stays.tolist()]
        (wide, high), (across, down) = gap.tolist(), self.ties.step.tolist()
        return TakenPlaces(points, (wide, high), (across, down))


def most_of(ties: Ties, at: Floats) -> float:
    """Return what a former drawing may cost at most to be kept instead of this one."""
    cost = cost_of(ties, at)
    return max(cost * GOOD, cost + CROSSING)


def shifted_to(stays: Ints, fresh: Floats, at: Floats) -> Floats:
    """Return a new drawing that is moved to where the staying states are, (n, 2).

    It is turned upside down if it then fits these states better. Their own places are those of
    ``at``.
    """
    found: list[tuple[float, Floats]] = []
    for sign in (1.0, -1.0):
        turned = fresh * (1.0, sign)
        # The median is taken, so that a few states far away do not count.
        gap = np.sort(at[stays] - turned[stays], axis=0)[len(stays) // 2]
        turned = np.round(turned + np.round(gap))
        found.append((float(np.abs(at - turned)[stays].sum()), turned))
    best = found[0][1] if found[0][0] <= found[1][0] else found[1][1]
    best[stays] = at[stays]
    return best


def array_of(names: list[str], places: Mapping[str, tuple[float, float]]) -> Floats:
    """Return the places of states as rows, (n, 2), in whole pixels."""
    at = np.array([places[name] for name in names], dtype=np.float64).reshape(-1, 2)
    return np.asarray(np.round(at))


def _point(at: Floats, state: int) -> tuple[float, float]:
    return float(at[state, 0]), float(at[state, 1])
