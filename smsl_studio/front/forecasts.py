"""A forecast: one operation is carried out in a simulated world, and the facts afterwards are
compared with what the blueprint declares. Nothing is recorded.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, flags
from smsl_studio.blueprint.hazards import guard_hazards
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.foresight import sensed_values
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.host.protocol import Host
from smsl_studio.runlog.events import Committed, OperationRefused
from smsl_studio.stop import heed

Json = Any
Facts = dict[str, str | None]
"""Values of facts by ``SB/digit``, with digits from 0. None is an unknown fact."""
Poses = Callable[[], tuple[float, ...]]
Watch = Callable[[float, Poses], None]
"""Gets the simulated seconds since an operation began, before its first step and after each one,
and what tells the poses of the world then (see ``Host.poses``)."""


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


def terms_of(start: Mapping[str, str], seed: int) -> RunTerms:
    """Return the terms of a run that only carries out what it is asked for. Hazards do not guard
    it, because they are to be seen, and nobody confirms what is only foreseen.
    """
    return RunTerms(
        start, seed=seed, automatic=False, attended=True, guarded=False, unconfirmed=True
    )


def carried(
    hierarchy: Hierarchy,
    host: Host,
    dispatcher: Dispatcher,
    edge: Address,
    watch: Watch | None = None,
) -> Forecast:
    """Carry one operation out from where the run of a simulated world is. Stopped if whoever waits
    for it wants to stop.
    """
    host.suppose(edge)
    standing = dispatcher.standing
    before, configuration = sensed_values(standing.scene), standing.configuration
    stepper = Stepper(hierarchy, Terms(failing=None))
    known = stepper.edges.get(edge)
    step = stepper.step(configuration, known) if known is not None else None
    target = hierarchy.blueprint[edge.branch].table[edge.state][edge.operation]
    moved = step.after if isinstance(step, JointStep) else {edge.branch: target}
    dispatcher.ask(edge)
    begun = dispatcher.time
    if watch is not None:
        watch(0.0, host.poses)
    events = list(dispatcher.tick())
    while dispatcher.phase == "running":
        heed()
        if watch is not None:
            watch(dispatcher.time - begun, host.poses)
        events += dispatcher.tick()
    if watch is not None:
        watch(dispatcher.time - begun, host.poses)
    done = any(isinstance(e, Committed) and str(edge) in e.operations for e in events)
    refused = next((e.reasons for e in events if isinstance(e, OperationRefused)), ())
    after = sensed_values(dispatcher.standing.scene)
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


def _hazard(blueprint: Blueprint, after: Facts, configuration: Mapping[str, str]) -> str:
    """Return the first hazard that holds in these facts. Facts that nobody senses are believed."""
    facts: dict[tuple[str, int], str | None] = dict(flags(blueprint, configuration))
    facts |= {key: after[text] for key in facts if (text := f"{key[0]}/{key[1]}") in after}
    for one in guard_hazards(blueprint):
        if all(facts.get(key) == value for key, value in one.facts):
            return one.name
    return ""
