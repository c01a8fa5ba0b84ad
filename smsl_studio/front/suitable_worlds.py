"""Finds the worlds in which a blueprint can run: all its operations and facts are bound there."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.continuum import HUMAN
from smsl_studio.blueprint.edges import Edges
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.procedures import procedures_of
from smsl_studio.errors import StudioError
from smsl_studio.host.plugin_offers import describe
from smsl_studio.library.bindings import bind
from smsl_studio.library.bindings_file import bindings_beside
from smsl_studio.library.bound import leaf_facts
from smsl_studio.library.loaded import Loaded
from smsl_studio.world.engines import TABLE


def worlds_for(
    blueprint: Blueprint, plugin_paths: Sequence[Path] = (), loaded: Loaded | None = None
) -> tuple[str, ...]:
    """Return the worlds in which every operation has a function or a person, and every fact has a
    sensor or a person.

    Worlds of plugins come first, in their order. ``table`` comes last, because it runs every
    blueprint. ``loaded`` are plugins that were found already. No plugin's code runs in this
    process.

    >>> print(*worlds_for(read("hanoi.json")))
    hanoi hanoi-mujoco table
    """
    known = loaded if loaded is not None else describe(plugin_paths)
    names = [name for name in known.worlds if name != TABLE]
    return (*(name for name in names if _suits(blueprint, known, name)), TABLE)


def _suits(blueprint: Blueprint, loaded: Loaded, world: str) -> bool:
    try:
        edges = Edges(Hierarchy(blueprint))
        bindings = bind(blueprint, loaded, world, bindings_beside(blueprint.file))
        procedures = procedures_of(blueprint)
    except StudioError:
        return False
    sensed = {(sensor.branch, sensor.digit) for sensor in bindings.sensors}
    levels = Levels(blueprint)
    facts = ((branch.name, digit) for branch, digit in leaf_facts(blueprint))
    if any(fact not in sensed and levels.fact(*fact) != HUMAN for fact in facts):
        return False
    return blueprint.operation_count > 0 and all(
        edge.address in bindings.operations
        or edge.address in procedures.bound
        or levels.operation(edge.address) == HUMAN
        for branch in blueprint
        for state in branch.table
        for edge in edges.out(branch.name, state)
        if edge.function
    )
