"""The driver: what a run does at each tick.

The dispatcher above it takes commands and returns events. The carrier below it carries out one
joint step. ``supervision`` has the effects of commands on the driver.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.levels import sensed_facts
from smsl_studio.dispatch.drive.admission import Admission
from smsl_studio.dispatch.drive.arrival import Arrival
from smsl_studio.dispatch.drive.generation import Generation
from smsl_studio.dispatch.drive.hazard_watch import HazardWatch
from smsl_studio.dispatch.drive.integrity import Integrity
from smsl_studio.dispatch.drive.loop_guard import REPEATS, LoopGuard
from smsl_studio.dispatch.drive.review import Reviewer
from smsl_studio.dispatch.drive.route_follower import RouteFollower
from smsl_studio.dispatch.drive.run_state import RunState
from smsl_studio.dispatch.drive.start_tasks import StartTasks
from smsl_studio.dispatch.drive.supervisor import PAUSE, TAKE_OVER
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.dispatch.execution.carrier import Carrier
from smsl_studio.dispatch.execution.desk import Desk
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.stage import ASKING, DONE, RUNNING, StepFailure
from smsl_studio.dispatch.execution.trouble import Hold, Trouble
from smsl_studio.dispatch.people.board import Closed
from smsl_studio.dispatch.route.course import Course
from smsl_studio.dispatch.route.planner import holds
from smsl_studio.errors import RunRefused
from smsl_studio.runlog.events import (
    Commanded,
    Held,
    Paused,
    RunFinished,
    TakenOver,
)


class Driver:
    """One opened run.

    ``ended`` is None until the run is over. ``sentence`` says why it ended or does not go on.
    ``attended`` says whether somebody can decide when the run holds. ``someone`` says whether
    anybody will answer questions; by default this is so in an attended run.
    """

    def __init__(
        self,
        run: LiveRun,
        course: Course,
        reviewer: Reviewer,
        terms: RunTerms,
        someone: Callable[[], bool] | None = None,
    ) -> None:
        self.run, self.course, self.reviewer = run, course, reviewer
        self.state = RunState(by_hand=not terms.automatic)
        self.trouble = trouble = Trouble(run, course, terms.adopts)
        self.loops = loops = LoopGuard(terms.visits)
        self.attended = terms.somebody_decides
        self.repeats = LoopGuard(REPEATS)
        self.desk = Desk(run, someone or (lambda: self.attended))
        self.starting = StartTasks(run, self.desk, self, terms.seed, course.goals, terms.findings)
        self.hazards = HazardWatch(run, self.state, trouble, self)
        self.integrity = Integrity(run, self.desk, trouble, self, self.hazards)
        self.admission = Admission(run, course, self.desk, reviewer, loops, self)
        self.follower = RouteFollower(run, course, trouble)
        self.carrier: Carrier | None = None
        self.ended: RunFinished | None = None
        self.sentence = ""
        self.arrival = Arrival(run, course.goals, self.integrity, trouble, self)
        self.generation = Generation(
            run, course, self.desk, reviewer, self.follower.pricing, terms.proposer
        )
        self._broken_since: float | None = None

    @property
    def phase(self) -> str:
        """The run state in one word, such as ``paused`` (see ``RunMode``)."""
        return self.state.phase_while(self.carrier is not None, self.desk.busy)

    # one tick -----------------------------------------------------------------------------------

    def go_on(self) -> None:
        """Make one host tick if something is carried out or the world is live, else the next
        proposal.
        """
        carrier, asking = self.carrier, self.desk.busy
        if carrier is not None and not (asking or self.state.frozen):
            self._carry(carrier)  # in every run state: what has begun goes on
            return
        phase = self.state.phase_while(carrier is not None, asking)
        if phase == "paused":
            self.run.emit(*self.run.senses.listen())
            return
        if asking and not self._outlived():
            self._wait(watched=phase == "waiting")
        elif carrier is not None:
            self._carry(carrier)
        elif not self.starting.over and phase in ("running", "ready"):
            self._start()
        elif phase == "running":
            self._propose()
        else:
            self._live(watched=phase == "ready")

    def _start(self) -> None:
        """Go on with the start, after something came between it and the answers it needs."""
        try:
            self.starting.go_on()
        except RunRefused as refused:
            self.finish("refused", refused.words, refused.told)

    def _wait(self, watched: bool) -> None:
        """Go on with the answers of people. Until they are complete, time passes in the world."""
        if self.desk.settled():
            return
        if self.carrier is None:
            self._live(watched)
        else:
            self._tick()
            self.carrier.watch()
            if self.carrier.stage is not ASKING:
                self.desk.withdraw()
                self._after(self.carrier)
                return
        self.desk.pass_time()
        self.desk.settled()

    def _outlived(self) -> bool:
        """Return whether people are asked about a step that has ended meanwhile. Then the questions
        are withdrawn.
        """
        if self.carrier is None or self.carrier.stage is ASKING:
            return False
        self.desk.withdraw()
        return True

    def _live(self, watched: bool) -> None:
        """Let time pass in the world while a person thinks. If ``watched``, check integrity (clause
        9).
        """
        run = self.run
        self.arrival.begin()
        self._tick()
        if self.endangered() or not watched or self._lost() or self.desk.keeps:
            return
        self.follower.pricing.ask()
        if self.arrival.moved and not self.desk.busy and self.arrival.open:
            self.arrival.look()
            return
        if not run.broken():
            self._broken_since = None
        elif self._broken_since is None:
            self._broken_since = run.time
        if self._broken_since is None:
            return
        if run.time - self._broken_since >= run.opened.settle:
            self.withdraw()
            self.hold(self.trouble.relocalise())

    def _tick(self) -> None:
        """Make one tick of the world and take in the samples of its sensors."""
        _, changes = self.run.senses.tick()
        self.run.emit(*changes)

    def _propose(self) -> None:
        if self.run.critical and self._lost():
            return
        if self.run.hazards and self.endangered():
            return
        if self.arrival.closing or self.arrival.open:
            self.arrival.begin()
            self._tick()
            self.arrival.look()
            return
        found = self.follower.next()
        if isinstance(found, Hold):
            self.hold(self.generation.sought(found))
        else:
            self.admission.admit(found)

    def _lost(self) -> bool:
        """Return whether the run has begun and now holds because a critical fact is lost."""
        return self.starting.told and self.integrity.lost()

    def endangered(self) -> bool:
        """Return whether the run has begun and now holds because a hazard is met."""
        return bool(self.run.hazards) and self.starting.told and self.hazards.holds()

    def begin(self, step: JointStep, chosen: bool) -> None:
        """Carry out a step from this tick on. All guards have agreed. ``chosen`` says that a person
        asked for it.
        """
        if chosen:
            self.course.drop_plan()
            self.loops.forget()
            self.reviewer.forget()
            self.follower.bypasses.tell((edge.address for edge in step.edges), again=True)
        else:
            self.loops.count(self.run.configuration, step.asked)
        self.state.begin(chosen)
        self._no_trouble()
        if self.desk.busy:
            self.desk.withdraw()
        self.carrier = Carrier(self.run, step)
        self._carry(self.carrier)

    def _carry(self, carrier: Carrier) -> None:
        if carrier.failure is None:
            carrier.advance(self.course.barred)
            if carrier.stage is RUNNING:
                if self.run.below is not None and self.run.below.holding:
                    self._below_holds(self.run.below.holding)
                return
        self._after(carrier)

    def _below_holds(self, why: str) -> None:
        """Pause, because the procedure of an operation holds and waits for a person."""
        if self.attended and not self.state.frozen:
            self.now_paused()
            self.say(why)

    def _after(self, carrier: Carrier) -> None:
        """Handle the new stage of a step, after a tick or an answer."""
        if carrier.stage is ASKING:
            nobody = self.desk.ask(carrier.wants, partial(self._answered, carrier))
            if nobody:
                carrier.unanswered(nobody)
        if carrier.failure is not None:
            self.carrier = None
            self.reviewer.compare(self.run, carrier.step)
            self._failed(carrier.step, carrier.failure)
        elif carrier.stage is DONE:
            self.carrier = None
            self.reviewer.compare(self.run, carrier.step)
            if not self.endangered() and self.run.broken():
                self.hold(self.trouble.relocalise())
        if self.ended is not None:
            return
        if self.state.pausing and not carrier.moving:
            self.now_paused()
        if self.carrier is None:
            self.arrival.begin(moved=True)
            if self.state.once and (self.state.by_hand or not self.arrival.open):
                self.state.stepped()
                if not self.state.by_hand:
                    self.now_paused()

    def _answered(self, carrier: Carrier, closed: tuple[Closed, ...]) -> None:
        carrier.answered(closed)
        self._after(carrier)

    def _failed(self, step: JointStep, failure: StepFailure) -> None:
        """Find out where the run stands, after people have told the facts that only they know.

        If the step has lost a fact that it needs, the run holds at once. People are then asked
        before it goes on.
        """

        def relocalise() -> None:
            """Find out where the run stands, and hold if necessary."""
            if not failure.hazards and self.endangered():
                return
            hold = self.trouble.after(failure)
            self.hold(hold or (Hold(failure.reason) if failure.unanswered else None))

        self.trouble.blame(step, failure)
        if failure.unanswered or failure.lost or failure.hazards:
            relocalise()
        else:
            self.integrity.informed(relocalise)

    # for commands
    # ----------------------------------------------------------------------------------

    def next_edge(self) -> Address | None:
        """Return the operation that people are asked about, else the next one of the route."""
        if self.generation.shown is not None:
            return None
        proposed = self.admission.proposed
        if proposed is not None and self.desk.busy and not self.desk.keeps:
            return proposed
        if holds(self.run.configuration, self.course.goals):
            return None
        return self.course.next_operation(self.run.configuration)

    def now_paused(self) -> None:
        """Pause now. Nothing moves, and simulated time stands still."""
        self.state.pause(carrying=self.carrier is not None or self.desk.busy)
        self.run.emit(Paused(t=self.run.time))

    def paused_or_held(self, why: str) -> None:
        """Pause, because the person or agent who was asked wants so. Without attendance, hold."""
        if self.attended:
            self.now_paused()
        else:
            self.hold(Hold(why))

    def taken_over(self, by: str, why: str) -> None:
        """Lock the automation out, because ``by`` wants so. Without attendance, hold."""
        run, told = self.run, TAKE_OVER if self.attended else PAUSE
        run.emit(Commanded(t=run.time, command=told, by=by, reason=why))
        if not self.attended:
            self.hold(Hold(why))
            return
        self.withdraw()
        self.state.take_over(by)
        self.say(why)
        run.emit(TakenOver(t=run.time, by=by))
        run.emit(*run.senses.forget(sensed_facts(run.blueprint)))

    def arrived(self, new: bool, moved: bool, sentence: str) -> None:
        """Handle goals that were told: a single step ends, and if all goals hold (``sentence``) the
        run ends.
        """
        state = self.state
        if new:
            self.loops.forget()
            self.repeats.forget()
        if state.by_hand:
            state.stepped()
        elif moved and state.once:
            state.stepped()
            self.now_paused()
        elif sentence:
            self.finish("goal_reached", sentence)

    def say(self, sentence: str) -> None:
        """Set the sentence about what the run waits for, or why it does not go on."""
        self.sentence = sentence

    def let_go(self) -> Carrier | None:
        """Drop the step that is carried out, and return its carrier."""
        carrier, self.carrier = self.carrier, None
        return carrier

    def nobody_attends(self) -> None:
        """Note that nobody attends the run any more."""
        self.attended = False

    def withdraw(self) -> None:
        """Withdraw what was proposed, so that the next proposal is made anew."""
        self.course.drop_plan()
        self.reviewer.forget()
        if self.carrier is None and not self.desk.keeps:
            self.desk.withdraw()

    # waiting and ending -------------------------------------------------------------------------

    def hold(self, hold: Hold | None) -> None:
        """Let nothing move until somebody decides. Without attendance the run ends. None does
        nothing.
        """
        if hold is None:
            return
        self.desk.withdraw()
        self.arrival.forget()
        self.state.hold(hold)
        self.sentence = hold.reason
        details = tuple(hold.details)
        held = Held(t=self.run.time, reason=hold.reason, details=details, kind=hold.kind)
        self.run.emit(held)
        if not self.attended:
            self.finish(hold.ends, hold.reason)

    def release(self) -> None:
        """End the hold."""
        self.state.release()
        self._no_trouble()

    def _no_trouble(self) -> None:
        self.sentence, self._broken_since = "", None
        self.trouble.forget()

    def finish(
        self, reason: str, sentence: str, refusals: Sequence[Mapping[str, str]] = ()
    ) -> None:
        """End the run. The event with the reason is told at the end of the tick."""
        run = self.run
        self.desk.withdraw()
        self.sentence, self.carrier = sentence, None
        configuration: Mapping[str, str] = dict(run.configuration)
        self.ended = RunFinished(
            t=run.time,
            reason=reason,
            sentence=sentence,
            operations=run.operations,
            configuration=configuration,
            refusals=tuple(refusals),
        )
