"""Runs one edge alone in a world, from its source state, and checks sensed facts."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import Scene, state_check
from smsl_studio.blueprint.configuration import Hierarchy, flags
from smsl_studio.blueprint.hazards import guard_hazards, met_on_the_way
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.dispatch.execution.words import truth_word
from smsl_studio.dispatch.route.effort import refuse_too_large
from smsl_studio.dispatch.status_now import Standing
from smsl_studio.front.hosts import make_host
from smsl_studio.front.request import RunRequest
from smsl_studio.front.starts import start_for_edge
from smsl_studio.host.protocol import Host
from smsl_studio.library.loaded import Loaded
from smsl_studio.runlog.events import (
    Committed,
    EdgeSwept,
    Event,
    Mismatch,
    OperationEnded,
    OperationRefused,
    OperationRisky,
)
from smsl_studio.world.engines import TABLE


def try_edge(
    blueprint: Blueprint,
    edge: Address,
    world: str = TABLE,
    *,
    seed: int = 0,
    host: str = "process",
    stop_when: Callable[[], bool] | None = None,
    loaded: Loaded | None = None,
) -> EdgeSwept:
    """Run one edge alone, as a sweep does, and return its result. It is not recorded.

    ``stop_when`` is called before every tick; True brakes the world, and the edge does not pass.
    ``loaded`` are plugins that were found already (see ``make_host``). WorldError for a world that
    does not exist or does not suit the blueprint. RunRefused if the SUB_SBS have a cycle, or if the
    blueprint is too large to run.

    >>> try_edge(read("hanoi-2.json"), Address("SB1", "State_aa", "Op_1b")).passed
    True
    """
    hierarchy = Hierarchy(blueprint)
    refuse_too_large(hierarchy)
    place = make_host(RunRequest(blueprint, world, seed=seed, host=host), loaded)
    try:
        target = blueprint[edge.branch].table[edge.state][edge.operation]
        return edge_alone(hierarchy, place, edge, target, seed, stop_when)[0]
    finally:
        place.close()


def edge_alone(
    hierarchy: Hierarchy,
    host: Host,
    edge: Address,
    target: str,
    seed: int,
    stop_when: Callable[[], bool] | None = None,
) -> tuple[EdgeSwept, bool]:
    """Run one edge in a host. Return its result, and whether the host was lost."""
    if target not in hierarchy.blueprint[edge.branch].table:
        return _verdict(edge, sentence=f"its target {target} is no state"), False
    start = start_for_edge(hierarchy, edge)
    if start is None:
        words = f"no start agrees with {edge.branch} in {edge.state}"
        return _verdict(edge, sentence=words), False
    terms = RunTerms(start, seed=seed, automatic=False, guarded=False)
    dispatcher = Dispatcher(hierarchy.blueprint, host, terms)
    events, source = carried_out(hierarchy, dispatcher, host, edge, start, stop_when)
    at_end = dispatcher.standing
    done = any(isinstance(e, Committed) and str(edge) in e.operations for e in events)
    believed = {**start, **at_end.configuration}
    passed = done and dispatcher.phase == "ready"
    swept = EdgeSwept(
        t=at_end.time,
        address=str(edge),
        passed=passed,
        source=source,
        target=_truth(hierarchy, at_end.scene, believed, edge.branch, target),
        sentence="" if passed else _why(events, at_end.sentence),
        hazard=_hazard(hierarchy, start, edge, at_end),
    )
    return swept, at_end.reason == "failed"


def carried_out(
    hierarchy: Hierarchy,
    dispatcher: Dispatcher,
    host: Host,
    edge: Address,
    start: Mapping[str, str],
    stop_when: Callable[[], bool] | None = None,
) -> tuple[list[Event], str]:
    """Carry out one edge from its source. Return the events, and the truth of the source before."""
    events = list(dispatcher.open())
    source = "unknown"
    if not dispatcher.finished:
        host.suppose(edge)
        source = _truth(hierarchy, dispatcher.standing.scene, start, edge.branch, edge.state)
        dispatcher.ask(edge)
        events += dispatcher.tick()
        while dispatcher.phase == "running":
            if stop_when is not None and stop_when():
                dispatcher.stop()
            events += dispatcher.tick()
    return events, source


def _hazard(hierarchy: Hierarchy, start: Mapping[str, str], edge: Address, at_end: Standing) -> str:
    """Return the name of the first hazard that an edge meets on its way, as it is drawn, or at its
    end, as it is sensed. Empty if there is none.
    """
    hazards = guard_hazards(hierarchy.blueprint)
    if not hazards:
        return ""
    stepper = Stepper(hierarchy, Terms(failing=None))
    known = stepper.edges.get(edge)
    step = stepper.step(start, known) if known is not None else None
    drawn = met_on_the_way(hazards, start, step) if isinstance(step, JointStep) else ()
    names = {one.name for one in drawn}
    readings, facts = at_end.scene.readings, flags(hierarchy.blueprint, at_end.configuration)
    for key, one in readings.items():
        facts[key] = one.value or ""
    names |= {one.name for one in hazards if all(facts[k] == value for k, value in one.facts)}
    return next((one.name for one in hazards if one.name in names), "")


def _truth(
    hierarchy: Hierarchy, scene: Scene, believed: Mapping[str, str], branch: str, state: str
) -> str:
    if not scene.readings:
        return "unknown"
    check = state_check(hierarchy.blueprint, branch, state, scene, {**believed, branch: state})
    return truth_word(check.truth)


def _why(events: Sequence[Event], sentence: str) -> str:
    """Return the best explanation of a failure: a refusal, messages of the run, sensed facts."""
    for event in events:
        if isinstance(event, OperationRefused):
            return "; ".join(event.reasons)
    said = [e.message for e in events if isinstance(e, OperationEnded) and e.message]
    said += [e.reason for e in events if isinstance(e, OperationRisky) and e.reason not in said]
    read = [fact for e in events if isinstance(e, Mismatch) for fact in e.facts]
    return "; ".join(dict.fromkeys([*said, *([sentence] if sentence else []), *read[:3]]))


def _verdict(edge: Address, sentence: str) -> EdgeSwept:
    return EdgeSwept(
        t=0.0,
        address=str(edge),
        passed=False,
        source="unknown",
        target="unknown",
        sentence=sentence,
    )
