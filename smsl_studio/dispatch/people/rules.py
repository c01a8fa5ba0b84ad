"""The rules that make facts from sensors and answers: the levels override ``_facts``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.continuum import AUTOMATIC, HUMAN, SHARED
from smsl_studio.blueprint.levels import Levels, sensed_facts
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.predicates import FactSense
from smsl_studio.host.protocol import OpenedWorld
from smsl_studio.monitor.aggregate import FactRule
from smsl_studio.world.engines import TABLE

PEOPLE = "human"
ALONE = "single"


def leveled_rules(
    blueprint: Blueprint, opened: OpenedWorld, levels: Levels
) -> Mapping[FactKey, FactRule]:
    """Return the rules of a world's facts according to their levels.

    ``human``: no sensor counts, not even those of the table world. ``shared``: sensors count, and
    an answer of a person counts for a fact that they leave unknown. ``automatic``: only sensors
    count.
    """
    found = dict(opened.rules)
    modes: dict[FactKey, str] = {}
    for sensor in opened.sensors:
        modes.setdefault((sensor.branch, sensor.digit), sensor.aggregation)
    for key in sensed_facts(blueprint):
        rule = found.get(key) or FactRule(modes.get(key, ALONE))
        level, asks = levels.fact(*key), rule.aggregation == PEOPLE
        note = blueprint[key[0]].fact_note(key[1])
        # The largest age of a sensor's reading does not apply to an answer.
        declared = note is not None and note.aggregation == PEOPLE
        age = note.max_age if note is not None and declared else None
        if level == HUMAN:
            found[key] = replace(rule, aggregation=PEOPLE, max_age=age)
        elif level == SHARED:
            found[key] = replace(
                rule, aggregation=ALONE if asks else rule.aggregation, max_age=age, shared=True
            )
        elif level == AUTOMATIC and asks:
            found[key] = replace(rule, aggregation=ALONE)
    for key, sense in _senses(blueprint, opened):
        found[key] = replace(found.get(key) or FactRule(), sense=sense)
    return found


def _senses(blueprint: Blueprint, opened: OpenedWorld) -> Iterator[tuple[FactKey, FactSense]]:
    """Yield the facts that predicates decide in this world.

    The table world senses the facts themselves. There predicates decide only what is sensed
    elsewhere.
    """
    elsewhere = {(one.branch, one.digit) for one in opened.sensors if one.remote}
    for branch in blueprint:
        for digit, sense in branch.notes.senses.items():
            key = branch.name, digit
            own = digit < branch.num_facts and digit not in branch.subs
            if own and (opened.world != TABLE or key in elsewhere):
                yield key, sense
