"""The dispatcher: one D-SFO step at a time, as a person or the plan would have it.

::

    ready ──ask, step──▶ running ──done──▶ ready       by hand: the world lives while it waits
    running ──pause──▶ paused ──resume, step, ask──▶ running      simulated time stands still
    running ──failure, mismatch──▶ held ──resume, adopt, ask──▶ running
    any ──stop, goal reached, no route, refused, host gone──▶ finished

``tick`` makes one host tick when something runs, otherwise it proposes the next operation.
Commands take effect at the next tick. Nothing here reads a clock or a file or starts a thread.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from types import MappingProxyType

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import Scene
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.course import Course
from smsl_studio.dispatch.driver import Driver
from smsl_studio.dispatch.guards import Supervisor
from smsl_studio.dispatch.pace import Pace
from smsl_studio.dispatch.start import begin_run, start_events
from smsl_studio.dispatch.status import DispatchStatus
from smsl_studio.dispatch.trouble import Trouble
from smsl_studio.errors import HostError, RunRefused
from smsl_studio.host.protocol import Host, Opened
from smsl_studio.runlog.events import Event, Held, RunFinished

NOWHERE: Mapping[str, str] = MappingProxyType({})


class Dispatcher:
    """Runs one blueprint on one host.

    ``start`` names the state of an SB, ``goals`` are states; ``avoid`` are edges that neither
    routing nor a person may use. ``on_mismatch``: ``hold`` waits for a person, ``adopt`` goes on
    from the one configuration the scene agrees with. ``attended`` says whether someone is there
    to decide; where nobody is (by default in an automatic run), a hold ends the run.
    """

    def __init__(
        self,
        blueprint: Blueprint,
        host: Host,
        *,
        start: Mapping[str, str] = NOWHERE,
        goals: Sequence[Address] = (),
        seed: int = 0,
        avoid: Collection[Address] = (),
        on_mismatch: str = "hold",
        automatic: bool = True,
        attended: bool | None = None,
        supervisor: Supervisor | None = None,
    ) -> None:
        self.host = host
        self._blueprint = blueprint
        self._start, self._goals, self._seed = dict(start), tuple(goals), seed
        self._avoid = dict.fromkeys(avoid, "avoided")
        self._adopts = on_mismatch == "adopt"
        self._automatic = automatic
        self._attended = not automatic if attended is None else attended
        self._supervisor = supervisor
        self._driver: Driver | None = None
        self._commands: list[Callable[[Driver], None]] = []
        self._ended: RunFinished | None = None
        self._status: DispatchStatus | None = None

    # the run ------------------------------------------------------------------------------------

    def open(self) -> tuple[Event, ...]:
        """Open the host and ask the guards of the start; a refusal ends in ``run_finished``.

        WorldError and PluginError where the world cannot be built at all.
        """
        try:
            run, goals = begin_run(self._blueprint, self.host, self._start, self._goals)
            course = Course(run.hierarchy, goals, run.opened.bound, self._avoid)
            self._driver = Driver(
                run,
                course,
                Pace(by_hand=not self._automatic),
                Trouble(run, course, self._adopts),
                supervisor=self._supervisor,
                attended=self._attended,
            )
            run.emit(*start_events(run, self._seed, goals))
        except RunRefused as refused:
            return self._end("refused", f"{refused.sentence}. {refused.advice}".strip())
        except HostError as error:
            return self._host_gone(error)
        return self._drain()

    def tick(self) -> tuple[Event, ...]:
        """One step: commands first, then one host tick or the next proposal; what happened."""
        driver = self._driver
        if driver is None or self.finished:
            return ()
        try:
            commands, self._commands = self._commands, []
            for command in commands:
                if not driver.reason:
                    command(driver)
            if not driver.reason:
                driver.go_on()
        except HostError as error:
            return self._host_gone(error)
        return self._drain()

    def close(self) -> None:
        """Free the host; calling it twice is harmless."""
        self.host.close()

    @property
    def opened(self) -> Opened | None:
        """What the host said when its world stood; None before, and where it never stood."""
        return self._driver.run.opened if self._driver else None

    @property
    def finished(self) -> bool:
        return self._ended is not None or bool(self._driver and self._driver.reason)

    @property
    def time(self) -> float:
        """Simulated seconds."""
        return self._driver.run.time if self._driver else 0.0

    @property
    def phase(self) -> str:
        """``ready``, ``running``, ``paused``, ``held`` or ``finished``: see the drawing above."""
        if self.finished:
            return "finished"
        return self._driver.phase if self._driver else "ready"

    # commands -----------------------------------------------------------------------------------

    def ask(self, address: Address) -> None:
        """Carry out one operation that a person chose; refused with every reason otherwise."""
        self._commands.append(lambda driver: driver.ask(address))

    def pause(self) -> None:
        """Hold now, or as the running operation declares (finish it, abort it)."""
        self._commands.append(Driver.pause)

    def resume(self) -> None:
        """Go on: after a pause, after a hold (the scene is read again), by hand automatically."""
        self._commands.append(Driver.resume)

    def step(self) -> None:
        """Carry out one operation of the route, then pause."""
        self._commands.append(Driver.step)

    def stop(self) -> None:
        """Brake and end the run."""
        self._commands.append(Driver.stop)

    def adopt(self) -> None:
        """While held: go on from the one configuration the scene agrees with."""
        self._commands.append(Driver.adopt)

    def prune(self, address: Address, reason: str) -> None:
        """Shut an edge out; if it is being carried out, stop it."""
        self._commands.append(lambda driver: driver.prune(address, reason))

    def restore(self, address: Address) -> None:
        """Let a pruned, avoided or risky edge be used again."""
        self._commands.append(lambda driver: driver.restore(address))

    def set_automatic(self, automatic: bool) -> None:
        """Follow the route by itself, or wait to be asked."""
        self._commands.append(lambda driver: setattr(driver.pace, "by_hand", not automatic))

    # what is seen -------------------------------------------------------------------------------

    @property
    def status(self) -> DispatchStatus:
        """How the run stands now; the same object until something happens."""
        if self._status is None:
            self._status = self._look() if self._driver else self._nothing()
        return self._status

    def _look(self) -> DispatchStatus:
        driver = self._driver
        assert driver is not None
        run, carrier, over = driver.run, driver.carrier, self.finished
        current = carrier.remaining if carrier else ()
        ended = self._ended.reason if self._ended else driver.reason
        return DispatchStatus(
            phase=self.phase,
            time=run.time,
            configuration=dict(run.configuration),
            pending=dict(run.pending),
            running=carrier.running if carrier else None,
            carrying=carrier.step.asked.address if carrier else None,
            running_since=carrier.since if carrier and carrier.moving else None,
            progress=driver.outlook.progress(carrier),
            route=(*(edge.address for edge in current), *driver.course.ahead),
            goals=driver.course.goals,
            scene=run.senses.scene,
            check=None if over else driver.outlook.awaited(carrier),
            possible=() if over else driver.outlook.possible(),
            candidates=driver.trouble.candidates if driver.pace.held else (),
            reason=ended or ("held" if driver.pace.held else ""),
            sentence=self._ended.sentence if self._ended else driver.sentence,
            operations=run.operations,
        )

    def _nothing(self) -> DispatchStatus:
        """Before the world stands, or where a guard of the start said no."""
        return DispatchStatus(
            phase=self.phase,
            time=0.0,
            configuration={},
            pending={},
            running=None,
            carrying=None,
            running_since=None,
            progress=None,
            route=(),
            goals=self._goals,
            scene=Scene(),
            check=None,
            possible=(),
            candidates=(),
            reason=self._ended.reason if self._ended else "",
            sentence=self._ended.sentence if self._ended else "",
            operations=0,
        )

    # the end ------------------------------------------------------------------------------------

    def _host_gone(self, error: HostError) -> tuple[Event, ...]:
        """The run holds with the reason; where library code runs no more, that is its end."""
        details = (error.advice,) if error.advice else ()
        held = Held(t=self.time, reason=error.sentence, details=details)
        return self._end("failed", error.sentence, held)

    def _end(self, reason: str, sentence: str, *before: Event) -> tuple[Event, ...]:
        """End outside the driver; what it had to tell comes first."""
        run = self._driver.run if self._driver else None
        self._ended = RunFinished(
            t=self.time,
            reason=reason,
            sentence=sentence,
            operations=run.operations if run else 0,
            configuration=dict(run.configuration) if run else {},
        )
        if self._driver is not None:
            self._driver.carrier = None
        return (*self._drain(), *before, self._ended)

    def _drain(self) -> tuple[Event, ...]:
        self._status = None
        if self._driver is None:
            return ()
        events, self._driver.run.events = tuple(self._driver.run.events), []
        return events
