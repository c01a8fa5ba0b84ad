"""The dispatcher: it carries out one D-SFO step at a time, chosen by a person or by the plan.

``tick`` carries out the waiting commands first. Then it makes one host tick if something is carried
out or the world is live, or else proposes the next operation. If a command begins or resumes an
operation, this tick makes no host tick: so other commands can come while the operation runs, even
if it takes one tick. ``docs/supervision.md`` draws the run states. Nothing here reads a clock or a
file, or starts a thread.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import Scene
from smsl_studio.blueprint.hazards import guard_hazards
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.drive.driver import Driver
from smsl_studio.dispatch.drive.generation import EdgeProposer
from smsl_studio.dispatch.drive.review import Reviewer
from smsl_studio.dispatch.drive.start import begin_run
from smsl_studio.dispatch.drive.supervisor import Supervisor
from smsl_studio.dispatch.drive.terms import USUAL, RunTerms
from smsl_studio.dispatch.execution.stage import RUNNING
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.dispatch.route.course import Course
from smsl_studio.dispatch.status_now import Standing, look, look_at_nothing, stand
from smsl_studio.dispatch.supervision.departure import leave
from smsl_studio.dispatch.supervision.obedience import obey, refuse
from smsl_studio.dispatch.supervision.row import Command, in_order
from smsl_studio.dispatch.supervision.table import Commands
from smsl_studio.errors import HostError, RunRefused
from smsl_studio.host.protocol import Host, OpenedWorld
from smsl_studio.runlog.ends import BROKEN_OFF, UNBEGUN
from smsl_studio.runlog.events import Event, Held, RunFinished
from smsl_studio.runlog.phase import phase_at_end
from smsl_studio.stop import BrokenOff, Stopped, restartable


class Dispatcher(Commands):
    """Runs one blueprint on one host.

    ``terms`` are settled before the run. ``levels`` say who acts, senses, inspects and supervises;
    by default the blueprint declares them. ``supervisor`` is asked before every operation, after
    all guards. ``someone`` says whether anybody will answer questions; by default this is so in an
    attended run.

    Commands are taken while the run is open. The record of a finished run takes none.
    """

    def __init__(
        self,
        blueprint: Blueprint,
        host: Host,
        terms: RunTerms = USUAL,
        *,
        levels: Levels | None = None,
        supervisor: Supervisor | None = None,
        someone: Callable[[], bool] | None = None,
    ) -> None:
        self.host = host
        self._waiting: list[Command] = []
        self._blueprint, self._terms = blueprint, terms
        self._reviewer = Reviewer(supervisor, terms.foresight)
        self._levels, self._someone = levels, someone
        self._leaving = False
        self._driver: Driver | None = None
        self._ended: RunFinished | None = None
        self._status: DispatchStatus | None = None

    def take(self, command: Command) -> None:
        """Keep a command for the next tick. Each row of ``Commands`` is a method that calls
        this.
        """
        self._waiting.append(command)

    @property
    def waiting(self) -> tuple[Command, ...]:
        """The commands that wait for the next tick, in the order in which they came."""
        return tuple(self._waiting)

    @property
    def under_way(self) -> Address | None:
        """The edge whose function goes on at the next tick. None if no function does."""
        driver = self._driver
        if driver is None or self._ended is not None or driver.state.frozen:
            return None
        carrier = driver.carrier
        return carrier.running if carrier is not None and carrier.stage is RUNNING else None

    # the run ------------------------------------------------------------------------------------

    def open(self) -> tuple[Event, ...]:
        """Open the host and check the start. Return the first events; a refusal ends in
        ``run_finished``.

        WorldError and PluginError if the world cannot be built at all.
        """
        try:
            terms = self._terms
            hazards = guard_hazards(self._blueprint) if terms.guarded else ()
            run, goals = begin_run(self._blueprint, self.host, terms, self._levels, hazards)
            avoid = dict.fromkeys(terms.avoid, "avoided")
            course = Course(run.hierarchy, goals, run.bound, avoid, hazards)
            self._driver = Driver(run, course, self._reviewer, terms, self._someone)
            self._driver.starting.go_on()
        except RunRefused as refused:
            return self._end("refused", refused.words, refusals=refused.told)
        except HostError as error:
            return self._host_gone(error)
        return self._drain()

    def tick(self) -> tuple[Event, ...]:
        """Make one step, and return its events: commands first, then one host tick or the next
        proposal.

        Steps that may last, such as a long plan, heed the listener (see ``stop``). If the step is
        called off, the events so far are returned, and the next tick goes on.
        """
        driver = self._driver
        if driver is None or self._ended is not None:
            return ()
        try:
            set_going = False
            if self._waiting:
                stood = self.under_way is None
                commands, self._waiting = list(in_order(self._waiting)), []
                try:
                    obey(driver, commands)
                finally:
                    self._waiting[:0] = commands
                driver.arrival.forget()
                set_going = stood and self.under_way is not None
            if self._leaving and driver.ended is None:
                leave(driver)
            if driver.ended is None and not set_going:
                driver.go_on()
        except HostError as error:
            return self._host_gone(error)
        except BrokenOff:
            raise
        except Stopped:
            return self._drain()
        if driver.ended is not None:
            self._ended = driver.ended
            driver.run.emit(driver.ended)
        self._status = None
        return driver.run.drain()

    def watch(self) -> tuple[Event, ...]:
        """Return the events of a run that stands still: the host may be lost, and remote sensors
        may have new readings.
        """
        driver = self._driver
        if driver is None or self.finished:
            return ()
        try:
            self.host.check()
        except HostError as error:
            return self._host_gone(error)
        if driver.run.opened.remote is None:
            return ()
        driver.run.emit(*driver.run.senses.listen())
        return self._drain()

    def leave(self) -> None:
        """Note that nobody attends the run any more. From the next tick on, the run ends if it
        waits.
        """
        self._leaving = True

    def break_off(self) -> tuple[Event, ...]:
        """End a run that was called off in the middle of a tick. Return the last events."""
        driver = self._driver
        if driver is None:
            return self._end("stopped", UNBEGUN)
        if self._ended is not None:
            return ()
        with suppress(HostError, Stopped):
            self.host.cancel("hold")
        return self._end("stopped", BROKEN_OFF)

    def close(self) -> None:
        """Free the host and the supervisor. A second call does nothing."""
        try:
            self._reviewer.close()
            if self._driver is not None:
                self._driver.generation.close()
            elif self._terms.proposer is not None:
                self._terms.proposer.close()
        finally:
            self.host.close()

    @property
    def proposer(self) -> EdgeProposer | None:
        """Who proposes edges where no way leads to the goals, None for nobody."""
        return self._driver.generation.proposer if self._driver else self._terms.proposer

    def propose_with(self, proposer: EdgeProposer | None) -> None:
        """Let this provider propose edges from now on, where no way leads to the goals. A run that
        holds asks it when it is resumed."""
        if self._driver is not None:
            self._driver.generation.ask_from_now_on(proposer)

    @property
    def opened(self) -> OpenedWorld | None:
        """The description of the opened world, None before it is open."""
        return self._driver.run.opened if self._driver else None

    @property
    def finished(self) -> bool:
        """Whether the run is over. Its last event was ``run_finished``."""
        return self._ended is not None

    @property
    def time(self) -> float:
        """The simulated time (s)."""
        return self._driver.run.time if self._driver else 0.0

    @property
    def phase(self) -> str:
        """The run state, one of ``runlog.phase.RUN_STATES``. After the end it is the last one."""
        if self._ended is not None:
            return phase_at_end(self._ended.reason)
        return self._driver.phase if self._driver else "idle"

    # views --------------------------------------------------------------------------------------

    @property
    def status(self) -> DispatchStatus:
        """The status of the run. It is the same object until something happens, or more is known.

        The search for routes may last and heeds the listener (see ``stop``). If it is called off,
        the status has what is known, and ``planning`` is true.
        """
        if self._status is None or self._status.planning:
            ended, driver = self._ended, self._driver
            with restartable():
                self._status = (
                    look(driver, self.phase, ended)
                    if driver
                    else look_at_nothing(self.phase, self._terms.goals, ended)
                )
        return self._status

    @property
    def standing(self) -> Standing:
        """The place of the run, without any planning."""
        ended, driver = self._ended, self._driver
        if driver is None:
            nothing = self.status
            return Standing(0.0, {}, Scene(), nothing.reason, nothing.sentence)
        return stand(driver, self.phase, ended)

    # the end ------------------------------------------------------------------------------------

    def _host_gone(self, error: HostError) -> tuple[Event, ...]:
        """End the run, because no library code can run any more. A hold with the reason comes
        first.
        """
        details = (error.advice,) if error.advice else ()
        held = Held(t=self.time, reason=error.sentence, details=details)
        return self._end("failed", error.sentence, held)

    def end_for(self, reason: str, sentence: str) -> RunFinished:
        """Return the event that would end the run now, for this reason."""
        run = self._driver.run if self._driver else None
        return RunFinished(
            t=self.time,
            reason=reason,
            sentence=sentence,
            operations=run.operations if run else 0,
            configuration=dict(run.configuration) if run else {},
        )

    def _end(
        self,
        reason: str,
        sentence: str,
        *before: Event,
        refusals: Sequence[Mapping[str, str]] = (),
    ) -> tuple[Event, ...]:
        """End the run outside the driver. Its waiting events come first."""
        self._ended = replace(self.end_for(reason, sentence), refusals=tuple(refusals))
        if self._driver is not None:
            refuse(self._driver, self._waiting, "the run is over")
            self._driver.let_go()
            self._driver.desk.withdraw()
        self._waiting = []
        return (*self._drain(), *before, self._ended)

    def _drain(self) -> tuple[Event, ...]:
        self._status = None
        return self._driver.run.drain() if self._driver is not None else ()
