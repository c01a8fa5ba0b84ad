"""The shortest run from the start to a configuration."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.meaning import Joined, States
from smsl_studio.errors import PlanningError
from smsl_studio.graph.joint.products import TooLarge
from smsl_studio.inspection.explorer.combinations import joined
from smsl_studio.inspection.explorer.part import Path, independent, restricted
from smsl_studio.inspection.proof.engines import Engines
from smsl_studio.inspection.proof.space import Key, Space
from smsl_studio.inspection.proof.verdict import HOLDS, Counterexample
from smsl_studio.stop import heed

NEAR = 5_000
"""So many configurations are looked at one by one before all are looked at together."""


@dataclass(frozen=True)
class RunThere:
    """The answer. Without a ``run`` the configuration cannot be reached, or the search met a
    ``bound``, which is in words."""

    run: Counterexample | None
    bound: str = ""


def shortest_run_to(blueprint: Blueprint, end: Mapping[str, str], limit: int) -> RunThere:
    """Return the run to a configuration with the fewest steps; of these the one whose addresses,
    compared step by step, are least.

    SBs that do not touch each other are looked at apart, with at most ``limit`` configurations of
    each group. If there are many, all of them are looked at together where that is possible.
    Hazards and failures are not left out. RunRefused if there is no start.
    """
    hierarchy = Hierarchy(blueprint)
    start = start_configuration(hierarchy, {})
    paths: list[Path] = []
    bound = ""
    for names in independent(hierarchy):
        space = Space(restricted(blueprint, names))
        path, met = _path(space, space.key(end), min(limit, NEAR))
        if met:
            path, met = _path_at_once(blueprint, names, end, met)
        if met and limit > NEAR:
            path, met = _path(space, space.key(end), limit)
        if path is None and not met:
            return RunThere(None)
        bound = bound or met
        paths.append(path or ())
    if bound:
        return RunThere(None, bound)
    order = blueprint.branches
    ends = ({name: one[name] for name in order} for one in (start, end))
    return RunThere(Counterexample(next(ends), joined(paths), next(ends)))


def _path(space: Space, end: Key, limit: int) -> tuple[Path | None, str]:
    """Return the shortest path to a configuration of one part, or the bound that was met."""
    came: dict[Key, tuple[Key, Address] | None] = {space.start(): None}
    most, bound = space.storable(limit)
    waiting: Sequence[Key] = tuple(came)
    while waiting and end not in came:
        following: list[Key] = []
        for key in waiting:
            heed()
            try:
                steps = space.steps(key)
            except PlanningError as error:
                return None, error.sentence
            for step in steps:
                if step.to in came:
                    continue
                if len(came) >= most:
                    return None, bound
                came[step.to] = key, step.address
                if step.to == end:
                    return _back(came, end), ""
                following.append(step.to)
        waiting = following
    return (_back(came, end), "") if end in came else (None, "")


def _path_at_once(
    blueprint: Blueprint, names: Sequence[str], end: Mapping[str, str], met: str
) -> tuple[Path | None, str]:
    """Return the shortest path of one part from all of its configurations together, or ``met``."""
    engine = Engines(blueprint, ()).engine(names, False)
    if engine is None:
        return None, met
    there = tuple(States(name, frozenset({end[name]})) for name in names)
    try:
        # What never holds cannot come before: the run to it is the shortest of all.
        answer = engine.before(States(names[0], frozenset()), Joined(True, there))
    except (TooLarge, RecursionError):
        return None, met
    if answer.verdict == HOLDS:
        return None, ""
    return (None, met) if answer.run is None else (answer.run.path, "")


def _back(came: Mapping[Key, tuple[Key, Address] | None], end: Key) -> Path:
    found: list[Address] = []
    while (before := came[end]) is not None:
        end, address = before
        found.append(address)
    return tuple(reversed(found))
