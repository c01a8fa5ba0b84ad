"""The cheapest route to a goal over joint configurations (clauses 11 and 12), by brute force."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tests.oracle.carriage import carry
from tests.oracle.hazards import passes, planned_in
from tests.oracle.search import Carriage, cheapest
from tests.oracle.standing import Configuration
from tests.oracle.terms import Terms


def route_to(
    terms: Terms,
    here: Configuration,
    goals: Sequence[str],
    movers: Sequence[str],
    only: str = "",
) -> tuple[Carriage, ...] | None:
    """The cheapest steps after which all ``goals`` hold; None where nothing permitted leads there.

    ``movers`` are goals whose trees may be asked for operations; ``only`` is an SB whose edges
    alone may be. Ties are broken by the edges of the SB that the last goal names.
    """
    wanted = [goal.split("/", 1) for goal in goals]
    key = ("goals", tuple(goals), tuple(movers), only, tuple(here.values()))
    if key in terms.memory:
        found = terms.memory[key]
        assert found is None or isinstance(found, tuple)
        return found
    names = [only] if only else moving(terms, movers)
    drawing = terms.drawing

    def steps(at: Configuration) -> Iterator[Carriage]:
        for name in names:
            for operation in drawing.branches[name].states[at[name]]:
                step = carry(terms, f"{name}/{at[name]}/{operation}", at)
                if step is not None and not passes(drawing, step, at):
                    yield step

    routed = frozenset({wanted[-1][0]})
    if planned_in(drawing, here):
        return None
    way = cheapest(here, lambda at: all(at[name] == state for name, state in wanted), steps, routed)
    terms.memory[key] = way
    return way


def moving(terms: Terms, goals: Sequence[str]) -> list[str]:
    """The SBs whose operations a route to these goals may ask for: the trees of their roots."""
    drawing = terms.drawing
    named = {goal.split("/", 1)[0] for goal in goals}
    trees = [tree for root, tree in drawing.trees.items() if root in drawing.roots]
    meant = {name for tree in trees if named & set(tree) for name in tree}
    return [name for name in drawing.branches if name in meant]


def cost_of(way: Sequence[Carriage]) -> float:
    """What a route costs."""
    return round(sum(step.cost for step in way), 6)


def edges_of(way: Sequence[Carriage]) -> list[str]:
    """Every edge of a route, in the order in which they start."""
    return [edge for step in way for edge in step.starts]


def as_own_steps(
    terms: Terms, here: Configuration, name: str, edges: Sequence[str]
) -> list[str] | None:
    """The edges of one SB that bring about exactly ``edges`` by being asked for one after the
    other; None where something else is asked for as well."""
    at, rest, found = dict(here), list(edges), []
    while rest:
        edge = rest[0]
        step = carry(terms, edge, at) if edge.split("/", 1)[0] == name else None
        if step is None or list(step.starts) != rest[: len(step.starts)]:
            return None
        found.append(edge)
        rest = rest[len(step.starts) :]
        at = dict(step.after)
    return found
