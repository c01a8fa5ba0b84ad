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

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import CheckResult, Scene
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.stepper import Unavailable
from smsl_studio.dispatch.carrier import Carrier, Failure, Stage
from smsl_studio.dispatch.course import Course
from smsl_studio.dispatch.guards import Supervisor, refusals
from smsl_studio.dispatch.outlook import Outlook
from smsl_studio.dispatch.planner import holds
from smsl_studio.dispatch.recovery import candidates, stands, sub_relocalised
from smsl_studio.dispatch.run import Run
from smsl_studio.dispatch.start import begin_run, start_events
from smsl_studio.dispatch.status import DispatchStatus, Possible
from smsl_studio.dispatch.words import all_words, check_words
from smsl_studio.errors import AddressError, HostError, RunRefused
from smsl_studio.host.protocol import Host, Opened
from smsl_studio.runlog.events import (
    Event,
    GoalReached,
    Held,
    Mismatch,
    OperationEnded,
    OperationPruned,
    OperationRefused,
    OperationRestored,
    OperationRisky,
    Paused,
    Relocalised,
    Resumed,
    RoutePlanned,
    RunFinished,
)

NOWHERE: Mapping[str, str] = {}


class Dispatcher:
    """Runs one blueprint on one host.

    ``start`` names the state of an SB, ``goals`` are states; ``avoid`` are edges routing and
    people must not use. ``on_mismatch``: ``hold`` waits for a person, ``adopt`` goes on from the
    one configuration the scene agrees with. ``attended`` says whether someone is there to decide;
    where nobody is (by default in an automatic run), a hold ends the run.
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
        self._by_hand = not automatic
        self._attended = self._by_hand if attended is None else attended
        self._supervisor = supervisor
        self._run: Run | None = None
        self._course: Course | None = None
        self._outlook: Outlook | None = None
        self._carrier: Carrier | None = None
        self._commands: list[Callable[[], None]] = []
        self._early: list[Event] = []
        self._told: set[Address] = set()
        self._candidates: tuple[Mapping[str, str], ...] = ()
        self._broken_since: float | None = None
        self._paused = self._pausing = self._frozen = self._once = False
        self._held = self._reason = self._sentence = ""
        self._status: DispatchStatus | None = None

    # the run ------------------------------------------------------------------------------------

    def open(self) -> tuple[Event, ...]:
        """Open the host and ask the guards of the start; a refusal ends in ``run_finished``.

        WorldError and PluginError where the world cannot be built at all.
        """
        try:
            self._run, goals = begin_run(self._blueprint, self.host, self._start, self._goals)
            run = self._run
            self._course = Course(run.hierarchy, goals, run.opened.bound, self._avoid)
            self._outlook = Outlook(run, self._course)
            run.emit(*start_events(run, self._seed, goals))
        except RunRefused as refused:
            self._finish("refused", f"{refused.sentence}. {refused.advice}".strip())
        except HostError as error:
            self._host_gone(error)
        return self._drain()

    def tick(self) -> tuple[Event, ...]:
        """One step: commands first, then one host tick or the next proposal; what happened."""
        if self._reason:
            return ()
        try:
            commands, self._commands = self._commands, []
            for command in commands:
                if not self._reason:
                    command()
            if not self._reason:
                self._go_on()
        except HostError as error:
            self._host_gone(error)
        return self._drain()

    def close(self) -> None:
        """Free the host; calling it twice is harmless."""
        self.host.close()

    @property
    def opened(self) -> Opened | None:
        """What the host said when its world stood; None before, and where a guard refused."""
        return self._run.opened if self._run else None

    @property
    def finished(self) -> bool:
        return bool(self._reason)

    @property
    def time(self) -> float:
        """Simulated seconds."""
        return self._run.time if self._run else 0.0

    @property
    def phase(self) -> str:
        """``ready``, ``running``, ``paused``, ``held`` or ``finished``: see the class's drawing."""
        if self._reason:
            return "finished"
        if self._carrier is not None and not self._frozen:
            return "running"
        if self._held:
            return "held"
        if self._paused or self._frozen:
            return "paused"
        return "ready" if self._by_hand else "running"

    # commands -----------------------------------------------------------------------------------

    def ask(self, address: Address) -> None:
        """Carry out one operation that a person chose; refused with every reason otherwise."""
        self._command(lambda: self._ask(address))

    def pause(self) -> None:
        """Hold now, or as the running operation declares (finish it, abort it)."""
        self._command(self._pause)

    def resume(self) -> None:
        """Go on: after a pause, after a hold (the scene is read again), by hand automatically."""
        self._command(self._resume)

    def step(self) -> None:
        """Carry out one operation of the route, then pause."""
        self._command(self._step)

    def stop(self) -> None:
        """Brake and end the run."""
        self._command(self._stop)

    def adopt(self) -> None:
        """While held: go on from the one configuration the scene agrees with."""
        self._command(self._adopt)

    def prune(self, address: Address, reason: str) -> None:
        """Shut an edge out; if it is being carried out, stop it."""
        self._command(lambda: self._prune(address, reason))

    def restore(self, address: Address) -> None:
        """Let a pruned, avoided or risky edge be used again."""
        self._command(lambda: self._restore(address))

    def set_automatic(self, automatic: bool) -> None:
        """Follow the route by itself, or wait to be asked."""
        self._command(lambda: setattr(self, "_by_hand", not automatic))

    def _command(self, command: Callable[[], None]) -> None:
        self._commands.append(command)

    def _ask(self, address: Address) -> None:
        run, course = self._its_run, self._its_course
        reasons: tuple[str, ...] = ()
        step: JointStep | Unavailable | None = None
        try:
            edge = course.edge(self._blueprint.resolve(address))
        except AddressError as error:
            edge, reasons = None, (error.sentence,)
        if self._carrier is not None:
            reasons = (f"{self._carrier.step.asked} is being carried out",)
        elif self.phase == "running":
            reasons = ("the run is automatic, pause it first",)
        elif edge is None:
            reasons = reasons or (f"{address} is no operation",)
        elif run.configuration[edge.branch] != edge.source:
            reasons = (f"{edge.branch} is in {run.configuration[edge.branch]}, not {edge.source}",)
        else:
            run.look()
            step = course.asked(run.configuration, edge)
            reasons = (
                step.reasons
                if isinstance(step, Unavailable)
                else refusals(run, step, self._supervisor)
            )
        if reasons or not isinstance(step, JointStep):
            run.emit(OperationRefused(t=run.time, address=str(address), reasons=reasons))
            return
        course.drop_plan()
        self._paused = self._paused or (bool(self._held) and not self._by_hand)
        self._begin(step)

    def _pause(self) -> None:
        carrier = self._carrier
        if self.phase in ("paused", "held"):
            return
        if carrier is not None and carrier.moving and carrier.bound.stop != "hold":
            self._pausing = True
            if carrier.bound.stop == "abort":
                carrier.abort("abort", "it was paused and cannot be held")
            return
        self._now_paused()

    def _now_paused(self) -> None:
        self._paused, self._pausing, self._frozen = True, False, self._carrier is not None
        self._its_run.emit(Paused(t=self.time))

    def _resume(self) -> None:
        self._broken_since = None
        if self.phase == "ready":
            self._by_hand = False
        self._once = self._paused = self._pausing = self._frozen = False
        self._its_run.emit(Resumed(t=self.time))
        self._reread()

    def _step(self) -> None:
        if self.phase == "running":
            return
        self._once, self._paused, self._frozen = True, False, False
        self._reread()

    def _reread(self) -> None:
        """After a hold the scene decides whether the run may go on."""
        if self._held:
            self._release()
            self._relocalise()

    def _stop(self) -> None:
        run, carrier = self._its_run, self._carrier
        if carrier is not None and carrier.stage is Stage.RUNNING:
            run.host.cancel("hold" if carrier.bound.stop == "finish" else carrier.bound.stop)
            address = str(carrier.action.edge)
            run.emit(OperationEnded(t=run.time, address=address, outcome="cancelled"))
        self._finish("stopped", "Stopped by a person.")

    def _adopt(self) -> None:
        if self._held and len(self._candidates) == 1:
            chosen = self._candidates[0]
            self._release()
            self._adopted(chosen)

    def _prune(self, address: Address, reason: str) -> None:
        self._its_course.prune(address, reason)
        self._its_run.emit(OperationPruned(t=self.time, address=str(address), reason=reason))
        if self._carrier is not None and self._carrier.running == address:
            self._carrier.abort("hold", f"it was pruned: {reason}")

    def _restore(self, address: Address) -> None:
        if self._its_course.restore(address):
            self._its_run.emit(OperationRestored(t=self.time, address=str(address)))

    # one step -----------------------------------------------------------------------------------

    def _go_on(self) -> None:
        if self.phase == "paused":
            return
        if self._carrier is not None:
            self._carry(self._carrier)
        elif self._held or (self._by_hand and not self._once):
            self._idle()
        else:
            self._propose()

    def _idle(self) -> None:
        """The world lives while a person thinks; integrity is watched (clause 9)."""
        run = self._its_run
        _, changes = run.senses.tick()
        run.emit(*changes)
        if not run.broken():
            self._broken_since = None
        elif self._broken_since is None:
            self._broken_since = run.time
        if self._held or self._broken_since is None:
            return
        if run.time - self._broken_since >= run.opened.settle:
            self._relocalise()

    def _propose(self) -> None:
        run, course = self._its_run, self._its_course
        self._tell_goals()
        if holds(run.configuration, course.goals):
            self._arrived()
            return
        step, leg = course.next_step(run.configuration)
        if leg is not None:
            operations = tuple(map(str, leg.operations))
            run.emit(
                RoutePlanned(t=run.time, goal=str(leg.goal), operations=operations, cost=leg.cost)
            )
        if step is None:
            self._no_way()
            return
        reasons = refusals(run, step, self._supervisor)
        if reasons:
            course.withdraw()
            run.emit(OperationRefused(t=run.time, address=str(step.asked), reasons=reasons))
            self._hold(f"{step.asked} cannot begin: {reasons[0]}", reasons)
            return
        self._begin(step)

    def _begin(self, step: JointStep) -> None:
        self._release()
        self._carrier = Carrier(self._its_run, step)
        self._carry(self._carrier)

    def _carry(self, carrier: Carrier) -> None:
        carrier.advance(self._its_course.shut)
        if carrier.stage is Stage.FAILED and carrier.failure is not None:
            self._carrier = None
            self._failed(carrier.step, carrier.failure)
        elif carrier.stage is Stage.DONE:
            self._carrier = None
            if self._its_run.broken():
                self._relocalise()
        if self._pausing and not carrier.moving and not self._reason:
            self._now_paused()
        if self._carrier is None and not self._reason:
            self._tell_goals()
            if self._once:
                self._once = False
                if not self._by_hand:
                    self._now_paused()

    def _tell_goals(self) -> None:
        """Goals count as reached in their order."""
        run = self._its_run
        for goal in self._its_course.goals:
            if not holds(run.configuration, [goal]):
                return
            if goal not in self._told:
                self._told.add(goal)
                run.emit(GoalReached(t=run.time, goal=str(goal)))

    def _arrived(self) -> None:
        if self._by_hand:
            self._once = False
            return
        goals = ", ".join(map(str, self._its_course.goals))
        self._finish("goal_reached", f"{goals} holds.")

    def _no_way(self) -> None:
        run, course = self._its_run, self._its_course
        risky = course.risky_way(run.configuration)
        goal = next(g for g in course.goals if not holds(run.configuration, [g]))
        if risky:
            names = ", ".join(map(str, risky))
            words = [f"{edge}: {course.risky[edge]}" for edge in risky]
            self._hold(f"Only risky operations lead to {goal}: {names}.", words)
            return
        here = ", ".join(f"{name}/{state}" for name, state in run.configuration.items())
        details = self._outlook.details() if self._outlook else ()
        self._hold(f"Nothing permitted leads from {here} to {goal}.", details, "no_route")

    # when things go wrong -----------------------------------------------------------------------

    def _failed(self, step: JointStep, failure: Failure) -> None:
        run = self._its_run
        if failure.risky:
            roots = [e for e in step.edges if e.branch in run.hierarchy.roots]
            for edge in dict.fromkeys((failure.edge, *roots)):
                self._its_course.tag_risky(edge.address, failure.reason)
                run.emit(OperationRisky(t=run.time, address=str(edge), reason=failure.reason))
        self._its_course.drop_plan()
        run.drop_pending()
        alone = None if failure.pending else sub_relocalised(run, failure.edge.branch)
        if alone is not None and not stands(run, run.configuration):
            self._adopted(alone)
            return
        self._relocalise(failure.reason)

    def _relocalise(self, cause: str = "") -> None:
        """Clauses 8 and 9: go on where the scene equals what is committed, else adopt or hold."""
        run = self._its_run
        run.drop_pending()
        run.look()
        if stands(run, run.configuration):
            run.emit(Relocalised(t=run.time, configuration=dict(run.configuration)))
            return
        checks = run.checks(run.configuration)
        facts = tuple(
            words for c in checks for words in all_words(run.blueprint, (*c.misses, *c.unknown))
        )
        self._candidates = candidates(run)
        run.emit(Mismatch(t=run.time, facts=facts, candidates=self._candidates))
        if self._adopts and len(self._candidates) == 1:
            self._adopted(self._candidates[0])
            return
        first = next(check for check in checks if check.truth is not True)
        self._hold(cause or check_words(run.blueprint, first), facts)

    def _adopted(self, configuration: Mapping[str, str]) -> None:
        run = self._its_run
        run.configuration.update(configuration)
        self._its_course.drop_plan()
        run.emit(Relocalised(t=run.time, configuration=dict(run.configuration)))

    def _hold(self, reason: str, details: Sequence[str], kind: str = "held") -> None:
        run = self._its_run
        self._held = self._sentence = reason
        self._once = False
        run.emit(Held(t=run.time, reason=reason, details=tuple(details)))
        if not self._attended:
            self._finish(kind, reason)

    def _release(self) -> None:
        self._held, self._candidates, self._broken_since = "", (), None
        if not self._reason:
            self._sentence = ""

    def _host_gone(self, error: HostError) -> None:
        held = Held(t=self.time, reason=str(error), details=(error.advice,) if error.advice else ())
        self._emit(held)
        self._finish("failed", str(error))

    def _finish(self, reason: str, sentence: str) -> None:
        self._reason, self._sentence = reason, sentence
        self._carrier = None
        configuration = dict(self._run.configuration) if self._run else {}
        operations = self._run.operations if self._run else 0
        self._emit(
            RunFinished(
                t=self.time,
                reason=reason,
                sentence=sentence,
                operations=operations,
                configuration=configuration,
            )
        )

    # what is seen -------------------------------------------------------------------------------

    @property
    def status(self) -> DispatchStatus:
        """How the run stands now; the same object until something happens."""
        if self._status is None:
            self._status = self._look_at()
        return self._status

    def _look_at(self) -> DispatchStatus:
        run, course, carrier = self._run, self._course, self._carrier
        possible: tuple[Possible, ...] = ()
        check: CheckResult | None = None
        if run is not None and self._outlook is not None and not self._reason:
            possible = self._outlook.possible()
            check = self._outlook.awaited(carrier)
        ahead = course.ahead if course is not None else ()
        current = carrier.remaining if carrier is not None else ()
        return DispatchStatus(
            phase=self.phase,
            time=self.time,
            configuration=dict(run.configuration) if run else {},
            pending=dict(run.pending) if run else {},
            running=carrier.running if carrier else None,
            carrying=carrier.step.asked.address if carrier else None,
            running_since=carrier.since if carrier and carrier.moving else None,
            progress=self._outlook.progress(carrier) if self._outlook else None,
            route=(*(edge.address for edge in current), *ahead),
            goals=course.goals if course else self._goals,
            scene=run.senses.scene if run else Scene(),
            check=check,
            possible=possible,
            candidates=self._candidates,
            reason=self._reason or ("held" if self._held else ""),
            sentence=self._sentence,
            operations=run.operations if run else 0,
        )

    # ---------------------------------------------------------------------------------------------

    @property
    def _its_run(self) -> Run:
        assert self._run is not None, "open the dispatcher first"
        return self._run

    @property
    def _its_course(self) -> Course:
        assert self._course is not None, "open the dispatcher first"
        return self._course

    def _emit(self, event: Event) -> None:
        if self._run is not None:
            self._run.emit(event)
        else:
            self._early.append(event)

    def _drain(self) -> tuple[Event, ...]:
        self._status = None
        events = tuple(self._early)
        self._early = []
        if self._run is not None:
            events = (*events, *self._run.events)
            self._run.events = []
        return events
