"""The dispatcher: one step of the run at each tick, chosen by the plan or by a person.

``tick`` carries out the waiting commands first. Then it makes one tick of the world if something is
carried out or the world is live, or else proposes the next operation. Nothing here reads a clock or
a file, or starts a thread.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from .carrier import RUNNING
from .commands import PERSON, Command, obey, refuse
from .course import Course
from .driver import Driver, RunTerms
from .elements import AUTOMATIC, Blueprint
from .errors import RunRefused, WorldGone
from .events import Event, event
from .goals import Goal, goals_of
from .hazards import met_words
from .hierarchy import Hierarchy, start_configuration
from .latches import leave
from .levels import Levels
from .live import LiveRun
from .people import Task
from .supervisor import Reviewer, RiskLimit, Supervisor
from .world import Host, TableWorld, World


class Dispatcher:
    """Runs one blueprint in one world.

    ``start`` and ``goals`` have a state for some SBs. ``avoid`` are operations that nobody may
    begin. ``levels`` replace those of the blueprint. ``supervisor`` is asked before every
    operation, after all guards. Call ``open`` once, then ``tick`` until ``finished``; both return
    events.
    """

    def __init__(
        self,
        blueprint: Blueprint,
        world: World | None = None,
        *,
        start: Mapping[str, str] | None = None,
        goals: Sequence[Goal] = (),
        avoid: Iterable[str] = (),
        levels: Mapping[str, str] | None = None,
        terms: RunTerms | None = None,
        supervisor: Supervisor | None = None,
    ) -> None:
        self.blueprint = blueprint
        self._host = Host(world or TableWorld(blueprint))
        self._start, self._goals, self._avoid = dict(start or {}), tuple(goals), tuple(avoid)
        self.levels = Levels(blueprint, levels or {})
        self._terms = terms or RunTerms()
        if supervisor is None and self.levels.supervision == AUTOMATIC:
            supervisor = RiskLimit()
        self.supervisor = supervisor
        self._waiting: list[Command] = []
        self._driver: Driver | None = None
        self._leaving = False
        self.last: Event | None = None
        """The event ``run_finished``, when the run is over."""

    # the run -------------------------------------------------------------------------------------

    def open(self) -> list[Event]:
        """Check the start and begin. A refusal ends in ``run_finished``."""
        try:
            run, goals = self._begun()
            course = Course(run.hierarchy, goals, self._avoid, run.hazards)
            self._driver = Driver(run, course, Reviewer(self.supervisor), self._terms)
            self._driver.start()
        except RunRefused as refused:
            return self._end("refused", refused.words, refused.refusals)
        except WorldGone as error:
            return self._world_gone(error)
        return self._drain()

    def _begun(self) -> tuple[LiveRun, tuple[Goal, ...]]:
        hierarchy = Hierarchy(self.blueprint)
        configuration = start_configuration(hierarchy, self._start)
        meets = self.blueprint.meets
        hazards = [one for one in self.blueprint.hazards if meets(one, configuration)]
        if hazards:
            raise RunRefused(
                f"the start meets a hazard: {'; '.join(met_words(hazards))}",
                "Start where its facts do not hold together.",
            )
        goals = goals_of(hierarchy, self._goals)
        self._host.world.begin(configuration)
        return LiveRun(hierarchy, self._host, self.levels, configuration, self._terms.seed), goals

    def tick(self) -> list[Event]:
        """Make one step: commands first, then one tick of the world or the next proposal."""
        driver = self._driver
        if driver is None or self.finished:
            return []
        try:
            set_going = self._obey(driver)
            if self._leaving and driver.ended is None:
                leave(driver)
            if driver.ended is None and not set_going:
                driver.go_on()
        except WorldGone as error:
            return self._world_gone(error)
        if driver.ended is not None:
            self.last = driver.ended
            driver.run.hear([driver.ended])
        return self._drain()

    def _obey(self, driver: Driver) -> bool:
        """Carry out the waiting commands. Return whether one has set an operation going: then this
        tick makes none of the world, so that other commands can come while the operation runs.
        """
        if not self._waiting:
            return False
        stood = not self.under_way
        commands, self._waiting = self._waiting, []
        obey(driver, commands)
        driver.arrival.forget()
        return stood and self.under_way

    @property
    def under_way(self) -> bool:
        """Whether a function goes on at the next tick."""
        driver = self._driver
        if driver is None or self.finished or driver.state.frozen:
            return False
        return driver.carrier is not None and driver.carrier.stage == RUNNING

    @property
    def carrying(self) -> bool:
        """Whether an operation is carried out."""
        return self._driver is not None and self._driver.carrier is not None

    @property
    def finished(self) -> bool:
        """Whether the run is over."""
        return self.last is not None

    @property
    def time(self) -> float:
        """Simulated seconds."""
        return self._host.time

    @property
    def phase(self) -> str:
        """The run state in one word, such as ``running`` or ``paused``."""
        return "done" if self.finished else self._driver.phase if self._driver else "idle"

    @property
    def configuration(self) -> dict[str, str]:
        """The active state of every SB, as far as it is committed."""
        return dict(self._driver.run.configuration) if self._driver else {}

    @property
    def tasks(self) -> list[Task]:
        """The open questions to people."""
        return self._driver.desk.open if self._driver else []

    # commands ------------------------------------------------------------------------------------

    def command(self, word: str, by: str = PERSON, **said: Any) -> None:
        """Give a command (see ``commands.TABLE``). It waits for the next tick."""
        self._waiting.append(Command(word, by, said))

    def stop(self, by: str = PERSON) -> None:
        """Brake and latch at the next tick."""
        self.command("stop", by)

    def leave(self) -> None:
        """Note that nobody attends the run any more: it ends if it waits."""
        self._leaving = True

    # the end -------------------------------------------------------------------------------------

    def _world_gone(self, error: WorldGone) -> list[Event]:
        details = [error.advice] if error.advice else []
        held = {"reason": error.sentence, "details": details, "kind": "held"}
        return self._end("failed", error.sentence, before=[event("held", self.time, **held)])

    def _end(
        self,
        reason: str,
        sentence: str,
        refusals: Sequence[Mapping[str, str]] = (),
        before: Sequence[Event] = (),
    ) -> list[Event]:
        """End the run outside the driver. Its waiting events come first."""
        driver = self._driver
        if driver is None:
            self.last = unbegun(reason, sentence, refusals)
            return [*before, self.last]
        self.last = driver.end_of(reason, sentence, refusals)
        refuse(driver, self._waiting, "the run is over")
        driver.carrier = None
        driver.desk.withdraw()
        self._waiting = []
        return [*self._drain(), *before, self.last]

    def _drain(self) -> list[Event]:
        return self._driver.run.drain() if self._driver else []


def unbegun(reason: str, sentence: str, refusals: Sequence[Mapping[str, str]] = ()) -> Event:
    """Return the last event of a run that has not begun."""
    more = {"refusals": list(refusals)} if refusals else {}
    said = {"reason": reason, "sentence": sentence, "operations": 0, "configuration": {}}
    return event("run_finished", 0.0, **said, **more)
