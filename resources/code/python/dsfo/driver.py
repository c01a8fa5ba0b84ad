"""The driver: what a run does at each tick by itself, and how it waits and ends."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from .admission import Admission
from .arrival import Arrival
from .carrier import ASKING, DONE, Carrier, Failure
from .course import Course
from .elements import HUMAN, Edge, address
from .errors import PlanningError, RunRefused
from .events import Event, event
from .guards import lost_critical, lost_terms
from .hazards import met, met_words, tell
from .joint import JointStep
from .live import LiveRun
from .loop_guard import REPEATS, VISITS, LoopGuard
from .needed import all_theirs, in_checks
from .outlook import details
from .people import Desk, Task, no_words, start_task, title_of
from .planner import Leg
from .run_state import RunState
from .supervisor import Reviewer
from .trouble import Hold, Trouble


@dataclass(frozen=True)
class RunTerms:
    """What is settled before the first tick.

    ``adopts``: a mismatch is resolved by the only configuration that fits. ``attended``: somebody
    is there to decide. ``met`` are the typed conditions of an approval that were checked.
    """

    seed: int = 0
    adopts: bool = False
    attended: bool = False
    approved: bool = False
    met: Sequence[str] = ()


class Driver:
    """One opened run. ``ended`` is the last event, when it is over."""

    def __init__(self, run: LiveRun, course: Course, reviewer: Reviewer, terms: RunTerms) -> None:
        self.run, self.course, self.reviewer, self.terms = run, course, reviewer, terms
        self.state = RunState()
        self.attended = terms.attended
        self.trouble = Trouble(run, course, terms.adopts)
        self.loops, self.repeats = LoopGuard(VISITS), LoopGuard(REPEATS)
        self.desk = Desk(run, lambda: self.attended)
        self.admission = Admission(run, course, self.desk, reviewer, self.loops, self)
        self.arrival = Arrival(run, course.goals, self.trouble, self)
        self.carrier: Carrier | None = None
        self.ended: Event | None = None
        self.sentence = ""
        self.told = self.over = False
        """Whether the start was told, and whether the run may move."""
        self._bypassed: set[str] = set()
        self._broken_since: float | None = None

    @property
    def phase(self) -> str:
        """The run state in one word, such as ``paused``."""
        return self.state.phase(self.carrier is not None, self.desk.busy)

    # the start (clauses 1, 3 and 11) -------------------------------------------------------------

    def start(self) -> None:
        """Go on with the start: people tell the facts that only they know, then the state checks
        follow. RunRefused if the world is not at the start.
        """
        if self.told:
            self._accepted()
            return
        run = self.run
        changes = run.senses.look()
        facts = in_checks(run, run.checks(run.configuration))
        if not facts:
            self._tell_start(changes)
            return
        run.hear(changes)
        nobody = self.desk.ask(facts, self._start_said)
        if nobody:
            raise RunRefused(
                nobody,
                "Run it where somebody answers, or by a script that does, or let sensors say what "
                "it asks.",
            )

    def _start_said(self, closed: list[Task]) -> None:
        no = no_words(closed)
        try:
            if no:
                raise RunRefused(no, "The start must be known before anything moves.")
            self._tell_start([])
        except RunRefused as refused:
            self.finish("refused", refused.words, refused.refusals)

    def _tell_start(self, changes: Sequence[Event]) -> None:
        run = self.run
        checks = run.checks(run.configuration)
        failed = [run.why_not(check) for check in checks if check.truth is not True]
        if failed:
            words = "; ".join(failed[:20])
            told = [("start_unconfirmed", words)] if self.terms.approved else []
            raise RunRefused(words, "Put the world where the start has it.", told)
        refuse_hazards(run)
        more = {"met": list(self.terms.met)} if self.terms.met else {}
        run.tell(
            "run_started",
            world=run.host.world.name,
            seed=self.terms.seed,
            start=dict(run.configuration),
            goals=[address(*goal) for goal in self.course.goals],
            behaviour=run.blueprint.behaviour,
            **more,
            sensed=run.senses.sensed,
        )
        for at, sentence in run.blueprint.left_out:
            run.tell("left_out", address=at, sentence=sentence)
        run.hear(changes)
        for check in checks:
            run.tell_check(check)
        self.told = True
        self._accepted()

    def _accepted(self) -> None:
        """Ask whether what inspection found is accepted, if a person must say so."""
        found = self._findings
        if not found:
            self.over = True
            return
        nobody = self.desk.ask([start_task()], self._findings_said)
        if nobody:
            self.hold(Hold(nobody, (found,)))

    @property
    def _findings(self) -> str:
        level, found = self.run.levels.inspection, self.run.blueprint.findings
        if level == "automatic" or self.over:
            return ""
        return found or ("Inspection found nothing." if level == HUMAN else "")

    def _findings_said(self, closed: list[Task]) -> None:
        if closed[0].yes:
            self.over = True
        elif closed[0].answer is not None:
            self.finish("refused", f"The findings were not accepted: {closed[0].why}.")
        else:
            self.hold(Hold(closed[0].why, (self._findings,)))

    # one tick ------------------------------------------------------------------------------------

    def go_on(self) -> None:
        """Make one tick of the world if something is carried out or it is live, else propose."""
        carrier, asking = self.carrier, self.desk.busy
        if carrier is not None and not (asking or self.state.frozen):
            self._carry(carrier)  # in every run state: what has begun goes on
            return
        phase = self.phase
        if phase == "paused":
            return
        if asking and not self._outlived():
            self._wait(watched=phase == "waiting")
        elif carrier is not None:
            self._carry(carrier)
        elif not self.over and phase in ("running", "ready"):
            self._start_again()
        elif phase == "running":
            self._propose()
        else:
            self._live(watched=phase == "ready")

    def _start_again(self) -> None:
        try:
            self.start()
        except RunRefused as refused:
            self.finish("refused", refused.words, refused.refusals)

    def _wait(self, watched: bool) -> None:
        """Wait for people. Until they have answered, time passes in the world."""
        if self.desk.settled():
            return
        if self.carrier is None:
            self._live(watched)
        else:
            self._tick()
            self.carrier.watch()
            if self.carrier.stage != ASKING:
                self.desk.withdraw()
                self._after(self.carrier)
                return
        self.desk.pass_time()
        self.desk.settled()

    def _outlived(self) -> bool:
        """Return whether people are asked about a step that has ended meanwhile."""
        if self.carrier is None or self.carrier.stage == ASKING:
            return False
        self.desk.withdraw()
        return True

    def _live(self, watched: bool) -> None:
        """Let time pass while a person thinks. If ``watched``, check integrity (clause 9)."""
        run = self.run
        self.arrival.begin()
        self._tick()
        if self.endangered() or not watched or (self.told and self.lost()) or self.desk.keeps:
            return
        if self.arrival.moved and not self.desk.busy and self.arrival.open:
            self.arrival.look()
            return
        if not run.broken():
            self._broken_since = None
            return
        if self._broken_since is None:
            self._broken_since = run.time
        if run.time - self._broken_since >= run.settle:
            self.withdraw()
            self.hold(self.trouble.relocalise())

    def _tick(self) -> None:
        self.run.hear(self.run.senses.tick()[1])

    def _propose(self) -> None:
        if self.told and self.run.critical and self.lost():
            return
        if self.endangered():
            return
        if self.arrival.closing or self.arrival.open:
            self.arrival.begin()
            self._tick()
            self.arrival.look()
            return
        found = self._next()
        if isinstance(found, Hold):
            self.hold(found)
        else:
            self.admission.admit(found)

    def _next(self) -> JointStep | Hold:
        """Return the next step of the route, or why there is none."""
        run, course = self.run, self.course
        try:
            step, leg = course.next_step(run.configuration)
            if step is None:
                return self.trouble.no_way(details(run, course))
        except PlanningError as error:
            return Hold(f"{error.sentence[:1].upper()}{error.sentence[1:]}.", (error.advice,))
        if leg is not None:
            self._tell_route(step, leg)
        return step

    def _tell_route(self, step: JointStep, leg: Leg) -> None:
        operations, cost = list(leg.operations), leg.cost
        self.run.tell("route_planned", goal=leg.aim, operations=operations, cost=cost)
        self.tell_bypasses([*step.edges, *self.course.ahead])

    def tell_bypasses(self, edges: Sequence[Edge], again: bool = False) -> None:
        """Tell the edges that set the facts of their sub-SBs by themselves (``subs: load``)."""
        known = self.run.hierarchy
        for edge in dict.fromkeys(edges):
            if not edge.load or (edge.address in self._bypassed and not again):
                continue
            self._bypassed.add(edge.address)
            turned = [(d, s) for d, s in known.subs[edge.branch] if d in (*edge.falls, *edge.rises)]
            subs = list(dict.fromkeys(name for _, sub in turned for name in known.tree(sub)))
            own = self.run.blueprint[edge.branch]
            facts = " and ".join(own.fact_name(digit) for digit, _ in turned)
            sentence = (
                f"Goes by {title_of(edge)}: it sets {facts} of {own.name} by itself, and no "
                f"operation of {' and '.join(subs)} is carried out."
            )
            self.run.tell("subs_bypassed", address=edge.address, subs=subs, sentence=sentence)

    # one step ------------------------------------------------------------------------------------

    def begin(self, step: JointStep, chosen: bool) -> None:
        """Carry out a step from this tick on. All guards have agreed."""
        if chosen:
            self.course.drop_plan()
            self.loops.forget()
            self.reviewer.forget()
            self.tell_bypasses(step.edges, again=True)
        else:
            self.loops.count(self.run.configuration, step.asked)
        self.state.begin(chosen)
        self._no_trouble()
        self.desk.withdraw()
        self.carrier = Carrier(self.run, step)
        self._carry(self.carrier)

    def _carry(self, carrier: Carrier) -> None:
        if carrier.failure is None:
            carrier.advance(self.course.shut)
        self._after(carrier)

    def _after(self, carrier: Carrier) -> None:
        """Handle the new stage of a step, after a tick or an answer."""
        if carrier.stage == ASKING:
            nobody = self.desk.ask(carrier.wants, partial(self._answered, carrier))
            if nobody:
                carrier.unanswered(nobody)
        if carrier.failure is not None:
            self.carrier = None
            self._failed(carrier.step, carrier.failure)
        elif carrier.stage == DONE:
            self.carrier = None
            if not self.endangered() and self.run.broken():
                self.hold(self.trouble.relocalise())
        if self.ended is not None:
            return
        if self.state.pausing and not carrier.moving:
            self.now_paused()
        if self.carrier is None:
            self.arrival.begin(moved=True)
            if self.state.once and (self.state.by_hand or not self.arrival.open):
                self.state.once = False
                if not self.state.by_hand:
                    self.now_paused()

    def _answered(self, carrier: Carrier, closed: list[Task]) -> None:
        carrier.answered(closed)
        self._after(carrier)

    def _failed(self, step: JointStep, failure: Failure) -> None:
        """Find out where the run stands, after people have told the facts that only they know."""

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
            self.informed(relocalise)

    # integrity (clause 9) ------------------------------------------------------------------------

    def informed(self, then: Callable[[], None]) -> None:
        """Call ``then`` after people were asked for unknown facts of the active states, or at once
        if there are none or nobody answers.
        """
        run = self.run
        run.look()
        facts = in_checks(run, run.checks(run.configuration))
        if not facts or self.desk.ask(facts, lambda _: then(), keep=True):
            then()

    def lost(self) -> bool:
        """Hold if a hazard is met, or a critical fact is false or unknown."""
        run = self.run
        if self.endangered():
            return True
        if not lost_critical(run):
            return False
        theirs = all_theirs(run, lost_terms(run))
        if theirs and self.desk.keeps:
            return False
        self.withdraw()
        if theirs:
            self.informed(self._hold_lost)
        else:
            run.look()
            self._hold_lost()
        return True

    def _hold_lost(self) -> None:
        facts = lost_critical(self.run)
        self.hold(self.trouble.lost(facts) if facts else None)

    def endangered(self) -> bool:
        """Hold if the run has begun and a hazard is met. Return whether it holds or is latched in
        one. A run that holds is told again only of another hazard.
        """
        run, state = self.run, self.state
        found = met(run) if self.told and run.hazards else []
        if not found:
            return False
        if state.stopped or state.held is not None:
            found = [one for one in found if one.name not in run.told_hazards]
            if not found:
                return True
        self.withdraw()
        tell(run, found)
        if not state.stopped:
            self.hold(self.trouble.endangered(found, observes=bool(state.taken_over)))
        return True

    # waiting and ending --------------------------------------------------------------------------

    def now_paused(self) -> None:
        """Pause now. Nothing moves, and simulated time stands still."""
        self.state.pause(carrying=self.carrier is not None or self.desk.busy)
        self.run.tell("paused")

    def paused_or_held(self, why: str) -> None:
        """Pause, because who was asked wants so. Without attendance, hold."""
        if self.attended:
            self.now_paused()
        else:
            self.hold(Hold(why))

    def arrived(self, new: bool, moved: bool, sentence: str) -> None:
        """Handle goals that were told: a single step ends, and if all goals hold the run ends."""
        state = self.state
        if new:
            self.loops.forget()
            self.repeats.forget()
        if state.by_hand:
            state.once = False
        elif moved and state.once:
            state.once = False
            self.now_paused()
        elif sentence:
            self.finish("goal_reached", sentence)

    def say(self, sentence: str) -> None:
        """Set the sentence about what the run waits for."""
        self.sentence = sentence

    def withdraw(self) -> None:
        """Withdraw what was proposed, so that the next proposal is made anew."""
        self.course.drop_plan()
        self.reviewer.forget()
        if self.carrier is None and not self.desk.keeps:
            self.desk.withdraw()

    def hold(self, hold: Hold | None) -> None:
        """Let nothing move until somebody decides. Without attendance the run ends."""
        if hold is None:
            return
        self.desk.withdraw()
        self.arrival.forget()
        self.state.hold(hold)
        self.sentence = hold.reason
        details_told = list(hold.details)
        self.run.tell("held", reason=hold.reason, details=details_told, kind=hold.kind)
        if not self.attended:
            self.finish(hold.ends, hold.reason)

    def release(self) -> None:
        """End the hold."""
        self.state.held = None
        self._no_trouble()

    def _no_trouble(self) -> None:
        self.sentence, self._broken_since = "", None
        self.trouble.candidates = []

    def finish(
        self, reason: str, sentence: str, refusals: Sequence[Mapping[str, str]] = ()
    ) -> None:
        """End the run. The event with the reason is told at the end of the tick."""
        self.desk.withdraw()
        self.sentence, self.carrier = sentence, None
        self.ended = self.end_of(reason, sentence, refusals)

    def end_of(
        self, reason: str, sentence: str, refusals: Sequence[Mapping[str, str]] = ()
    ) -> Event:
        """Return the event that would end the run now."""
        run = self.run
        more = {"refusals": list(refusals)} if refusals else {}
        return event(
            "run_finished",
            run.time,
            reason=reason,
            sentence=sentence,
            operations=run.operations,
            configuration=dict(run.configuration),
            **more,
        )


def refuse_hazards(run: LiveRun) -> None:
    """Raise RunRefused if the sensed facts meet a hazard at the start."""
    found = met(run)
    if found:
        raise RunRefused(
            f"the start meets a hazard: {'; '.join(met_words(found))}",
            "Start where its facts do not hold together.",
        )
