"""Reads a blueprint to people: the engine's answers first, then the sentences."""

from __future__ import annotations

from dataclasses import replace
from pathlib import PurePath
from typing import TYPE_CHECKING

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison import compare
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.hazards import guard_hazards
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.route.effort import refuse_too_large
from smsl_studio.dispatch.route.planner import Planner
from smsl_studio.errors import PlanningError, RunRefused, UsageError, did_you_mean
from smsl_studio.front.proof import prove
from smsl_studio.inspection.proof.prove import LIMIT
from smsl_studio.inspection.proof.recovery import WayOut, ways_out
from smsl_studio.inspection.reading.reading_grounds import ReadingGrounds

if TYPE_CHECKING:
    from smsl_studio.inspection.reading.sections import BlueprintReading

CLINICIAN, ENGINEER = READERS = ("clinician", "engineer")


def reading(
    blueprint: Blueprint,
    reader: str = CLINICIAN,
    against: Blueprint | None = None,
    former: str = "",
    limit: int = LIMIT,
) -> BlueprintReading:
    """Return a blueprint as sentences (paper, Inspection: a person accepts a procedure).

    ``reader`` is ``clinician``, or ``engineer``, who also sees the names in the file. ``against``
    is a former version, and the reading then says what changed; ``former`` is the name of that
    version. ``limit`` is the largest number of configurations that are stored for each proof.
    UsageError for another reader.

    >>> told = reading(read("registration-people.json"))
    >>> [section.heading for section in told.sections][:2]
    ['Before you start', 'The procedure']
    >>> step = told.sections[1].lines[0]
    >>> step.heading, step.who
    ('Fix the head', 'The nurse')
    """
    from smsl_studio.inspection.reading.reading_author import written_reading

    if reader not in READERS:
        raise UsageError(f"{reader!r} is no reader", advice=did_you_mean(reader, READERS))
    difference = None if against is None else compare(against, blueprint)
    name = former or ("" if against is None else PurePath(against.file).name)
    grounds = replace(_grounds(blueprint, limit), difference=difference, former=name)
    return written_reading(blueprint, grounds, identifiers=reader == ENGINEER)


def _grounds(blueprint: Blueprint, limit: int) -> ReadingGrounds:
    """Return the answers of the engine that the sentences repeat."""
    try:
        hierarchy = Hierarchy(blueprint)
        start = start_configuration(hierarchy, {})
    except RunRefused as error:
        return ReadingGrounds(None, None, refusal=_clause(error.sentence))
    planner = Planner(hierarchy, Terms(hazards=guard_hazards(blueprint)))
    goals = [
        Address(name, blueprint[name].activating)
        for name in hierarchy.roots
        if blueprint[name].activating in blueprint[name].table
    ]
    steps, bound = None, ""
    try:
        refuse_too_large(hierarchy)
        legs = planner.legs(start, goals)
        steps = None if legs is None else tuple(step for leg in legs for step in leg.steps)
    except (PlanningError, RunRefused) as error:
        bound = _clause(error.sentence)
    ways = ways_out(blueprint, limit)
    return ReadingGrounds(
        start,
        steps,
        bound=bound,
        verdicts=prove(blueprint, limit).verdicts,
        ways=ways,
        costs={way.state: _cost(planner, way, goals) for way in ways},
    )


def _cost(planner: Planner, way: WayOut, goals: list[Address]) -> float | None:
    """Return the cost of the cheapest route from a failure state to the goals, None for none."""
    if way.start is None:
        return None
    try:
        legs = planner.legs(way.start, goals)
    except PlanningError:
        return None
    return None if legs is None else sum(leg.cost for leg in legs)


def _clause(sentence: str) -> str:
    """Return the sentence of an error with a capital letter and without a full stop."""
    return f"{sentence[:1].upper()}{sentence[1:]}".rstrip(".")
