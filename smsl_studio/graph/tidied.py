"""A tidy drawing that looks like the drawing before, so that a person still knows it.

If only some states are tidied, all others stay where they are. If all are tidied, the new drawing
is moved to where the former one was. It is turned upside down if more states then stand near their
former places. If the former drawing is about as good as the new one, it is kept, and the local
search improves it. A long chain is folded into rows.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping
from typing import NamedTuple

import numpy as np

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.around_pins import (
    GOOD,
    IN_ROWS,
    Staying,
    array_of,
    most_of,
    shifted_to,
)
from smsl_studio.graph.arrangement import (
    BEST,
    arranged,
    half_for,
    has_triangle,
    part_of,
    settles,
    ties_for,
)
from smsl_studio.graph.build import graph_of
from smsl_studio.graph.crossings import CROSSING, Floats, Ties, cost_of
from smsl_studio.graph.fact_rows import in_fact_rows
from smsl_studio.graph.folded import folded_chain
from smsl_studio.graph.group_ground import without_strangers
from smsl_studio.graph.layout import free_places, joined, place_anew
from smsl_studio.graph.local_search import settle
from smsl_studio.graph.taken_places import NODE_GAP
from smsl_studio.graph.triangle import in_triangle

Point = tuple[float, float]
Places = Mapping[str, Point]
TURNS = 6
"""Tidying is repeated at most so often, until the drawing rests."""


def tidied(
    branch: StateBranch, former: Places, chosen: Collection[str] = (), kind: str = BEST
) -> dict[str, Point]:
    """Return the place of each state in a tidy drawing (pixels).

    ``former`` has the places of all states now. With ``chosen``, only these states move. A pinned
    state never moves. No state that moves stands in the frame of a group to which it does not
    belong, if there is room elsewhere.
    """
    found = _without_groups(branch, former, chosen, kind)
    if not branch.drawn.groups:
        return found
    own = set(chosen) & branch.table.keys() or branch.table.keys()
    moving, half = own - branch.notes.pinned, half_for(branch)
    clear = without_strangers(branch, found, half, moving)
    for _ in range(TURNS):
        # The next tidying must be no step, so the drawing is tidied until it rests. Around pinned
        # states it may take a second turn although no stranger was led out.
        again = _without_groups(branch, clear, chosen, kind)
        before, clear = clear, without_strangers(branch, again, half, moving)
        if clear == before:
            break
    return clear


def _without_groups(
    branch: StateBranch, former: Places, chosen: Collection[str], kind: str
) -> dict[str, Point]:
    """Return a tidy drawing as if there were no groups."""
    pinned = branch.notes.pinned
    own = [name for name in branch.table if name in chosen]
    if 0 < len(own) < len(branch.table):
        return _some(branch, former, [name for name in own if name not in pinned], kind)
    if not pinned.isdisjoint(branch.table):
        return _around(branch, former, kind)
    fresh = _fresh(branch, kind)
    if not branch.table or fresh.is_triangle:
        return fresh.places
    names = list(branch.table)
    before = np.array([former[name] for name in names], dtype=np.float64).reshape(-1, 2)
    after = np.array([fresh.places[name] for name in names], dtype=np.float64).reshape(-1, 2)
    found = _at_rest(branch, before, after) if fresh.free else _as_before(before, after)
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


class _Fresh(NamedTuple):
    """A new drawing. ``free`` says whether the local search may improve it."""

    places: dict[str, Point]
    free: bool = False
    is_triangle: bool = False


def _fresh(branch: StateBranch, kind: str) -> _Fresh:
    """Return a new drawing."""
    fresh = place_anew(branch, kind)
    if kind != BEST or not fresh:
        return _Fresh(fresh)
    chain = folded_chain(branch, fresh)
    if chain is not None:
        return _Fresh(chain)
    if in_triangle(branch) is not None:
        return _Fresh(fresh, is_triangle=True)
    # Rows of facts and triangles are kept whole, because the search would move states out of them.
    free = not has_triangle(branch) and in_fact_rows(branch, ties_for(branch)) is None
    return _Fresh(fresh, free)


def _around(branch: StateBranch, former: Places, kind: str) -> dict[str, Point]:
    """Return the places of all states around the pinned ones.

    A new drawing depends on the pinned places alone, and where states have settled they stay. So a
    drawing that is tidy already stays as it is.
    """
    names, pinned = list(branch.table), branch.notes.pinned
    stays = [number for number, name in enumerate(names) if name in pinned]
    moves = [number for number, name in enumerate(names) if name not in pinned]
    if not moves:
        return {name: former[name] for name in names}
    before, ties = array_of(names, former), ties_for(branch)
    fresh, many = _fresh(branch, kind), 2 * len(stays) >= len(names)
    around = Staying(
        ties,
        np.array(stays, dtype=np.intp),
        np.array(moves, dtype=np.intp),
        settles(ties) and (fresh.free or many or kind != BEST),
    )
    if not many:
        wanted = shifted_to(around.stays, array_of(names, fresh.places), before)
    else:
        fixed = {names[number]: former[names[number]] for number in stays}
        wanted = array_of(names, joined(branch, fixed, _gap_of(ties)))
    found = around.anew(wanted)
    if fresh.free and around.settles:
        kept = around.kept(before, most_of(ties, found))
        found = found if kept is None else kept
    places = {name: (x, y) for name, (x, y) in zip(names, found.tolist(), strict=True)}
    return {**places, **{names[number]: former[names[number]] for number in stays}}


def _some(branch: StateBranch, former: Places, own: list[str], kind: str) -> dict[str, Point]:
    """Return the places of all states if only some of them move.

    Those are laid out alone, about where they were. Then they go to free places.
    """
    if not own:
        return {name: former[name] for name in branch.table}
    fresh = arranged(part_of(branch, own), kind)
    after = np.array([fresh[name] for name in own], dtype=np.float64)
    before = np.array([former[name] for name in own], dtype=np.float64)
    middle = np.round((before.min(axis=0) + before.max(axis=0)) / 2.0)
    after = after + np.round(middle - (after.min(axis=0) + after.max(axis=0)) / 2.0)
    wanted = {name: (float(x), float(y)) for name, (x, y) in zip(own, after.tolist(), strict=True)}
    others = {name: at for name, at in former.items() if name in branch.table and name not in own}
    ties = ties_for(branch)
    placed = free_places(others, wanted, _gap_of(ties))
    if settles(ties):
        numbers = graph_of(branch).index
        at = np.array([placed[name] for name in branch.table], dtype=np.float64)
        found = settle(ties, at, stays=[numbers[name] for name in others])
        placed |= {name: (float(x), float(y)) for name in own for x, y in [found[numbers[name]]]}
    return {name: placed[name] for name in branch.table}


def _gap_of(ties: Ties) -> Point:
    """Return the least distance of two states that go to free places, across and down."""
    wide, high = np.maximum(NODE_GAP, 2.0 * ties.half.max(axis=0)).tolist()
    return wide, high
