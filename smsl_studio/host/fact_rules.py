"""How each fact is made of its sensors in a world, as ``_facts`` declares it."""

from __future__ import annotations

from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.library.bound import Bindings, leaf_facts
from smsl_studio.monitor.aggregate import FactRule


def rules_of(blueprint: Blueprint, bindings: Bindings) -> dict[FactKey, FactRule]:
    """The rule of every fact that ``_facts`` says anything of, or for which sensors are named;
    other facts have none."""
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
