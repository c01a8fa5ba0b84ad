"""The places of the states of a State Branch in a drawing.

There are three layouts: a triangle (Hanoi), an arrangement in columns or by distances, and a grid
for more than ``MOST_SPREAD`` states. The shape of the graph decides. All are pure functions of the
branch, in whole numbers where places are compared, so the same branch is always drawn in the same
way on every machine.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping
from typing import cast

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.arrangement import BEST, arranged
from smsl_studio.graph.build import graph_of
from smsl_studio.graph.shape import distances
from smsl_studio.graph.taken_places import NODE_GAP, TakenPlaces
from smsl_studio.graph.triangle import in_triangle

Point = tuple[float, float]
_KEY = "_places"
QUICK = 24
"""Up to so many states, an arrangement is computed anew at every edit. With more it takes too long.
"""
MOST_SPREAD = 8_000
"""The largest number of states for a layout by distances. More states stand in a grid, those
nearest to INITIAL first.
"""
_WIDE = 1.6
"""The ratio of the width of a grid to its height."""
TENTH = 0.1
"""The unit (pixels) in which a layout is written."""


def place_states(
    branch: StateBranch, former: Mapping[str, Point] | None = None
) -> dict[str, Point]:
    """Return the centre of each state's node in pixels at 100 % zoom, x to the right and y down.

    A place in ``_layout`` counts first, then one in ``former``, then a computed one. If some states
    have a place, each of the others gets one near the states that share an operation with it. But
    if ``former`` is empty and ``_layout`` places fewer than half of the states, the others stand
    where they would stand without ``_layout``. So moving one state by hand does not scatter the
    rest.
    """
    known: Mapping[str, Point] = branch.notes.layout
    places = list(map(known.get, branch.table))
    if None in places:
        known = {**(former or {}), **known}
        places = list(map(known.get, branch.table))
    if None not in places:
        return dict(zip(branch.table, cast("list[Point]", places), strict=True))
    fixed = {name: at for name, at in known.items() if name in branch.table}
    if not fixed:
        return place_anew(branch)
    if not former and 2 * len(fixed) < len(branch.table):
        fixed = {**place_anew(branch), **fixed}
    else:
        fixed = joined(branch, fixed)
    return {name: fixed[name] for name in branch.table}


def place_anew(branch: StateBranch, kind: str = BEST) -> dict[str, Point]:
    """Return the centre of each state's node (pixels), computed without ``_layout``.

    ``kind`` is one of ``arrangement.KINDS``. The branch keeps the result in its own dictionary, as
    it keeps its graph, because the computation takes long.
    """
    kept: dict[str, dict[str, Point]] = branch.__dict__.setdefault(_KEY, {})
    if kind not in kept:
        kept[kind] = _placed(branch, kind)
    return dict(kept[kind])


def _placed(branch: StateBranch, kind: str) -> dict[str, Point]:
    if not branch.table:
        return {}
    triangle = in_triangle(branch) if kind == BEST else None
    if triangle is not None:
        return triangle
    return _grid(branch) if len(branch.table) > MOST_SPREAD else arranged(branch, kind)


def is_placed(branch: StateBranch, places: Mapping[str, Point]) -> bool:
    """Return whether ``place_states`` gives all states of an SB these places."""
    return _are_equal(places, place_states(branch))


def is_slow(branch: StateBranch) -> bool:
    """Return whether it takes too long to find the places of an SB anew at every edit."""
    few = len(branch.table) <= QUICK or 2 * len(branch.notes.layout) >= len(branch.table)
    return not few and len(branch.table) <= MOST_SPREAD and in_triangle(branch) is None


def _are_equal(places: Mapping[str, Point], others: Mapping[str, Point]) -> bool:
    """Return whether no state has different places in two layouts, as they are written."""
    return places == others or not any(
        abs(x - others[name][0]) > TENTH or abs(y - others[name][1]) > TENTH
        for name, (x, y) in places.items()
    )


def is_grid(branch: StateBranch) -> bool:
    """Return whether there are so many states that they stand in a grid, where distances mean
    nothing.
    """
    if len(branch.table) <= MOST_SPREAD or 2 * len(branch.notes.layout) >= len(branch.table):
        return False
    return in_triangle(branch) is None


def _grid(branch: StateBranch) -> dict[str, Point]:
    """Return the places of a grid: column by column from the left, by the steps from INITIAL.
    States that INITIAL is not joined with come last.
    """
    graph = graph_of(branch)
    steps = distances(graph.neighbours, graph.index.get(branch.initial, 0))
    order = sorted(range(len(graph)), key=lambda state: (steps[state] < 0, steps[state]))
    high = math.ceil(math.sqrt(len(graph) * NODE_GAP[0] / NODE_GAP[1] / _WIDE))
    places: list[Point] = [(0.0, 0.0)] * len(graph)
    for at, state in enumerate(order):
        places[state] = at // high * NODE_GAP[0], at % high * NODE_GAP[1]
    return dict(zip(graph.names, places, strict=True))


def joined(
    branch: StateBranch, fixed: Mapping[str, Point], gap: Point = NODE_GAP
) -> dict[str, Point]:
    """Return ``fixed`` and places for the other states, near their neighbours.

    ``gap`` is the least distance of two places, across and down (pixels).
    """
    graph = graph_of(branch)
    places = dict(fixed)
    taken = TakenPlaces(places.values(), gap)
    queue = deque(graph.index[name] for name in fixed)
    queue.extend(i for i in range(len(graph)) if graph.names[i] not in fixed)
    seen: set[str] = set(fixed)
    while queue:
        state = queue.popleft()
        for number in (state, *graph.neighbours[state]):
            name = graph.names[number]
            if name in seen:
                continue
            seen.add(name)
            near = [graph.names[i] for i in graph.neighbours[number]]
            wanted = _beside([places[other] for other in near if other in places], taken.below)
            places[name] = taken.free(wanted)
            queue.appendleft(number)
    return places


def free_places(
    others: Mapping[str, Point], wanted: Mapping[str, Point], gap: Point = NODE_GAP
) -> dict[str, Point]:
    """Return the places of ``others``, and for each state of ``wanted`` the nearest free place.

    ``gap`` is the least distance of two places, across and down (pixels).
    """
    taken = TakenPlaces(others.values(), gap)
    return {**others, **{name: taken.free(at) for name, at in wanted.items()}}


def _beside(near: list[Point], below: Point) -> Point:
    """Return the wished place for a state: the middle of its neighbours, the right of a single one,
    or ``below`` if there is none.
    """
    if len(near) > 1:
        return (sum(x for x, _ in near) / len(near), sum(y for _, y in near) / len(near))
    if near:
        return (near[0][0] + 218.0, near[0][1])
    return below
