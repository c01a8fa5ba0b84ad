"""Guards: the facts that an operation requires before it starts, with their names."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from smsl_studio.blueprint.address import Address, split_fact
from smsl_studio.blueprint.model import Blueprint, StateBranch

MEANING = "needs other facts first"
"""The meaning of the guard's mark in legends."""


@dataclass(frozen=True)
class Guard:
    """A fact of any SB that must have a value. A ``digit`` of -1 means that there is no such
    fact.
    """

    branch: str
    digit: int
    value: str
    words: str


def has_guards(branch: StateBranch) -> bool:
    """Return whether any operation of an SB requires a fact."""
    if "_operations" not in branch.fields:
        return False
    return any(note.requires for note in branch.notes.operations.values())


def guarded_edges(branch: StateBranch) -> Iterator[Address]:
    """Yield the edges of an SB that may require a fact, found by their names in the SB's notes."""
    if not has_guards(branch):
        return
    notes = branch.notes.operations
    names = {Address.split(key)[-1] for key, note in notes.items() if note.requires}
    for state, operations in branch.table.items():
        for name in names & operations.keys():
            yield Address(branch.name, state, name)


def guards_of(
    blueprint: Blueprint, branch: StateBranch, state: str, operation: str
) -> tuple[Guard, ...]:
    """Return the facts that one edge requires, in written order."""
    requires = branch.operation_note(state, operation).requires
    return tuple(_guard(blueprint, key, value) for key, value in requires.items())


def needs_words(guards: tuple[Guard, ...]) -> str:
    """Return the guards in words, such as ``needs Registered of REGISTRATION to be 1``."""
    return f"needs {', '.join(guard.words for guard in guards)}" if guards else ""


def _guard(blueprint: Blueprint, key: str, value: str) -> Guard:
    name, digit = split_fact(key) or (key, -1)
    branch = blueprint.branches.get(name)
    if branch is None or not 0 <= digit < branch.num_facts:
        return Guard(key, -1, value, f"{key}, which is no fact")
    meaning = branch.notes.facts[digit].values.get(value, "") if branch.fact_note(digit) else ""
    said = f"{value} ({meaning})" if meaning else value
    return Guard(name, digit, value, f"{branch.fact_name(digit)} of {name} to be {said}")
