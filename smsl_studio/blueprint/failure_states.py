"""Failure states: states with a value that ``_facts`` declares as a failure."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from smsl_studio.blueprint.model import StateBranch

_KEY = "_failing"
_NONE: MappingProxyType[str, str] = MappingProxyType({})


def failing_states(branch: StateBranch) -> Mapping[str, str]:
    """Return every failure state with the facts that make it one, such as ``Disk 1 would be x``.

    The result is computed at the first call and kept with the branch.
    """
    kept = branch.__dict__.get(_KEY)
    if isinstance(kept, MappingProxyType):  # quicker than Mapping, and asked for every edge
        return kept
    found = _failing(branch) if "_facts" in branch.fields else _NONE
    branch.__dict__[_KEY] = found
    return found


def failures(branch: StateBranch, state: str) -> tuple[tuple[int, str], ...]:
    """Return the facts that make a state a failure, as digits (from 0) with their values."""
    return _failures(branch, state, _declared(branch))


def _failing(branch: StateBranch) -> Mapping[str, str]:
    declared = _declared(branch)
    if not declared:
        return _NONE
    found: dict[str, str] = {}
    for state in branch.table:
        words = [
            f"{branch.fact_name(digit)} would be {value}"
            for digit, value in _failures(branch, state, declared)
        ]
        if words:
            found[state] = " and ".join(words)
    return MappingProxyType(found)


def _declared(branch: StateBranch) -> list[tuple[int, frozenset[str]]]:
    """Return the digit and the failure values of each fact that has some."""
    return [
        (digit, frozenset(note.failure))
        for digit, note in sorted(branch.notes.facts.items())
        if note.failure and digit < branch.num_facts
    ]


def _failures(
    branch: StateBranch, state: str, declared: list[tuple[int, frozenset[str]]]
) -> tuple[tuple[int, str], ...]:
    facts = branch.facts(state)
    return tuple(
        (digit, facts[digit])
        for digit, values in declared
        if digit < len(facts) and facts[digit] in values
    )
