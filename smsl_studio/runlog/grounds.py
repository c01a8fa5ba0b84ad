"""What the state checks of a run compare, for the header of its log. With it a log can be
checked.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from smsl_studio.blueprint.address import Address, fact_text, note_key
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.edges import Edge, EdgeKind, Edges
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import RunRefused

Json = Any
MOST = 1000
"""The largest number of states, of sensed facts, and of operations in a header, because it is one
line of a log.
"""


@dataclass(frozen=True)
class BoundCode:
    """What a world offers to a run: the ``sensed`` facts, and the name of the ``function`` that is
    bound to an edge (None if none is, or if nothing is known). ``exact`` are the edges whose
    binding names exactly this ``State/Operation``. ``priced`` says whether cost functions are
    bound.
    """

    sensed: Iterable[FactKey] = ()
    function: Callable[[Address], str | None] | None = None
    exact: Collection[Address] = ()
    priced: bool = False


NO_CODE = BoundCode()
MOST_EDGES = 5_000
"""The largest number of operations that are looked at for the header."""


def grounds_of(blueprint: Blueprint, code: BoundCode = NO_CODE) -> Mapping[str, Json]:
    """Return the values that each state needs, the facts that sub-SBs expand, the sensed facts, and
    the functions and costs of operations.

    ``states`` has for each SB and state the value of every fact, digit 0 first, and null if a
    sub-SB expands the digit. An SB that would exceed 1,000 states in total is left out. If more
    than 1,000 facts are sensed, none is named. ``subs`` has for each of these SBs and each expanded
    digit the sub-SB, its ACTIVATING and INITIAL, and the states of the SB in which the digit is on.

    ``functions`` and ``costs`` have for each of these SBs its operations by name, or by
    ``State/Operation`` where those of one name differ. A function is empty for an operation that
    runs none of its own, and left out if none is bound. A cost of 1 is left out; null stands for an
    operation that costs only what its sub-SBs do. An SB that would exceed 1,000 entries in total,
    or 5,000 operations, is left out. ``priced`` says whether cost functions may change costs. All
    three are left out if the functions are not known.
    """
    states: dict[str, Json] = {}
    subs: dict[str, Json] = {}
    left = MOST
    for branch in blueprint:
        if len(branch.table) <= left:
            left -= len(branch.table)
            states[branch.name] = {state: _values(branch, state) for state in branch.table}
            if branch.subs:
                subs[branch.name] = _expanded(blueprint, branch)
    keys = dict.fromkeys(code.sensed)
    named = [fact_text(*key) for key in keys] if len(keys) <= MOST else []
    found: dict[str, Json] = {"states": states, "subs": subs, "sensed": named}
    return found | _operations(blueprint, states, code)


def _operations(blueprint: Blueprint, names: Iterable[str], code: BoundCode) -> dict[str, Json]:
    """Return the functions and costs of the operations of some SBs, and whether the costs may
    change by themselves. Nothing is told without functions, or if the SBs go round in a circle.
    """
    function = code.function
    if function is None:
        return {}
    try:
        edges = Edges(Hierarchy(blueprint), code.exact)
    except RunRefused:
        return {}
    left, edges_left = MOST, MOST_EDGES
    functions: dict[str, Json] = {}
    costs: dict[str, Json] = {}
    for name in names:
        if blueprint[name].edge_count > edges_left:
            continue
        edges_left -= blueprint[name].edge_count
        every = list(_edges(edges, blueprint[name]))
        called = _by_key(
            every, [function(edge.address) if edge.function else "" for edge in every], None
        )
        cost = _by_key(every, [_cost(edge) for edge in every], 1.0)
        if len(called) + len(cost) <= left:
            left -= len(called) + len(cost)
            functions[name], costs[name] = called, cost
    return {"functions": functions, "costs": costs, "priced": code.priced}


def _edges(edges: Edges, branch: StateBranch) -> Iterator[Edge]:
    for state in branch.table:
        yield from edges.out(branch.name, state)


def _cost(edge: Edge) -> float | None:
    """Return the cost of an edge, None if it has none of its own (clause 12)."""
    single = edge.kind in (EdgeKind.RISE, EdgeKind.FALL) and not edge.function
    return None if single else edge.price


def _by_key(edges: Iterable[Edge], values: Iterable[Json], usual: Json) -> dict[str, Json]:
    """Return the values of edges by the name of their operation, or by ``State/Operation`` where
    the values of one name differ. Those with the usual value are left out.
    """
    pairs = list(zip(edges, values, strict=True))
    by_name: dict[str, set[Json]] = {}
    for edge, value in pairs:
        by_name.setdefault(edge.name, set()).add(value)
    found: dict[str, Json] = {}
    for edge, value in pairs:
        if value != usual:
            alike = len(by_name[edge.name]) == 1
            found[note_key(edge.name) if alike else note_key(edge.name, edge.source)] = value
    return found


def _values(branch: StateBranch, state: str) -> list[str | None]:
    subs = branch.subs
    return [None if n in subs else value for n, value in enumerate(branch.facts(state))]


def _expanded(blueprint: Blueprint, branch: StateBranch) -> Mapping[str, Json]:
    """Return the expanded digits of an SB. The keys are texts, because JSON has no others.

    A sub-SB that is not drawn is left out, because no run begins with it.
    """
    drawn = {one.name: one for one in blueprint}
    return {
        str(digit): {
            "sub": sub,
            "activating": drawn[sub].activating,
            "initial": drawn[sub].initial,
            "on": [state for state in branch.table if branch.is_on(state, digit)],
        }
        for digit, sub in branch.subs.items()
        if sub in drawn
    }
