"""The built-in library of the table world: it carries out every blueprint without physics.

The function of an edge sets the facts of its target in one tick, except digits that a sub-SB
expands. With ``subs: load`` it also sets the facts of the sub-SBs' states, and of the sub-SBs below
them. Every fact is sensed at every tick (clause 14).
"""

from __future__ import annotations

from collections.abc import Generator, Iterator, Mapping
from itertools import count, repeat
from operator import methodcaller

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.library.bound import (
    Bindings,
    BoundOperation,
    BoundSensor,
    leaf_facts,
    noted_touches,
)
from smsl_studio.library.table_faults import befallen
from smsl_studio.world.table import TableWorld

FUNCTION = "table.set_facts"
TIMEOUT = 20.0


def set_facts(
    world: TableWorld, blueprint: Blueprint, edge: Address
) -> Generator[None, None, bool | None]:
    """Set the facts of an edge's target within the first tick, unless a fault was injected."""
    how, other = world.befalling(str(edge))
    if how:
        return (yield from befallen(world, how, other))
    world.set_facts(facts_of_edge(blueprint, edge))
    yield from ()
    return None


def table_bindings(blueprint: Blueprint) -> Bindings:
    """Return the bindings of the table world: every edge and every sensed fact is bound."""
    sensors = tuple(_sensor(branch, digit) for branch, digit in leaf_facts(blueprint))
    return Bindings(_TableOperations(blueprint), sensors)


def facts_of(branch: StateBranch, state: str) -> dict[FactKey, str]:
    """Return the facts of a state, without the facts that a sub-SB expands."""
    facts = dict(zip(zip(repeat(branch.name), count()), branch.facts(state), strict=False))
    for digit in branch.subs:
        facts.pop((branch.name, digit), None)
    return facts


def facts_of_edge(blueprint: Blueprint, edge: Address) -> dict[FactKey, str]:
    """Return the facts that the function of an edge sets."""
    branch = blueprint[edge.branch]
    target = branch.table[edge.state][edge.operation]
    if target not in branch.table:
        return {}
    facts = facts_of(branch, target)
    if branch.subs and branch.operation_note(edge.state, edge.operation).subs == "load":
        for digit, sub in branch.subs.items():
            if digit < branch.num_facts and sub in blueprint.branches:
                on = branch.is_on(target, digit)
                if on != branch.is_on(edge.state, digit):
                    facts |= _facts_below(blueprint, sub, on, {branch.name})
    return facts


def _facts_below(blueprint: Blueprint, name: str, on: bool, above: set[str]) -> dict[FactKey, str]:
    """Return the facts of a sub-SB in its ACTIVATING (``on``) or INITIAL state, and of the SBs
    below it. ``above`` are the SBs above it, to end at a cycle."""
    branch = blueprint[name]
    state = branch.activating if on else branch.initial
    if name in above or state not in branch.table:
        return {}
    facts = facts_of(branch, state)
    for digit, sub in branch.subs.items():
        if digit < branch.num_facts and sub in blueprint.branches:
            facts |= _facts_below(blueprint, sub, branch.is_on(state, digit), above | {name})
    return facts


class _TableOperations(Mapping[Address, BoundOperation]):
    """The bindings of all edges of a blueprint. Each is made when it is asked for, because a file
    may have 177,144 edges."""

    def __init__(self, blueprint: Blueprint) -> None:
        self._blueprint = blueprint

    def __getitem__(self, edge: Address) -> BoundOperation:
        branch = self._blueprint.branches[edge.branch]
        _ = branch.table[edge.state][edge.operation]
        note = branch.operation_note(edge.state, edge.operation)
        return BoundOperation(
            FUNCTION,
            set_facts,
            {"blueprint": self._blueprint, "edge": edge},
            False,
            note.stop or "hold",
            note.timeout or TIMEOUT,
            resumes=note.resumes is not False,
            touches=noted_touches(branch, note),
        )

    def __iter__(self) -> Iterator[Address]:
        return (edge.address for branch in self._blueprint for edge in branch.edges())

    def __len__(self) -> int:
        return self._blueprint.operation_count


def _sensor(branch: StateBranch, digit: int) -> BoundSensor:
    note = branch.fact_note(digit)
    return BoundSensor(
        f"table_{branch.name}_{digit}",
        branch.name,
        digit,
        TableWorld.tick,
        (note.max_age if note else None) or 0.3,
        "single",
        methodcaller("fact", branch.name, digit),
        {},
    )
