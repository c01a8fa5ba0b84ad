"""The values that a fact may have."""

from __future__ import annotations

from smsl_studio.blueprint.model import StateBranch


def values_of(branch: StateBranch, digit: int) -> tuple[str, ...]:
    """Return the values that a fact may have: those of the states, and those that ``_facts``
    tells of, which sensors may read."""
    note = branch.fact_note(digit)
    told = (*note.values, *note.failure) if note else ()
    return tuple(dict.fromkeys((*branch.alphabet[digit], *told)))
