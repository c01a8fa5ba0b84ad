"""A preview: what the world simulator predicts for one operation, compared with what the blueprint
declares. Nothing is recorded.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, flags, start_configuration
from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.hazards import guard_hazards
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.dispatch.route.effort import refuse_too_large
from smsl_studio.errors import UsageError
from smsl_studio.front.hosts import known_world, make_host, with_robot
from smsl_studio.front.logs import replay
from smsl_studio.front.request import RunRequest, Several, several
from smsl_studio.front.runs import open_request
from smsl_studio.front.script.addresses import Written, operations_at, states_at
from smsl_studio.front.starts import start_for_edge
from smsl_studio.host.protocol import Host
from smsl_studio.library.loaded import Loaded
from smsl_studio.runlog.events import (
    Committed,
    OperationRefused,
    OperationStarted,
    Relocalised,
    RunStarted,
)
from smsl_studio.world.engines import TABLE

Json = Any
Facts = dict[str, str | None]
"""Values of facts by ``SB/digit``, with digits from 0. None is an unknown fact."""
MOST = 10_000
"""The largest number of repeats and of operations ahead."""


@dataclass(frozen=True, slots=True)
class Forecast:
    """What the simulator predicts for one operation.

    ``before`` and ``after`` are sensed facts, ``declared`` what the blueprint says about the sensed
    facts afterwards. ``share`` is the share of the repeats that agree. ``hazard`` is the first that
    is met afterwards, empty without one. ``sentence`` says why the operation was not carried out.
    ``then`` are the operations that follow on the route, each from where the one before ended.
    """

    edge: str
    before: Facts
    after: Facts
    declared: Facts
    agrees: bool
    share: float
    hazard: str = ""
    sentence: str = ""
    then: tuple[Forecast, ...] = ()

    def as_json(self) -> dict[str, Json]:
        """Return the preview as plain values."""
        told: dict[str, Json] = {
            "edge": self.edge,
            "before": self.before,
            "after": self.after,
            "declared": self.declared,
            "agrees": self.agrees,
            "share": self.share,
            "hazard": self.hazard or None,
        }
        if self.sentence:
            told["sentence"] = self.sentence
        if self.then:
            told["then"] = [one.as_json() for one in self.then]
        return told


def preview(
    blueprint: Blueprint,
    edge: Written,
    world: str = TABLE,
    *,
    start: Several = None,
    log: str | os.PathLike[str] | None = None,
    ahead: int = 1,
    repeats: int = 1,
    seed: int = 0,
    robot: str = "",
) -> Forecast:
    """Carry one operation out in a simulated world, and compare the facts.

    It begins in the source of the operation, in ``start``, or in the last configuration of a
    ``log``. ``ahead`` counts the operations on the route, this one included. ``repeats`` are run
    with the seeds from ``seed`` up. UsageError if the operation does not leave the start,
    AddressError for an unknown address, WorldError for a world that does not suit the blueprint.

    >>> told = preview(read("hanoi-2.json"), "State_aa/Op_1b")
    >>> told.agrees, told.after
    (True, {'SB1/0': 'b', 'SB1/1': 'a'})
    """
    if not 1 <= repeats <= MOST or not 1 <= ahead <= MOST:
        raise UsageError(f"repeats and operations ahead are whole numbers from 1 to {MOST:,}")
    found = operations_at(blueprint, [edge])
    if len(found) != 1:
        raise UsageError(
            f"{edge} stands for {len(found)} operations", advice="Write SB/State/Operation."
        )
    (address,) = found
    hierarchy = Hierarchy(blueprint)
    refuse_too_large(hierarchy)
    begun = _start(hierarchy, address, start, log)
    loaded = known_world(world)
    request = with_robot(RunRequest(blueprint, world, host="local", robot=robot), loaded)
    previews = [
        _once(
            hierarchy,
            loaded,
            replace(request, seed=number),
            address,
            begun,
            ahead,
        )
        for number in range(seed, seed + repeats)
    ]
    share = sum(one.agrees for one in previews) / repeats
    return replace(previews[0], share=share)


def _start(
    hierarchy: Hierarchy,
    edge: Address,
    start: Several,
    log: str | os.PathLike[str] | None,
) -> Mapping[str, str]:
    given: Mapping[str, str] = {}
    if start is not None:
        states = states_at(hierarchy.blueprint, several(start), "start")
        given = start_configuration(hierarchy, {at.branch: at.state for at in states})
    elif log is not None:
        given = _last(hierarchy.blueprint, log)
    else:
        given = start_for_edge(hierarchy, edge) or {edge.branch: edge.state}
    if given.get(edge.branch) != edge.state:
        where = given.get(edge.branch, "no state")
        raise UsageError(
            f"{edge} does not leave the start: {edge.branch} is in {where}",
            advice=f"Start in {edge.branch}/{edge.state}.",
        )
    return given


def _last(blueprint: Blueprint, log: str | os.PathLike[str]) -> Mapping[str, str]:
    """Return the last configuration of a log. UsageError if it has none, or is of another
    blueprint.
    """
    told = replay(log)
    known = told.header.get("digests")
    if isinstance(known, Mapping) and known.get("behaviour") != digests(blueprint).behaviour:
        raise UsageError(f"{log} is the log of another blueprint", advice="Name one of this file.")
    found: dict[str, str] = {}
    for event in told.events:
        if isinstance(event, RunStarted):
            found = dict(event.start)
        elif isinstance(event, Committed | Relocalised):
            # An event names the SBs that moved.
            found |= event.configuration
    if not found:
        raise UsageError(f"{log} has no moment at which a state was known")
    return found


def _once(
    hierarchy: Hierarchy,
    loaded: Loaded | None,
    request: RunRequest,
    edge: Address,
    start: Mapping[str, str],
    ahead: int,
) -> Forecast:
    host = make_host(request, loaded)
    try:
        terms = RunTerms(start, seed=request.seed, automatic=False, attended=True, guarded=False)
        dispatcher = Dispatcher(hierarchy.blueprint, host, terms)
        list(dispatcher.open())
        if dispatcher.finished:
            sentence = dispatcher.standing.sentence
            return Forecast(str(edge), {}, {}, {}, False, 0.0, sentence=sentence)
        found = [_carried(hierarchy, host, dispatcher, edge)]
        if ahead > 1 and found[0].agrees:
            for following in _route(request.blueprint, dispatcher.standing.configuration, ahead):
                found.append(_carried(hierarchy, host, dispatcher, following))
                if not found[-1].agrees:
                    break
        return replace(found[0], then=tuple(found[1:]))
    finally:
        host.close()


def _route(blueprint: Blueprint, start: Mapping[str, str], ahead: int) -> list[Address]:
    """Return the operations with which a run goes on from here, one fewer than ``ahead``: those of
    a run without physics.
    """
    starts = tuple(Address(branch, state) for branch, state in start.items())
    found: list[Address] = []
    dispatcher = open_request(RunRequest(blueprint, TABLE, starts=starts, host="local"))
    try:
        dispatcher.open()
        while not dispatcher.finished and len(found) < ahead - 1:
            found += [
                Address(*Address.split(event.address))
                for event in dispatcher.tick()
                if isinstance(event, OperationStarted)
            ]
    finally:
        dispatcher.close()
    return found[: ahead - 1]


def _carried(hierarchy: Hierarchy, host: Host, dispatcher: Dispatcher, edge: Address) -> Forecast:
    """Carry one operation out from where the run is."""
    host.suppose(edge)
    before, configuration = _sensed(dispatcher), dispatcher.standing.configuration
    stepper = Stepper(hierarchy, Terms(failing=None))
    known = stepper.edges.get(edge)
    step = stepper.step(configuration, known) if known is not None else None
    target = hierarchy.blueprint[edge.branch].table[edge.state][edge.operation]
    moved = step.after if isinstance(step, JointStep) else {edge.branch: target}
    dispatcher.ask(edge)
    events = list(dispatcher.tick())
    while dispatcher.phase == "running":
        events += dispatcher.tick()
    done = any(isinstance(e, Committed) and str(edge) in e.operations for e in events)
    refused = next((e.reasons for e in events if isinstance(e, OperationRefused)), ())
    after = _sensed(dispatcher)
    expected = flags(hierarchy.blueprint, {**configuration, **moved})
    declared: Facts = {
        text: value
        for (branch, digit), value in expected.items()
        if (text := f"{branch}/{digit}") in after
    }
    agrees = done and all(after[text] == value for text, value in declared.items())
    sentence = "; ".join(refused) or ("" if done else dispatcher.standing.sentence)
    hazard = _hazard(hierarchy.blueprint, after, dispatcher.standing.configuration)
    return Forecast(str(edge), before, after, declared, agrees, float(agrees), hazard, sentence)


def _sensed(dispatcher: Dispatcher) -> Facts:
    readings = dispatcher.standing.scene.readings
    return {
        f"{branch}/{digit}": one.value
        for (branch, digit), one in sorted(readings.items())
        if one.sensed
    }


def _hazard(blueprint: Blueprint, after: Facts, configuration: Mapping[str, str]) -> str:
    """Return the first hazard that holds in these facts. Facts that nobody senses are believed."""
    facts: dict[tuple[str, int], str | None] = dict(flags(blueprint, configuration))
    facts |= {key: after[text] for key in facts if (text := f"{key[0]}/{key[1]}") in after}
    for one in guard_hazards(blueprint):
        if all(facts.get(key) == value for key, value in one.facts):
            return one.name
    return ""
