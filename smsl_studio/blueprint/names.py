"""Fresh names for new elements, in the manner of the names that are there."""

from __future__ import annotations

from collections.abc import Container
from itertools import product

from smsl_studio.blueprint.facts import fact_string
from smsl_studio.blueprint.model import Blueprint, StateBranch

_TRIES = 4096
_LONGEST = 64
"""So many facts at most are put into a name that nobody has typed."""


def fresh_branch_name(blueprint: Blueprint) -> str:
    """``SB1``, ``SB2``...: the first that is free."""
    return _numbered("SB", blueprint.branches)


def fresh_state_name(branch: StateBranch) -> str:
    """A free name in the manner of the SB's states: their prefix and unused fact values.

    The first state of an SB is ``State0``, with as many digits as NUM_FACTS asks for.
    """
    if not branch.table:
        return "State" + "0" * min(branch.header.num_facts or 1, _LONGEST)
    shape = branch.shape
    if shape.opaque or shape.width == 0:
        return _numbered("State", branch.table)
    last = next(reversed(branch.table))
    prefix = last[: len(last) - len(fact_string(last, shape.written))]
    values = sorted({value for column in branch.alphabet for value in column})
    if set(values) <= {"0", "1"}:
        values = ["0", "1"]
    for tries, digits in enumerate(product(values, repeat=shape.num_facts)):
        name = prefix + "".join(digits)
        if name not in branch.table:
            return name
        if tries >= _TRIES:
            break
    return _numbered(prefix, branch.table)


def fresh_operation_name(branch: StateBranch, state: str) -> str:
    """A free name in ``state``: ``Operation`` and the state's facts, with a letter if need be."""
    taken = branch.table.get(state, {})
    used = {name for operations in branch.table.values() for name in operations}
    prefix = "Op_" if used and all(name.startswith("Op_") for name in used) else "Operation"
    plain = prefix + fact_string(state, branch.header.num_facts)
    if plain not in taken and not any(name.startswith(plain) for name in taken):
        return plain
    for letter in "ABCDEFGHIJKLMNOPQRSTUVWXYZ":
        if plain + letter not in taken:
            return plain + letter
    return _numbered(plain, taken)


def _numbered(prefix: str, taken: Container[str]) -> str:
    number = 1
    while f"{prefix}{number}" in taken:
        number += 1
    return f"{prefix}{number}"
