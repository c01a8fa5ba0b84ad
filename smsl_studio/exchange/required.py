"""What operations require, as states in which it holds."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch


def required_states(
    blueprint: Blueprint, branch: StateBranch, state: str, operation: str
) -> list[list[tuple[str, str]]]:
    """Return for each fact that an edge requires the states (SB, state) in which it holds.

    A list is empty if no state has the fact: then the edge is never permitted.
    """
    found = []
    for key, value in branch.operation_note(state, operation).requires.items():
        parts = Address.split(key)
        other = blueprint.branches.get(parts[0]) if len(parts) == 2 else None
        digit = int(parts[1]) if other and parts[1].isascii() and parts[1].isdecimal() else -1
        holding = other.states_with(digit, value) if other and digit >= 0 else frozenset()
        names = other.table if other else ()
        found.append([(parts[0], one) for one in names if one in holding])
    return found
