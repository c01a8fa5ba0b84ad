"""Carries out one joint step, tick by tick: begin, run, settle, check, commit (clauses 5 to 7)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import CheckResult, FactKey
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.dispatch.execution.desk import no_words, who_words
from smsl_studio.dispatch.execution.effects import changed_by, touched
from smsl_studio.dispatch.execution.guards import doubt
from smsl_studio.dispatch.execution.hazard_guard import objection_to
from smsl_studio.dispatch.execution.needed import in_checks
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.stage import (
    ASKING,
    DONE,
    ENDED,
    FAILED,
    NEXT,
    RUNNING,
    SETTLING,
    ActionStage,
    StepFailure,
    fault_words,
)
from smsl_studio.dispatch.execution.step_watch import StepWatch
from smsl_studio.dispatch.execution.words import all_words, check_words, truth_word
from smsl_studio.dispatch.people.board import ANSWERED, Closed, Question
from smsl_studio.dispatch.people.questions import operation_task
from smsl_studio.host.protocol import RETURNED, Bound, Tick
from smsl_studio.host.protocol import RUNNING as GOES_ON
from smsl_studio.runlog.quick import (
    committed,
    operation_ended,
    operation_started,
    state_checked,
)
from smsl_studio.world.engines import TABLE

HAIR = 1e-9
MOVING = (RUNNING, ASKING, SETTLING)
UNSURE = "the operation was cancelled and may have changed it"


class Carrier:
    """One joint step that is being carried out.

    ``advance`` makes one tick of it. The driver decides what comes after the step. ``wants`` are
    the questions that people must answer while the stage is ``ASKING``. ``answered`` lets the step
    go on.
    """

    def __init__(self, run: LiveRun, step: JointStep) -> None:
        self.step = step
        self.stage: ActionStage = NEXT
        self.failure: StepFailure | None = None
        self.since = run.senses.time
        self.check: CheckResult | None = None
        self.wants: tuple[Question, ...] = ()
        self.action = step.actions[0]
        """The current action, or the last one."""
        self._run = run
        self._index = 0
        self._until = 0.0
        self._fault = self._by = ""
        self._blame = self._answerable = True
        self._unanswered = False
        self._watch = StepWatch(run, step) if run.guarded else None

    @property
    def bound(self) -> Bound:
        """The function or person that carries out the current action."""
        return self._run.bound[self.action.edge.address]

    @property
    def moving(self) -> bool:
        """Whether a function runs, a person acts, or the world settles after it."""
        return self.stage in MOVING

    @property
    def remaining(self) -> tuple[Edge, ...]:
        """The edges that have not started yet."""
        later = self._index if self.stage is NEXT else self._index + 1
        return tuple(e for action in self.step.actions[later:] for e in action.begins)

    @property
    def running(self) -> Address | None:
        """The edge whose function runs, or None."""
        return self.action.edge.address if self.moving else None

    @property
    def can_freeze(self) -> bool:
        """Whether a pause may freeze the step as it is, so that it can go on later."""
        return self.stage in (ASKING, SETTLING) or (
            self.bound.stop == "hold" and self.bound.resumes
        )

    @property
    def uncommitted(self) -> tuple[Address, ...]:
        """The edges of the step that are not committed yet, begun or not."""
        done = {edge for action in self.step.actions[: self._index] for edge in action.commits}
        return tuple(edge.address for edge in self.step.edges if edge not in done)

    @property
    def touched(self) -> tuple[FactKey, ...]:
        """The facts that actions which have begun and are not committed may have changed."""
        begun = self.step.actions[: self._index + (self.stage is not NEXT)]
        return tuple(sorted(touched(self._run, begun, set(self.uncommitted))))

    def advance(self, shut: Mapping[Address, str]) -> None:
        """Make one tick. Then ``stage`` says whether the step goes on, is done or has failed.
        ``shut`` are the edges that must not begin, with reasons.
        """
        if self.stage is RUNNING:
            self._go_on()
        elif self.stage is NEXT:
            self._begin(shut)
        elif self.stage is SETTLING:
            tick = self._tick()
            self._notice()
            if self._endangered or tick.time >= self._until - HAIR:
                self._decide(looked=self._run.senses.whole)

    def watch(self) -> None:
        """End the operation if a fact that the step needs is false or unknown, in the way that the
        operation declares (``finish`` lets it go on to its end). In any case nothing commits any
        more.
        """
        if self._watch is None or not self.moving or not self._notice():
            return
        own = self.stage is RUNNING or self._person_acts
        if self.stage is SETTLING or (own and self.bound.stop == "finish"):
            return
        if self.stage is RUNNING:
            self._cancel(self.bound.stop, "cancelled", self._lost_words)
        else:
            self._end_asking(self._lost_words)
        self._settle()

    def _notice(self) -> bool:
        """Return whether the step has just lost a needed fact, or a hazard is met just now."""
        return self._watch is not None and self._watch.notice(self.wants)

    @property
    def _endangered(self) -> bool:
        return self._watch is not None and bool(self._watch.met)

    @property
    def _lost_words(self) -> str:
        """Why the step cannot go on, empty if it has lost no fact and meets no hazard."""
        if self._watch is None or not self._watch.lost:
            return ""
        return f"{self.action.edge} cannot go on: {'; '.join(self._watch.lost)}"

    @property
    def _person_acts(self) -> bool:
        return self.stage is ASKING and self.wants[0].kind == "operation"

    def abort(self, mode: str, reason: str) -> None:
        """Cancel the running function. The step fails after the world has settled, and no operation
        is tagged risky.
        """
        if self.stage is RUNNING:
            self._cancel(mode, "cancelled", reason)
            self._fault, self._blame = reason, False
            self._settle()
        elif self.stage is ASKING:
            self._end_asking(reason)
            self._fault, self._blame = reason, False
            self._settle()
        elif self.stage is NEXT:
            self._fail(reason, risky=False, pending=bool(self._run.transit))

    def cut(self, reason: str) -> tuple[FactKey, ...]:
        """End the step as it is: the world is braked, and nothing settles or commits any more.
        Return the facts that the step may have changed.
        """
        touched = self.touched
        if self.stage is RUNNING:
            stop = self.bound.stop
            self._cancel("hold" if stop == "finish" else stop, "cancelled", reason)
        elif self.stage is ASKING:
            self._end_asking(reason)
        self.stage = FAILED
        return touched

    def _end_asking(self, reason: str) -> None:
        """Withdraw the questions. If a person was acting, the run assumes that the person has
        stopped.
        """
        if self._person_acts:
            self._ended("cancelled", reason)
            self._run.emit(*self._run.senses.doubt(self.touched, UNSURE))
        self.wants = ()

    def _cancel(self, mode: str, outcome: str, message: str) -> None:
        """End the function. The facts that it may have changed are unknown until they are sensed
        again.
        """
        run = self._run
        run.host.cancel(mode)
        self._ended(outcome, message)
        run.emit(*run.senses.doubt(self.touched, UNSURE))

    def _begin(self, shut: Mapping[Address, str]) -> None:
        action, run = self.action, self._run
        barred = next((edge for edge in self.uncommitted if edge in shut), None) if shut else None
        no = "" if barred is None else f"{barred} is {shut[barred]}"
        if not no and self._watch is not None and self._watch.begin(action):
            no = self._lost_words
        if not no and self._index:  # before the first action, all guards have agreed just now
            no = doubt(run, action.edge) or self._objection()
        if no:
            self._fail(no, risky=False, pending=bool(run.transit))
            return
        run.cross(action.transit, moving=action.moved)
        now = run.senses.time
        for edge in action.begins:
            function = run.bound[edge.address].function if edge.function else ""
            run.tell(operation_started(now, edge.text, edge.target, function))
        if run.people_say:
            run.emit(*run.senses.forget(changed_by(run, action)))
        self.since, self._answerable, self._by = now, True, ""
        if run.people_act and run.by_person(action.edge):
            self._want(operation_task(run.blueprint, action.edge.address))
            return
        run.host.begin(action.edge.address)
        self.stage = RUNNING

    def _objection(self) -> str:
        """Return why the next function must not run because of a hazard, or the empty text."""
        found = objection_to(self._run, self.action)
        if found is None or self._watch is None:
            return ""
        self._watch.refused_by(found.hazard)
        return found.sentence

    def _want(self, *questions: Question) -> None:
        self.wants, self.stage = questions, ASKING

    def answered(self, closed: Sequence[Closed]) -> None:
        """Go on after people have answered the questions, or will not answer them."""
        wants, self.wants = self.wants, ()
        no = no_words(closed)
        if wants[0].kind == "operation":
            self._person_ended(closed[0] if closed else None, no)
        elif no:
            self._fail(no, risky=False, unanswered=True)
        else:
            self._decide()

    def unanswered(self, reason: str) -> None:
        """Fail, because nobody is there to answer the questions."""
        kind, self.wants = self.wants[0].kind, ()
        if kind == "operation":
            self._ended("cancelled", reason)
        self._fail(reason, risky=False, unanswered=True)

    def _person_ended(self, closed: Closed | None, no: str) -> None:
        """Handle the end of a person's action: done, not possible, or no answer. As with a
        function, only a failure is believed at once.
        """
        run, edge = self._run, self.action.edge
        if closed is not None and closed.yes:
            self._by = f"done by {who_words(closed)}"
            if run.opened.world == TABLE:
                # Nobody can touch a table in memory, so its function writes down what the person
                # has done.
                run.host.begin(edge.address)
                self.stage = RUNNING
                return
            self._ended("returned", self._by)
        else:
            told = closed is not None and closed.outcome == ANSWERED
            self._ended("failed" if told else "timed_out", no)
            self._fault, self._blame, self._unanswered = no, told, not told
        self._settle()

    def _tick(self) -> Tick:
        tick, changes = self._run.senses.tick()
        if changes:
            self._run.emit(*changes)
        return tick

    def _go_on(self) -> None:
        """Let the world and the function go on for one tick."""
        tick, changes = self._run.senses.tick()
        if changes:
            self._run.emit(*changes)
        outcome = tick.outcome
        if outcome is GOES_ON:
            self.watch()
            limit = self.bound.timeout
            if self.stage is not RUNNING or tick.time - self.since < limit - HAIR:
                return
            self._fault = f"{self.action.edge} took longer than its {limit:g} s"
            self._cancel("abort", "timed_out", self._fault)
            self._settle()
            return
        if outcome is RETURNED:
            self._ended("returned", tick.message or self._by)
        else:
            self._ended(ENDED[outcome], tick.message or self._by)
            self._fault = fault_words(self.action.edge, tick)
        self._notice()
        self._settle(looked=self._run.senses.whole)

    def _ended(self, outcome: str, message: str) -> None:
        run, address = self._run, self.action.edge.text
        now = run.senses.time
        if outcome == "returned":
            run.durations[address] = now - self.since
        run.tell(operation_ended(now, address, outcome, message))

    def _settle(self, looked: bool = False) -> None:
        """Let the world settle. ``looked`` says that every sensor was read at this instant."""
        self.stage = SETTLING
        run = self._run
        settle = run.opened.settle
        self._until = run.senses.time + settle
        if settle <= 0 or self._endangered:
            self._decide(looked)

    def _decide(self, looked: bool = False) -> None:
        """End the action: the state check on sensed facts decides, whatever the function
        returned. ``looked`` says that every sensor was read at this instant.
        """
        run, action = self._run, self.action
        if not looked:
            run.look()
        if self._watch is not None:
            self._watch.notice(self.wants)
        if self._fault:
            self._fail(self._fault, risky=self._blame, unanswered=self._unanswered)
            return
        if self._watch is not None and self._watch.lost:
            self._fail(self._lost_words, risky=False)
            return
        after = action.after
        run.cross(after, action.moved)
        checks = []
        for branch, state in action.targets:
            checks.append(run.check(branch, state, after))
        asked = in_checks(run, checks) if run.people_say and self._answerable else ()
        if asked and all(check.truth is not False for check in checks):
            self._answerable = False
            self._want(*asked)
            return
        for check in checks:
            self.check = check
            self._told(check)
            if check.truth is not True:
                self._fail(check_words(run.blueprint, check), risky=True)
                return
        if action.commits:
            run.commit(action.committed, action.commits)
            run.tell(committed(run.senses.time, action.texts, action.committed))
        if self._watch is not None:
            self._watch.end(action)
        self._index += 1
        if self._index == len(self.step.actions):
            self.stage = DONE
            return
        self.action, self.stage = self.step.actions[self._index], NEXT
        broken = run.broken()
        if broken:
            words = "; ".join(all_words(run.blueprint, broken))
            self._fail(words, risky=False, pending=bool(run.transit))

    def _told(self, check: CheckResult) -> None:
        run, truth, now = self._run, check.truth, self._run.senses.time
        if truth:
            run.tell(state_checked(now, check.address, "true", (), ()))
            return
        misses = all_words(run.blueprint, check.misses)
        unknown = all_words(run.blueprint, check.unknown)
        run.tell(state_checked(now, check.address, truth_word(truth), misses, unknown))

    def _fail(
        self, reason: str, risky: bool, pending: bool | None = None, unanswered: bool = False
    ) -> None:
        """Fail. By default the step counts as pending if its action has digits in transit, which is
        so from the start of a crossing until its commit.
        """
        if pending is None:
            pending = bool(self.action.transit)
        edge, watch = self.action.edge, self._watch
        found = (watch.lost, watch.met) if watch is not None else ((), ())
        self.failure = StepFailure(edge, reason, risky, pending, unanswered, *found)
        self.stage = FAILED
