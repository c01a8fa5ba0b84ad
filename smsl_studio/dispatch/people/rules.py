"""How facts are made of their sensors where people have a say in them: levels over ``_facts``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.continuum import AUTOMATIC, HUMAN, SHARED
from smsl_studio.blueprint.levels import Levels, sensed_facts
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.host.protocol import OpenedWorld
from smsl_studio.monitor.aggregate import FactRule

PEOPLE = "human"
ALONE = "single"


def leveled_rules(
    blueprint: Blueprint, opened: OpenedWorld, levels: Levels
) -> Mapping[FactKey, FactRule]:
    """The rules of a world's facts, as their levels have them.

    ``human``: no sensor counts, also none of the table world. ``shared``: sensors count, and
    where they leave it unknown a person's answer. ``automatic``: sensors alone.
    """
    found = dict(opened.rules)
    modes: dict[FactKey, str] = {}
    for sensor in opened.sensors:
        modes.setdefault((sensor.branch, sensor.digit), sensor.aggregation)
    for key in sensed_facts(blueprint):
        rule = found.get(key) or FactRule(modes.get(key, ALONE))
        level, asks = levels.fact(*key), rule.aggregation == PEOPLE
        note = blueprint[key[0]].fact_note(key[1])
        # An age that was declared for sensors says nothing about how long an answer holds.
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
    return found
