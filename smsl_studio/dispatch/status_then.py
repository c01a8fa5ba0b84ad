"""The status of a recorded run at a moment, in the same form as that of a live run."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import CheckResult, Reading, Scene, state_check
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.runlog.moment import RunMoment
from smsl_studio.runlog.phase import phase_at_end


def status_at(blueprint: Blueprint, moment: RunMoment) -> DispatchStatus:
    """Return the status at a moment. Elements that the blueprint does not have are left out,
    because it may be another version.

    Nothing is possible in it, because the past takes no commands.
    """
    configuration = {
        name: state
        for name, state in moment.configuration.items()
        if name in blueprint.branches and state in blueprint[name].table
    }
    readings = {
        key: Reading(fact.value, fact.reason, max(moment.time - fact.since, 0.0))
        for key, fact in moment.facts.items()
        if key[0] in blueprint.branches and key[1] < blueprint[key[0]].num_facts
    }
    scene = Scene(readings, moment.time)
    running = _first_known(blueprint, (moment.running,))
    entered, held = moment.entered, moment.held
    # What was planned is given up then, as in a live run.
    latched = moment.phase in ("stopped", "taken_over")
    led = {name: _first_known(blueprint, (way.by,)) for name, way in entered.items()}
    return DispatchStatus(
        phase=phase_at_end(moment.phase) if moment.finished else moment.phase,
        time=moment.time,
        configuration=configuration,
        pending={},
        running=running,
        carrying=_first_known(blueprint, moment.started),
        running_since=moment.running_since if running else None,
        progress=None,
        route=() if latched else tuple(_known(blueprint, moment.route)),
        goals=tuple(goal for goal in map(Address.read, moment.goals) if goal is not None),
        scene=scene,
        check=_check(blueprint, running, configuration, scene),
        possible=(),
        candidates=moment.candidates if held is not None else (),
        reason=moment.reason,
        sentence=moment.sentence,
        operations=moment.operations,
        details=held.details if held is not None else (),
        full_map=moment.full_map,
        by=moment.by,
        since={name: way.since for name, way in entered.items()},
        previous={name: address for name, address in led.items() if address is not None},
    )


def _check(
    blueprint: Blueprint, running: Address | None, configuration: Mapping[str, str], scene: Scene
) -> CheckResult | None:
    """Return the awaited state check, computed from the facts of that moment."""
    if running is None or not scene.readings:
        return None
    target = blueprint[running.branch].table[running.state][running.operation]
    if target not in blueprint[running.branch].table:
        return None
    return state_check(blueprint, running.branch, target, scene, configuration)


def _first_known(blueprint: Blueprint, texts: Iterable[str]) -> Address | None:
    return next(_known(blueprint, texts), None)


def _known(blueprint: Blueprint, texts: Iterable[str]) -> Iterator[Address]:
    """Yield the operations that the blueprint has."""
    for text in texts:
        parts = Address.split(text)
        branch = blueprint.branches.get(parts[0])
        known = branch.table if branch is not None else {}
        if len(parts) == 3 and parts[2] in known.get(parts[1], {}):
            yield Address(*parts)
