"""Looking at a run: how it stands now, as one frozen value."""

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
    """Where a run stands: the time (s), where every SB is believed, the facts as they are sensed,
    and why it ended or holds.
    """

    time: float
    configuration: Mapping[str, str]
    scene: Scene
    reason: str
    sentence: str


def stand(driver: Driver, phase: str, ended: RunFinished | None) -> Standing:
    """Where an opened run stands; nothing is planned for it."""
    run, held = driver.run, driver.state.held
    reason = ended.reason if ended else held.kind if held else ""
    sentence = ended.sentence if ended else _sentence(driver, phase)
    return Standing(run.time, dict(run.configuration), run.senses.scene, reason, sentence)


def look(driver: Driver, phase: str, ended: RunFinished | None) -> DispatchStatus:
    """How an opened run stands.

    It asks for routes, which may last, and heeds (see ``stop``): called off, it shows what is
    known.
    """
    run, carrier, state = driver.run, driver.carrier, driver.state
    standing = stand(driver, phase, ended)
    sought = _Sought()
    route = sought(lambda: _route(driver, phase, ended), _begun(driver))
    possible: tuple[Possible, ...] = ()
    if not ended:
        possible, whole = driver.outlook.known()
        sought.all &= whole
    detour = None
    if driver.attended and not ended:
        detour = sought(lambda: _detour(driver), None)
    held = state.held
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
        progress=driver.outlook.progress(carrier),
        route=route,
        goals=driver.course.goals,
        scene=standing.scene,
        check=None if ended else driver.outlook.awaited(carrier),
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
        notes=() if ended else driver.bypasses.sentences((*begun, *route)),
        planning=not sought.all,
        pausing=phase == "running" and (state.once or state.pausing),
    )


class _Sought:
    """What is asked of the planner; ``all`` says whether all of it is known."""

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
    """What is left of the step that is carried out, and of the plan."""
    current = driver.carrier.remaining if driver.carrier else ()
    return (*(edge.address for edge in current), *driver.course.ahead)


def _route(driver: Driver, phase: str, ended: RunFinished | None) -> tuple[Address, ...]:
    """The edges still to be carried out."""
    route = _begun(driver)
    if driver.carrier is None and driver.desk.busy and not ended:
        following = driver.next_edge()
        if following is not None and following not in route[:1]:
            # What people are asked about is still to be carried out, and first.
            route = (following, *route)
    if not route and phase == "paused" and not holds(_here(driver), driver.course.goals):
        # What was asked for by hand has no plan behind it; one sees what would come all the same.
        route = driver.course.prospect(_here(driver))
    return route


def look_at_nothing(
    phase: str, goals: Sequence[Address], ended: RunFinished | None
) -> DispatchStatus:
    """Before the world stands, or where a guard of the start said no."""
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
    """Every edge out of the active states; none may be asked for while the run is latched."""
    latched = COMMANDS["ask"].why_refused(phase, driver.state.taken_over)
    for one in possible:
        if phase in ("stopped", "taken_over"):
            yield replace(one, permitted=False, reasons=(*one.reasons, latched))
        else:
            yield one


def _detour(driver: Driver) -> tuple[Address, ...] | None:
    """The way to the goals if the next operation were vetoed."""
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
    """What is the matter: what people are asked, where that is what the run waits for."""
    asked, said = driver.desk.sentence, driver.sentence
    return asked or said if phase == "waiting" else said or asked


def _here(driver: Driver) -> Mapping[str, str]:
    """Where the run stands, or will when what it carries out has ended."""
    carrier = driver.carrier
    return {**driver.run.configuration, **(carrier.step.after if carrier else {})}
