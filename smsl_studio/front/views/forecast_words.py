"""The words of a forecast for people: what changes, what differs, and why there is none."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.address import Address, split_fact
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.library.prediction import AGREES, DIFFERS, Prediction

Values = Mapping[str, str | None]
"""Values of sensed facts by ``SB/digit``. None is an unknown fact."""


def operation_name(blueprint: Blueprint, edge: Address) -> str:
    """Return the title of an operation, or its name."""
    note = blueprint[edge.branch].operation_note(edge.state, edge.operation)
    return note.title or edge.operation


def changes_words(blueprint: Blueprint, before: Values, found: Prediction) -> str:
    """Return the facts that change, ``Disk 1: on peg a → on peg c``. Empty if none does."""
    return "; ".join(
        f"{_fact(blueprint, key)}: {_value(blueprint, key, before.get(key))} → "
        f"{_value(blueprint, key, value)}"
        for key, value in found.after.items()
        if before.get(key) != value
    )


def differs_words(blueprint: Blueprint, found: Prediction) -> str:
    """Return what differs from the blueprint, ``Disk 2 will be on peg b``."""
    told = [
        f"{_fact(blueprint, key)} will be {_value(blueprint, key, found.after.get(key))}"
        for key in found.apart
    ]
    return "; ".join(told) or found.reason


def verdict_words(blueprint: Blueprint, before: Values, found: Prediction) -> str:
    """Return a forecast in words: that it agrees and what changes, what differs, or why there is
    none."""
    if found.verdict == AGREES:
        return f"agrees. {changes_words(blueprint, before, found) or 'No fact changes'}"
    if found.verdict == DIFFERS:
        return f"differs. {differs_words(blueprint, found)}"
    return f"none: {found.reason}"


def _fact(blueprint: Blueprint, key: str) -> str:
    fact = _known(blueprint, key)
    return blueprint[fact[0]].fact_name(fact[1]) if fact is not None else key


def _value(blueprint: Blueprint, key: str, value: str | None) -> str:
    if value is None:
        return "unknown"
    fact = _known(blueprint, key)
    note = blueprint[fact[0]].fact_note(fact[1]) if fact is not None else None
    return note.values.get(value, value) if note is not None else value


def _known(blueprint: Blueprint, key: str) -> tuple[str, int] | None:
    fact = split_fact(key)
    return fact if fact is not None and fact[0] in blueprint.branches else None
