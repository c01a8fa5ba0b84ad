"""The current status of a live run, as one frozen value."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple, TypeVar

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import Scene
from smsl_studio.dispatch.drive.driver import Driver
from smsl_studio.dispatch.execution.status import DispatchStatus, Possible
from smsl_studio.dispatch.route.planner import holds
from smsl_studio.dispatch.supervision.offers import offers
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import PlanningError
from smsl_studio.runlog.events import RunFinished
from smsl_studio.stop import BrokenOff, Stopped

Answer = TypeVar("Answer")


class Standing(NamedTuple):
    """The place of a run: the time (simulated s), the believed states, the sensed facts, and why
    the run has ended or holds.
    """

    time: float
    configuration: Mapping[str, str]
    scene: Scene
    reason: str
    sentence: str


def stand(driver: Driver, phase: str, ended: RunFinished | None) -> Standing:
    """Return the place of an opened run. Nothing is planned."""
    run, held = driver.run, driver.state.held
    reason = ended.reason if ended else held.kind if held else ""
    sentence = ended.sentence if ended else _sentence(driver, phase)
    return Standing(run.time, dict(run.configuration), run.senses.scene, reason, sentence)


def look(driver: Driver, phase: str, ended: RunFinished | None) -> DispatchStatus:
    """Return the status of an opened run.

    The search for routes may last and heeds the listener (see ``stop``). If it is called off, the
    status has what is known.
    """
    run, carrier, state = driver.run, driver.carrier, driver.state
    standing = stand(driver, phase, ended)
    sought = _Sought()
    route = sought(lambda: _route(driver, phase, ended), _begun(driver))
    possible: tuple[Possible, ...] = ()
    if not ended:
        possible, whole = driver.follower.outlook.known()
        sought.all &= whole
    detour = None
    if driver.attended and not ended:
        detour = sought(lambda: _detour(driver), None)
    held, shown = state.held, driver.generation.shown
    begun = carrier.uncommitted if carrier else ()
    candidates = driver.trouble.candidates if held is not None else ()
    if state.offered is not None:
        candidates = (state.offered,)
    return DispatchStatus(
        phase=phase,
        time=standing.time,
        configuration=standing.configuration,
        pending=dict(run.pending),
        running=carrier.running if carrier else None,
        carrying=carrier.step.asked.address if carrier else None,
        running_since=carrier.since if carrier and carrier.moving else None,
        progress=driver.follower.outlook.progress(carrier),
        route=route,
        goals=driver.course.goals,
        scene=standing.scene,
        check=None if ended else driver.follower.outlook.awaited(carrier),
        possible=tuple(_latched(driver, phase, possible)),
        candidates=candidates,
        reason=standing.reason,
        sentence=standing.sentence,
        operations=run.operations,
        details=tuple(held.details) if held else (),
        offers=offers(driver),
        tasks=driver.desk.tasks,
        detour=detour,
        since=dict(run.since),
        previous=dict(run.previous),
        sources=run.senses.sources,
        full_map=state.full_map,
        by=state.by,
        notes=() if ended else driver.follower.bypasses.sentences((*begun, *route)),
        planning=not sought.all,
        pausing=phase == "running" and (state.once or state.pausing),
        generated={edge: one.target for edge, one in driver.generation.made.items()},
        proposed=(shown.edge, shown.target) if shown is not None else None,
    )


class _Sought:
    """Asks questions that need the planner. ``all`` says whether every question was answered."""

    def __init__(self) -> None:
        self.all = True

    def __call__(self, question: Callable[[], Answer], otherwise: Answer) -> Answer:
        try:
            return question()
        except BrokenOff:
            raise
        except Stopped:
            self.all = False
            return otherwise


def _begun(driver: Driver) -> tuple[Address, ...]:
    """Return the remaining edges of the step that is carried out, and of the plan."""
    current = driver.carrier.remaining if driver.carrier else ()
    return (*(edge.address for edge in current), *driver.course.ahead)


def _route(driver: Driver, phase: str, ended: RunFinished | None) -> tuple[Address, ...]:
    """Return the edges still to be carried out."""
    route = _begun(driver)
    if driver.carrier is None and driver.desk.busy and not ended:
        following = driver.next_edge()
        if following is not None and following not in route[:1]:
            # The operation that people are asked about is still to be carried out, as the first
            # one.
            route = (following, *route)
    if not route and phase == "paused" and not holds(_here(driver), driver.course.goals):
        # An operation that was asked for by hand has no plan. The route after it is shown even so.
        route = driver.course.prospect(_here(driver))
    return route


def look_at_nothing(
    phase: str, goals: Sequence[Address], ended: RunFinished | None
) -> DispatchStatus:
    """Return the status before the world is open, or after the start was refused."""
    return DispatchStatus(
        phase=phase,
        time=0.0,
        configuration={},
        pending={},
        running=None,
        carrying=None,
        running_since=None,
        progress=None,
        route=(),
        goals=tuple(goals),
        scene=Scene(),
        check=None,
        possible=(),
        candidates=(),
        reason=ended.reason if ended else "",
        sentence=ended.sentence if ended else "",
        operations=0,
    )


def _latched(driver: Driver, phase: str, possible: Iterable[Possible]) -> Iterator[Possible]:
    """Yield every edge out of the active states. While the run is latched, none may be asked
    for.
    """
    latched = COMMANDS["ask"].why_refused(phase, driver.state.taken_over)
    for one in possible:
        if phase in ("stopped", "taken_over"):
            yield replace(one, permitted=False, reasons=(*one.reasons, latched))
        else:
            yield one


def _detour(driver: Driver) -> tuple[Address, ...] | None:
    """Return the route to the goals if the next operation was vetoed. None if there is none."""
    course = driver.course
    if driver.carrier is not None:
        following = course.ahead[0] if course.ahead else None
    else:
        following = driver.next_edge()
    if following is None:
        return None
    try:
        return course.detour(_here(driver), following)
    except PlanningError:
        return None


def _sentence(driver: Driver, phase: str) -> str:
    """Return the sentence about the run. It is the question if the run waits for an answer."""
    asked, said = driver.desk.sentence, driver.sentence
    return asked or said if phase == "waiting" else said or asked


def _here(driver: Driver) -> Mapping[str, str]:
    """Return the configuration of the run, or the one after the current step."""
    carrier = driver.carrier
    return {**driver.run.configuration, **(carrier.step.after if carrier else {})}
