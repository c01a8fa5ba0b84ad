"""The aggregation rules of the facts in a world, as ``_facts`` declares them (paper, Eq. 5)."""

from __future__ import annotations

from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.library.bound import Bindings, leaf_facts
from smsl_studio.monitor.aggregate import FactRule


def rules_of(blueprint: Blueprint, bindings: Bindings) -> dict[FactKey, FactRule]:
    """Return the rule of every fact that has an entry in ``_facts`` or named sensors. Other facts
    have no rule."""
    found: dict[FactKey, FactRule] = {}
    for branch, digit in leaf_facts(blueprint):
        note = branch.fact_note(digit)
        key = (branch.name, digit)
        named = bindings.named.get(key, ())
        if note is None:
            if named:
                found[key] = FactRule(sensors=named)
            continue
        found[key] = FactRule(
            note.aggregation,
            note.k,
            note.critical,
            note.conflict_after,
            named,
            note.max_age,
        )
    return found
