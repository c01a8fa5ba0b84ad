"""The arrangement of an SB: several layouts are made, and the one that is easiest to read is taken.

One layout has layers by the steps from INITIAL, one has layers by the longest chains, and one goes
by distances. In each of them a local search moves the states, so that fewer lines cross. Parts of
the graph that no operation joins stand one below another. The part of INITIAL is on top.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice

import numpy as np

from smsl_studio.blueprint.elements import Header
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.build import BranchGraph, graph_of
from smsl_studio.graph.compaction import compacted
from smsl_studio.graph.crossings import CROSSING, Floats, Ties, cost_of, is_clear, ties_of
from smsl_studio.graph.fact_rows import in_fact_rows
from smsl_studio.graph.layered import COLUMN, in_layers, lattice, words_of
from smsl_studio.graph.layers import by_chains, by_steps
from smsl_studio.graph.local_search import settle
from smsl_studio.graph.shape import islands
from smsl_studio.graph.spread import CELL_X, CELL_Y, by_distance
from smsl_studio.graph.triangle import in_triangle

Point = tuple[float, float]
BEST, LAYERS, DISTANCE = "best", "layers", "distance"
KINDS = (BEST, LAYERS, DISTANCE)
MOST_STATES, MOST_PAIRS = 150, 180
"""The limits of the local search. It would take seconds with more states, or with more pairs of
states that operations join.
"""
WORTH = 1.15
"""The cost of a layout by distances is multiplied by this before it is compared with columns. At
least the cost of one crossing is added.
"""
FEW_PAIRS = 100
"""Up to so many pairs of states, all layouts settle, else only the one by distances."""
MANY_STARTS = 60
"""Up to so many pairs of states, states leave the columns of each layered layout, else only those
of the best one.
"""
LETTER, NARROWEST, WIDEST, HIGH = 7.0, 108.0, 320.0, 54.0
"""The width of a letter of a name, and the sizes of nodes (pixels)."""
CHIP, AROUND = 22.0, 8.0
PART = 172.0
"""Pixels between two parts of a drawing."""
_ALONE = 6
"""The number of single states in a row."""


def arranged(branch: StateBranch, kind: str = BEST) -> dict[str, Point]:
    """Return the centre of each state's node in whole pixels. The part of INITIAL is on top."""
    if kind == BEST and len(branch.table) <= MOST_STATES:
        rows = in_fact_rows(branch, ties_for(branch))
        if rows is not None:
            return rows
    places: dict[str, Point] = {}
    lowest = -PART
    joined, alone = _parts(branch)
    for own in joined:
        triangle = in_triangle(own) if kind == BEST else None
        at = _best_of(own, kind) if triangle is None else np.array(list(triangle.values()))
        at = at - at.min(axis=0) + (0.0, lowest + PART)
        lowest = float(at[:, 1].max())
        places |= zip(own.table, map(tuple, at.tolist()), strict=True)
    for number, name in enumerate(alone):
        row, column = divmod(number, _ALONE)
        places[name] = (column * float(COLUMN), lowest + (row + 1) * PART)
    return {name: places[name] for name in branch.table}


def has_triangle(branch: StateBranch) -> bool:
    """Return whether a part that no operation joins with the others stands in a triangle."""
    return any(in_triangle(own) is not None for own in _parts(branch)[0])


def _parts(branch: StateBranch) -> tuple[list[StateBranch], list[str]]:
    """Return the parts of an SB that no operation joins, each as an SB, the part of INITIAL first,
    and the other states that stand alone.
    """
    parts = sorted(islands(branch), key=lambda part: (branch.initial not in part, -len(part)))
    if len(parts) == 1:
        return [branch], []
    joined = [part for number, part in enumerate(parts) if len(part) > 1 or not number]
    alone = [name for part in parts[1:] if len(part) == 1 for name in part]
    return [part_of(branch, part) for part in joined], alone


def names_of(branch: StateBranch) -> list[object]:
    """Return all in the names of states and operations that the places of up to ``MOST_STATES``
    states depend on. The other things are the graph, INITIAL and ACTIVATING.
    """
    # The only fact of a state with an opaque name is that name, which makes no rows.
    found: list[object] = [facts for facts in map(branch.facts, branch.table) if len(facts) > 1]
    for own in _parts(branch)[0]:
        found += (words_of(own), *(len(own.facts(name)) for name in own.table))
    return found


def part_of(branch: StateBranch, states: Sequence[str]) -> StateBranch:
    """Return an SB with some states of another one. It keeps INITIAL if that is among them. If not,
    the first state is its INITIAL.
    """
    first = branch.initial if branch.initial in states else states[0]
    last = branch.activating if branch.activating in states else states[-1]
    header = Header(initial=first, activating=last)
    return StateBranch(branch.name, {name: branch.table[name] for name in states}, header)


def _best_of(branch: StateBranch, kind: str) -> Floats:
    """Return the centres of the nodes of an SB in which operations join all states, (n, 2)."""
    graph = graph_of(branch)
    ties = ties_for(branch)
    most = settles(ties)
    few = most and len(ties.pairs) <= FEW_PAIRS
    found: list[tuple[float, int, Floats]] = []

    def take(begin: Floats, across: bool) -> None:
        """Improve a layout by the local search, and keep the result with its cost."""
        here = few or (most and (across or kind == LAYERS))
        at = compacted(ties, settle(ties, begin, across=across), across) if here else begin
        cost = cost_of(ties, at) if most else -float(len(found))
        if across and most:
            # Columns are easier to follow, so they are left only for a good reason.
            cost = max(cost * WORTH, cost + CROSSING)
        found.append((cost, len(found), at))

    for begins, across in _starts(branch, graph, ties, kind):
        for begin in begins:
            take(begin, across)
        clear = [one for one in found if not across and most and is_clear(ties, one[2])]
        if clear:
            return min(clear, key=lambda one: one[:2])[2]
    if few and kind == BEST and len(graph) > 2:
        columns = sorted(found[:-1], key=lambda one: one[:2])
        for _, _, at in columns[: 1 if len(ties.pairs) > MANY_STARTS else None]:
            take(at, True)
    return min(found, key=lambda one: one[:2])[2]


def _starts(
    branch: StateBranch, graph: BranchGraph, ties: Ties, kind: str
) -> Iterator[tuple[list[Floats], bool]]:
    """Yield the layouts before states settle, and whether states may leave their columns. Those in
    a list differ only in how far columns are apart.
    """
    start = graph.index.get(branch.initial, 0)
    if kind == LAYERS or len(graph) <= (MOST_STATES if kind == BEST else 2):
        steps = by_steps(graph, start)
        chains = by_chains(graph, start) if len(graph) <= MOST_STATES else steps
        for layer in (chains,) if chains == steps else (chains, steps):
            # States that do not settle keep the first places.
            yield list(islice(in_layers(ties, layer), None if settles(ties) else 1)), False
    if kind != LAYERS and len(graph) > 2:
        near = by_distance(branch)
        at = np.array([near[name] for name in graph.names]).reshape(-1, 2)
        # States that do not settle stay in their narrower cells.
        near_lattice = np.round(at / (CELL_X, CELL_Y)) * ties.step * 2.0
        yield [near_lattice if settles(ties) else at], True


def settles(ties: Ties) -> bool:
    """Return whether an SB is small enough for the local search."""
    return len(ties.half) <= MOST_STATES and len(ties.pairs) <= MOST_PAIRS


def ties_for(branch: StateBranch) -> Ties:
    """Return the pairs of states that operations join, with an estimate of the size of a node."""
    graph = graph_of(branch)
    far = by_steps(graph, graph.index.get(branch.initial, 0))
    half = half_for(branch)
    return ties_of(graph, far, half, lattice(graph, half))


def half_for(branch: StateBranch) -> Floats:
    """Return half the estimated width and height of each node with the room around it, (n, 2)."""
    chips = max((len(branch.facts(name)) for name in branch.table), default=0)
    wide = max(words_of(branch)[0] * LETTER + 24.0, chips * CHIP + 20.0, NARROWEST)
    size = min(wide, WIDEST) / 2.0 + AROUND, HIGH / 2.0 + AROUND
    return np.full((len(branch.table), 2), size)
