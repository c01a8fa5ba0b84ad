"""Finds the shortest run from the start to a configuration."""

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
from smsl_studio.inspection.proof.way import way_to
from smsl_studio.stop import heed

NEAR = 5_000
"""The number of configurations that are explored one by one before an engine for large spaces is
tried."""


@dataclass(frozen=True)
class RunThere:
    """The answer: the shortest run, or None.

    If ``run`` is None, ``bound`` names the limit that ended the search. If ``bound`` is empty too,
    no run leads to the configuration.
    """

    run: Counterexample | None
    bound: str = ""


def shortest_run_to(blueprint: Blueprint, end: Mapping[str, str], limit: int) -> RunThere:
    """Return the shortest run to a configuration.

    Of several shortest runs it is the one whose addresses come first, compared step by step. Groups
    of SBs that do not depend on each other are searched separately, with at most ``limit``
    configurations each. A large group is searched with an engine if that is possible. The run may
    meet hazards and lead into failures. RunRefused if there is no start.
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
    """Return the shortest path in one group of SBs, or the limit that ended the search."""
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
                    return way_to(end, came.__getitem__)[1], ""
                following.append(step.to)
        waiting = following
    return (way_to(end, came.__getitem__)[1] if end in came else None), ""


def _path_at_once(
    blueprint: Blueprint, names: Sequence[str], end: Mapping[str, str], met: str
) -> tuple[Path | None, str]:
    """Return the shortest path in one group of SBs, found with an engine.

    If no engine finds it, return ``met``, the limit of the search before.
    """
    engine = Engines(blueprint, ()).engine(names, False)
    if engine is None:
        return None, met
    there = tuple(States(name, frozenset({end[name]})) for name in names)
    try:
        # ``before [F, G]`` with an F that never holds fails with the shortest run to G.
        answer = engine.before(States(names[0], frozenset()), Joined(True, there))
    except (TooLarge, RecursionError):
        return None, met
    if answer.verdict == HOLDS:
        return None, ""
    return (None, met) if answer.run is None else (answer.run.path, "")
