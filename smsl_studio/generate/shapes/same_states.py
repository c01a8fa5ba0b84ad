"""Finds states of an SB that behave in the same way, and merges them into one state.

Two states behave in the same way if they have the same operations, with the same conditions, and
these lead to states that again behave in the same way. There is one exception: a sub-SB may choose
between routes of the same cost, and there the names of states decide. So the result of a merge is
compared with the blueprint before.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.edges import Edge, Edges
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import PlanningError
from smsl_studio.generate.shapes.chosen import CutRefused
from smsl_studio.generate.shapes.claims import named_places
from smsl_studio.inspection.equivalence.equivalence import equivalence
from smsl_studio.inspection.equivalence.refinement import Row, numbered, refined
from smsl_studio.inspection.explorer.part import restricted, touching
from smsl_studio.stop import heed

MOST_LOOKED = 5_000_000
"""The largest number of operations that are compared, over all rounds."""


@dataclass(frozen=True)
class SameStates:
    """Some states of an SB that behave in the same way, in file order.

    ``facts`` names the facts in which they differ; it is empty if they have the same facts.
    ``why_not`` says in a sentence why they cannot be merged; it is empty if they can.
    """

    branch: str
    states: tuple[str, ...]
    facts: tuple[str, ...] = ()
    why_not: str = ""


def same_states(blueprint: Blueprint) -> tuple[SameStates, ...]:
    """Return groups of states that behave in the same way. Groups that can be merged come first.

    Otherwise the order is that of the file. A state is in at most one group. ACTIVATING is in no
    group. A failure state is in no group with a state that is no failure. PlanningError if the
    search takes too long, RunRefused if the SBs refer to each other in a circle.
    """
    edges = Edges(Hierarchy(blueprint))
    named = {(one.branch, one.state): one.claim for one in named_places(blueprint) if one.state}
    found = [one for branch in blueprint for one in _of_branch(branch, edges, named)]
    return tuple(sorted(found, key=lambda one: bool(one.why_not)))


def merged(blueprint: Blueprint, same: SameStates, limit: int) -> Blueprint:
    """Return the blueprint after some states were merged into one.

    The state that remains is INITIAL if it is among them, else the first one. Operations that led
    to the other states lead to it. CutRefused if the states cannot be merged, or if the result
    would behave differently. PlanningError if more than ``limit`` configurations can be reached.
    """
    if same.why_not:
        raise CutRefused(same.why_not, advice="Merge them by hand if they mean the same.")
    branch = blueprint[same.branch]
    keep = branch.initial if branch.initial in same.states else same.states[0]
    gone = [name for name in same.states if name != keep]
    into = [
        edge.address for edge in branch.edges() if edge.target in gone and edge.source not in gone
    ]
    after = editing.retarget(blueprint, into, keep) if into else blueprint
    after = editing.delete(after, [Address(branch.name, name) for name in gone])
    before = touching(blueprint, branch.name)
    part = restricted(after, list(before.branches))
    told = equivalence(before, part, limit, names=("the file", "the result"))
    if told.equal is None:
        raise PlanningError(f"nothing was merged: {told.reason}")
    if not told.equal:
        words = f"the result would behave otherwise: {told.reason}"
        raise CutRefused(words, None, "Look at the run.", told.path)
    return after


def _of_branch(
    branch: StateBranch, edges: Edges, named: dict[tuple[str, str], str]
) -> Iterator[SameStates]:
    """Yield the groups of one SB.

    First come groups of states with the same facts. Then come groups in which only the facts of
    sub-SBs must be the same.
    """
    names = list(branch.table)
    number = {name: at for at, name in enumerate(names)}
    fails = failing_states(branch)
    rows = []
    for name in names:
        heed()
        out = edges.out(branch.name, name)
        rows.append([(_what(edge), number[edge.target]) for edge in out])

    def apart(name: str) -> Hashable:
        """Return what must be equal in two states before their operations are compared."""
        facts = branch.facts(name)
        subs = tuple(facts[digit : digit + 1] for digit in sorted(branch.subs))
        return name == branch.activating, fails.get(name), len(facts), subs

    exact = _classes([(apart(name), branch.facts(name)) for name in names], rows)
    taken: set[str] = set()
    for states in _groups(names, exact):
        taken.update(states)
        why = _why_not(branch, states, named)
        yield SameStates(branch.name, states, why_not=why)
    for states in _groups(names, _classes([apart(name) for name in names], rows)):
        facts = _differing(branch, states)
        if facts and not taken.issuperset(states):
            why = f"they mean different things: {' and '.join(facts)} differs in them"
            yield SameStates(branch.name, states, facts, why)


def _what(edge: Edge) -> Hashable:
    """Return everything that must be equal in two operations with the same effect."""
    return edge.name, edge.requires, edge.load, edge.kind, edge.falls, edge.rises


def _classes(first: Sequence[Hashable], rows: Sequence[Row]) -> list[int]:
    """Return a class number for each state. States of one class behave in the same way.

    Classes are divided until nothing changes (partition refinement).
    """
    classes, looked = numbered(first), 0
    size = 1 + len(rows) + sum(map(len, rows))
    while True:
        looked += size
        if looked > MOST_LOOKED:
            raise PlanningError(f"more than {MOST_LOOKED:,} operations were looked at")
        further = refined(classes, rows)
        if further is None:
            return classes
        classes = further


def _groups(names: Sequence[str], classes: Sequence[int]) -> Iterator[tuple[str, ...]]:
    """Yield the names of the states of each class with several states."""
    found: dict[int, list[str]] = {}
    for name, number in zip(names, classes, strict=True):
        found.setdefault(number, []).append(name)
    yield from (tuple(states) for states in found.values() if len(states) > 1)


def _differing(branch: StateBranch, states: Sequence[str]) -> tuple[str, ...]:
    columns = zip(*(branch.facts(name) for name in states), strict=True)
    return tuple(
        branch.fact_name(digit) for digit, column in enumerate(columns) if len(set(column)) > 1
    )


def _why_not(branch: StateBranch, states: Sequence[str], named: dict[tuple[str, str], str]) -> str:
    """Return why states with the same facts and operations cannot be merged. Empty if they can."""
    for name in states:
        claim = named.get((branch.name, name))
        if claim is not None:
            return f"the property {claim} names {name}"
    first, *others = states
    for name in others:
        for operation in branch.table[name]:
            if branch.operation_note(name, operation) != branch.operation_note(first, operation):
                return f"what is written about {operation} differs in {first} and {name}"
        if _is_safe(branch, name) != _is_safe(branch, first):
            return f"one of {first} and {name} is declared safe"
    return ""


def _is_safe(branch: StateBranch, state: str) -> bool:
    note = branch.state_note(state)
    return note is not None and bool(note.safe)
