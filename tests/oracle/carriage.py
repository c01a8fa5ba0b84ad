"""The effect of carrying out an edge: which SBs move in which order, what is committed together,
and the cost.

Clauses 2, 5, 6, 10 and 12 for one step. Sub-routes are found by brute force.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from tests.oracle.drawing import Drawing
from tests.oracle.search import Carriage, cheapest
from tests.oracle.standing import Configuration, split_digits
from tests.oracle.terms import Chain, Terms, taken_along, with_base


def carry(
    terms: Terms, edge: str, here: Configuration, chain: Chain = (), asked: bool = False
) -> Carriage | None:
    """What carrying ``edge`` out from ``here`` does; None where it is not available.

    ``chain`` are the edges of bases on whose behalf a sub-SB moves: their SBs cannot be taken
    along any more.
    """
    key = ("carry", edge, tuple(here.values()), chain, asked)
    if key not in terms.memory:
        terms.memory[key] = _carried(terms, edge, here, chain, asked)
    found = terms.memory[key]
    assert found is None or isinstance(found, Carriage)
    return found


def _carried(
    terms: Terms, edge: str, here: Configuration, chain: Chain, asked: bool
) -> Carriage | None:
    drawing = terms.drawing
    name = edge.split("/", 1)[0]
    source, target = drawing.edges[edge]
    if here[name] != source or not terms.usable(edge, here, asked):
        return None
    along: tuple[str, ...] = ()
    if drawing.is_crossing(edge):
        taken = taken_along(terms, edge, here, chain)
        if taken is None:
            return None
        along = taken
    kind = drawing.kind(edge)
    after = {**here, name: target}
    if kind == "load":
        loaded = _loaded(terms, edge, here, (*chain, *along, edge))
        if loaded is None:
            return None
        after |= loaded[0]
        along += loaded[1]
    last = [one for one in (edge, *along) if terms.own_function(one)]
    if kind in ("pure", "load"):
        moves = _Moves([edge, *along], list(along), [], [], set(), [], after, 0.0)
    else:
        found = _moved(terms, edge, here, bool(last), (*chain, *along, edge))
        if found is None:
            return None
        moves = found
        moves.starts[1:1] = along
        moves.after[name] = target
        moves.along.extend(along)
    for one in along:
        base = one.split("/", 1)[0]
        moves.after[base] = drawing.edges[one][1]
    if len({one.split("/", 1)[0] for one in along}) != len(along):
        return None
    if not chain and split_digits(drawing, moves.after):
        return None
    cost = moves.cost + (terms.cost(edge) if kind not in ("rise", "fall") or edge in last else 0.0)
    cost += sum(terms.cost(one) for one in along if one in last)
    return Carriage(
        edge,
        tuple(moves.starts),
        tuple(moves.along),
        (*moves.begins, *last),
        tuple(moves.commits),
        frozenset({edge, *along, *moves.group}),
        tuple(moves.tail),
        moves.after,
        cost,
    )


@dataclass
class _Moves:
    starts: list[str]
    along: list[str]
    begins: list[str]
    commits: list[frozenset[str]]
    group: set[str]
    tail: list[frozenset[str]]
    after: Configuration
    cost: float


def _moved(terms: Terms, edge: str, here: Configuration, own: bool, chain: Chain) -> _Moves | None:
    """The subs of an edge moved, falls before rises, in order of digit (clauses 5 and 6)."""
    drawing = terms.drawing
    name = edge.split("/", 1)[0]
    branch = drawing.branches[name]
    falls, rises = drawing.changed_subs(edge)
    moves = _Moves([edge], [], [], [], set(), [], dict(here), 0.0)
    steps: list[Carriage] = []
    for digit in (*falls, *rises):
        sub = branch.subs[digit]
        there = drawing.branches[sub]
        to = there.initial if digit in falls else there.activating
        route = sub_route(terms, sub, to, moves.after, chain)
        if route is None:
            return None
        steps += route
        moves.after = dict(route[-1].after) if route else moves.after
    subs = {branch.subs[digit] for digit in (*falls, *rises)}
    crossing = [_crosses(drawing, step, subs) for step in steps]
    last = max((number for number, crosses in enumerate(crossing) if crosses), default=-1)
    for number, step in enumerate(steps):
        moves.starts += step.starts
        moves.along += step.along
        moves.begins += step.begins
        moves.cost += step.cost
        if number > last and not own:
            moves.tail += step.all_commits
            continue
        for group in step.commits:
            _commit(moves, drawing, group, crosses=False)
        _commit(moves, drawing, step.group, crosses=crossing[number])
        if number == last and not own:
            moves.tail += step.tail
            continue
        for group in step.tail:
            _commit(moves, drawing, group, crosses=False)
    return moves


def _commit(moves: _Moves, drawing: Drawing, group: frozenset[str], *, crosses: bool) -> None:
    """A group commits alone, unless it crosses or an SB of it is pending already."""
    if crosses or _branches(drawing, group) & _branches(drawing, moves.group):
        moves.group |= group
    else:
        moves.commits.append(group)


def _crosses(drawing: Drawing, step: Carriage, subs: set[str]) -> bool:
    """Whether a step has a crossing of one of these SBs in it: that stays pending with all that
    must be committed with it."""
    return any(drawing.is_crossing(edge) and edge.split("/", 1)[0] in subs for edge in step.group)


def _branches(drawing: Drawing, edges: Iterable[str]) -> set[str]:
    """The SBs that edges move, also by ``load``."""
    found: Configuration = {}
    for edge in edges:
        found[edge.split("/", 1)[0]] = ""
        if drawing.kind(edge) == "load":
            put_below(drawing, edge, found)
    return set(found)


def _loaded(
    terms: Terms, edge: str, here: Configuration, chain: Chain
) -> tuple[Configuration, tuple[str, ...]] | None:
    """Where a ``load`` edge puts its changed subs and all below them, and which edges of other
    bases go along with that; None where a base has none."""
    drawing = terms.drawing
    put: Configuration = {}
    put_below(drawing, edge, put)
    along: list[str] = []
    for sub, state in put.items():
        active = drawing.branches[sub].activating
        if (here[sub] == active) == (state == active):
            continue
        for base, digit in drawing.bases[sub]:
            if base in put or base == edge.split("/", 1)[0]:
                continue
            taken = with_base(terms, base, digit, state == active, here, chain)
            if taken is None:
                return None
            along += [one for one in taken if one not in along]
    return put, tuple(along)


def put_below(drawing: Drawing, edge: str, after: Configuration) -> None:
    """A ``load`` edge leaves its changed subs, and all below them, where a start would."""
    branch = drawing.branches[edge.split("/", 1)[0]]
    falls, rises = drawing.changed_subs(edge)
    for digit in (*falls, *rises):
        _stand(drawing, branch.subs[digit], digit in rises, after)


def _stand(drawing: Drawing, name: str, on: bool, after: Configuration) -> None:
    branch = drawing.branches[name]
    after[name] = branch.activating if on else branch.initial
    for digit, sub in branch.subs.items():
        _stand(drawing, sub, branch.is_on(after[name], digit), after)


def sub_route(
    terms: Terms, name: str, to: str, here: Configuration, chain: Chain
) -> tuple[Carriage, ...] | None:
    """Clause 12: the cheapest way of a sub-SB to a state by its own edges, crossing once."""
    key = ("route", name, to, tuple(here.values()), chain)
    if key not in terms.memory:
        terms.memory[key] = _sub_route(terms, name, to, here, chain)
    found = terms.memory[key]
    assert found is None or isinstance(found, tuple)
    return found


def _sub_route(
    terms: Terms, name: str, to: str, here: Configuration, chain: Chain
) -> tuple[Carriage, ...] | None:
    active = terms.drawing.branches[name].activating

    def steps(at: Configuration) -> Iterator[Carriage]:
        for operation in terms.drawing.branches[name].states[at[name]]:
            edge = f"{name}/{at[name]}/{operation}"
            back = to != active and terms.drawing.edges[edge][1] == active
            onward = to == active and at[name] == active
            if not back and not onward:
                step = carry(terms, edge, at, chain)
                if step is not None:
                    yield step

    return cheapest(here, lambda at: at[name] == to, steps, frozenset({name}))
