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
"""The largest number of states, of sensed facts, and of operations in a header. A header is one
line of a log and must stay short."""


@dataclass(frozen=True)
class BoundCode:
    """What a world offers for a run.

    ``sensed`` has the facts that sensors read. ``function`` takes an edge and returns the name of
    its bound function; None if there is none, or if it is not known. ``exact`` has the edges whose
    binding names exactly this ``State/Operation``. ``priced`` says whether cost functions are
    bound.
    """

    sensed: Iterable[FactKey] = ()
    function: Callable[[Address], str | None] | None = None
    exact: Collection[Address] = ()
    priced: bool = False


NO_CODE = BoundCode()
MOST_EDGES = 5_000
"""The largest number of operations that are read for the header."""


def grounds_of(blueprint: Blueprint, code: BoundCode = NO_CODE) -> Mapping[str, Json]:
    """Return everything in a blueprint that is needed to check the events of a log.

    ``states`` has for each SB and state the value of every fact, digit 0 first. It is null if a
    sub-SB expands the digit. SBs that would make more than 1,000 states in total are left out. The
    sensed facts are left out if there are more than 1,000.

    ``subs`` has for each of these SBs and each expanded digit: the sub-SB, its ACTIVATING and
    INITIAL, and the states of the SB in which the digit is on.

    ``functions`` and ``costs`` have for each of these SBs its operations by name. If operations of
    one name differ, the key is ``State/Operation``. The function is empty for an operation that
    runs none of its own. It is left out if none is bound. A cost of 1 is left out. A null cost
    means that the operation only costs what its sub-SBs cost. SBs that would make more than 1,000
    entries or 5,000 operations in total are left out. ``priced`` says whether cost functions may
    change costs. All three are left out if the functions are not known.
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
    """Return the functions and costs of the operations of some SBs, and whether costs may change.

    The result is empty if the functions are not known, or if the SBs refer to each other in a
    circle.
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
    """Return the cost of an edge, or None if it has no cost of its own (clause 12)."""
    single = edge.kind in (EdgeKind.RISE, EdgeKind.FALL) and not edge.function
    return None if single else edge.price


def _by_key(edges: Iterable[Edge], values: Iterable[Json], usual: Json) -> dict[str, Json]:
    """Return the values of edges by the names of their operations.

    If edges of one name have different values, the key is ``State/Operation``. The ``usual`` value
    is left out.
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
