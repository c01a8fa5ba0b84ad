"""A moment of a recorded run as the status that the widgets of a run read."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import CheckResult, Reading, Scene, state_check
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.runlog.retold import Retold


def as_status(blueprint: Blueprint, told: Retold) -> DispatchStatus:
    """How the run stood. What the blueprint does not have (it may be another version) is left out.

    Nothing is possible: what is over cannot be commanded.
    """
    configuration = {
        name: state
        for name, state in told.configuration.items()
        if name in blueprint.branches and state in blueprint[name].table
    }
    readings = {
        key: Reading(fact.value, fact.reason, max(told.time - fact.since, 0.0))
        for key, fact in told.facts.items()
        if key[0] in blueprint.branches and key[1] < blueprint[key[0]].num_facts
    }
    scene = Scene(readings, told.time)
    running = _known(blueprint, told.running)
    return DispatchStatus(
        phase=told.phase,
        time=told.time,
        configuration=configuration,
        pending={},
        running=running,
        carrying=next(iter(_all_known(blueprint, told.started)), None),
        running_since=told.running_since if running else None,
        progress=None,
        route=_all_known(blueprint, told.route),
        goals=tuple(goal for goal in map(Address.read, told.goals) if goal is not None),
        scene=scene,
        check=_check(blueprint, running, configuration, scene),
        possible=(),
        candidates=told.candidates,
        reason=told.finished.reason if told.finished else "",
        sentence=told.sentence,
        operations=told.operations,
        full_map=told.full_map,
        by=told.stopped or told.taken_over,
        since={name: entered.since for name, entered in told.entered.items()},
    )


def _check(
    blueprint: Blueprint, running: Address | None, configuration: dict[str, str], scene: Scene
) -> CheckResult | None:
    """The check that is awaited, worked out from what was sensed at that moment."""
    if running is None or not scene.readings:
        return None
    target = blueprint[running.branch].table[running.state][running.operation]
    if target not in blueprint[running.branch].table:
        return None
    return state_check(blueprint, running.branch, target, scene, configuration)


def _known(blueprint: Blueprint, text: str) -> Address | None:
    return next(iter(_all_known(blueprint, (text,) if text else ())), None)


def _all_known(blueprint: Blueprint, texts: tuple[str, ...]) -> tuple[Address, ...]:
    """The operations that the blueprint has."""
    found = []
    for text in texts:
        parts = Address.split(text)
        branch = blueprint.branches.get(parts[0])
        known = branch.table if branch is not None else {}
        if len(parts) == 3 and parts[2] in known.get(parts[1], {}):
            found.append(Address(*parts))
    return tuple(found)
