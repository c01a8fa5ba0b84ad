"""A tidy drawing that looks like the drawing before, so that a person still knows it.

If only some states are tidied, all others stay where they are. If all are tidied, the new drawing
is moved to where the former one was. It is turned upside down if more states then stand near their
former places. If the former drawing is about as good as the new one, it is kept, and the local
search improves it. A long chain is folded into rows.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping

import numpy as np

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.arrangement import BEST, arranged, has_triangle, part_of, settles, ties_for
from smsl_studio.graph.build import graph_of
from smsl_studio.graph.crossings import CROSSING, Floats, cost_of
from smsl_studio.graph.fact_rows import in_fact_rows
from smsl_studio.graph.folded import folded_chain
from smsl_studio.graph.layout import free_places, place_anew
from smsl_studio.graph.local_search import settle
from smsl_studio.graph.triangle import in_triangle

Point = tuple[float, float]
Places = Mapping[str, Point]
GOOD = 1.1
"""The former drawing is kept if its cost is at most so many times the cost of a new one."""
TURNS = 6
"""Tidying is repeated at most so often, until the drawing rests."""
IN_ROWS = 0.8
"""A former drawing counts as tidy if at least this share of its states stands in rows."""


def tidied(
    branch: StateBranch, former: Places, chosen: Collection[str] = (), kind: str = BEST
) -> dict[str, Point]:
    """Return the place of each state in a tidy drawing (pixels).

    ``former`` has the places of all states now. With ``chosen``, only these states move.
    """
    own = [name for name in branch.table if name in chosen]
    if 0 < len(own) < len(branch.table):
        return _some(branch, former, own, kind)
    fresh = place_anew(branch, kind)
    chain = folded_chain(branch, fresh) if kind == BEST else None
    fresh = chain or fresh
    names = list(branch.table)
    before = np.array([former[name] for name in names], dtype=np.float64).reshape(-1, 2)
    after = np.array([fresh[name] for name in names], dtype=np.float64).reshape(-1, 2)
    if not len(after) or (kind == BEST and in_triangle(branch) is not None):
        return fresh
    # Rows of facts and triangles are kept whole, because the search would move states out of them.
    whole = chain is not None or has_triangle(branch)
    free = kind == BEST and not whole and in_fact_rows(branch, ties_for(branch)) is None
    found = _at_rest(branch, before, after) if free else _as_before(before, after)
    return {name: (float(x), float(y)) for name, (x, y) in zip(names, found.tolist(), strict=True)}


def _at_rest(branch: StateBranch, before: Floats, after: Floats) -> Floats:
    """Return the former drawing, improved, or the new one. Tidying it again changes nothing.

    One turn can leave something for the next one: a new drawing may have parts between the rows of
    the others, and these are moved into the rows only when the drawing is kept.
    """
    for _ in range(TURNS):
        found = _kept(branch, before, after)
        if found is None:
            found = _as_before(before, after)
        if np.array_equal(found, before):
            break
        before = found
    return before


def _as_before(before: Floats, after: Floats) -> Floats:
    """Return a drawing that is shifted to the former one. It is turned upside down if its states
    are nearer to their former places then.
    """
    found: list[tuple[float, Floats]] = []
    for sign in (1.0, -1.0):
        turned = after * (1.0, sign)
        # The median is taken, so that a few states far away do not count.
        gap = np.sort(before - turned, axis=0)[len(after) // 2]
        turned = turned + np.round(gap)
        found.append((float(np.abs(before - turned).sum()), turned))
    return found[0][1] if found[0][0] <= found[1][0] else found[1][1]


def _kept(branch: StateBranch, before: Floats, after: Floats) -> Floats | None:
    """Return the former drawing after the local search. It is None if a new drawing is clearly
    better, or if the former one was not tidy.
    """
    ties = ties_for(branch)
    high = float(ties.step[1])
    ((rest, count),) = Counter(np.mod(np.round(before[:, 1]), high).tolist()).most_common(1)
    if not settles(ties) or count < IN_ROWS * len(before):
        return None
    rows = np.round((before[:, 1] - rest) / high) * high + rest
    at = np.stack([np.round(before[:, 0]), rows], axis=1)
    most = max(cost_of(ties, after) * GOOD, cost_of(ties, after) + CROSSING)
    for across in (False, True):
        found = settle(ties, at, across=across)
        if cost_of(ties, found) <= most:
            return found
    return None


def _some(branch: StateBranch, former: Places, own: list[str], kind: str) -> dict[str, Point]:
    """Return the places of all states if only some of them move.

    Those are laid out alone, about where they were. Then they go to free places.
    """
    fresh = arranged(part_of(branch, own), kind)
    after = np.array([fresh[name] for name in own], dtype=np.float64)
    before = np.array([former[name] for name in own], dtype=np.float64)
    middle = np.round((before.min(axis=0) + before.max(axis=0)) / 2.0)
    after = after + np.round(middle - (after.min(axis=0) + after.max(axis=0)) / 2.0)
    wanted = {name: (float(x), float(y)) for name, (x, y) in zip(own, after.tolist(), strict=True)}
    others = {name: at for name, at in former.items() if name in branch.table and name not in own}
    placed = free_places(others, wanted)
    ties = ties_for(branch)
    if settles(ties):
        numbers = graph_of(branch).index
        at = np.array([placed[name] for name in branch.table], dtype=np.float64)
        found = settle(ties, at, stays=[numbers[name] for name in others])
        placed |= {name: (float(x), float(y)) for name in own for x, y in [found[numbers[name]]]}
    return {name: placed[name] for name in branch.table}
