"""Carries out one joint step, tick by tick: begin, run, settle, check, commit (clauses 5 to 7)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from .checks import Check
from .elements import Edge, FactKey, split_fact
from .guards import doubt
from .hazards import objection
from .joint import JointStep
from .live import LiveRun
from .needed import in_checks
from .people import Question, Task, no_words, operation_task
from .step_watch import StepWatch
from .world import TableWorld

HAIR = 1e-9
NEXT, RUNNING, ASKING, SETTLING, DONE, FAILED = (
    "next", "running", "asking", "settling", "done", "failed",
)  # fmt: skip
"""The stages of the current action."""
UNSURE = "the operation was cancelled and may have changed it"


@dataclass(frozen=True)
class Failure:
    """Why a joint step has failed.

    ``risky``: the operation itself is to blame. ``pending``: it failed during a crossing.
    ``unanswered``: people did not answer. ``lost`` are needed facts that were lost, ``hazards``
    those that were met or that refused the next function.
    """

    edge: Edge
    reason: str
    risky: bool
    pending: bool
    unanswered: bool = False
    lost: list[str] = field(default_factory=list)
    hazards: list[str] = field(default_factory=list)


class Carrier:
    """One joint step that is being carried out. ``wants`` are questions that people must answer
    while the stage is ``ASKING``.
    """

    def __init__(self, run: LiveRun, step: JointStep) -> None:
        self.step, self.stage = step, NEXT
        self.failure: Failure | None = None
        self.wants: list[Question] = []
        self._run, self._index = run, 0
        self._since = self._until = 0.0
        self._fault = self._by = ""
        self._blame, self._answerable, self._unanswered = True, True, False
        self._watch = StepWatch(run)

    @property
    def edge(self) -> Edge:
        """The edge whose function is the current action."""
        return self.step.actions[min(self._index, len(self.step.actions) - 1)].edge

    @property
    def moving(self) -> bool:
        """Whether a function runs, a person acts, or the world settles after it."""
        return self.stage in (RUNNING, ASKING, SETTLING)

    @property
    def can_freeze(self) -> bool:
        """Whether a pause may freeze the step as it is, so that it can go on later."""
        terms = self.edge.terms
        resumes = terms.resumes or self._run.levels.by_person(self.edge)
        return self.stage in (ASKING, SETTLING) or (terms.stop == "hold" and resumes)

    @property
    def uncommitted(self) -> list[str]:
        """The edges of the step that are not committed yet, begun or not."""
        done = {edge for action in self.step.actions[: self._index] for edge in action.commits}
        return [edge.address for edge in self.step.edges if edge not in done]

    @property
    def touched(self) -> list[FactKey]:
        """The facts that what has begun and is not committed may have changed."""
        begun = self.step.actions[: self._index + (self.stage != NEXT)]
        return self._run.touched(begun, self.uncommitted)

    # ticks ---------------------------------------------------------------------------------------

    def advance(self, shut: Mapping[str, str]) -> None:
        """Make one tick. ``shut`` are the edges that must not begin, with reasons."""
        if self.stage == RUNNING:
            self._go_on()
        elif self.stage == NEXT:
            self._begin(shut)
        elif self.stage == SETTLING:
            self._run.hear(self._run.senses.tick()[1])
            self._notice()
            if self._watch.met or self._run.time >= self._until - HAIR:
                self._decide()

    def watch(self) -> None:
        """End the operation, as it declares, if a fact that the step needs is false or unknown. In
        any case nothing commits any more.
        """
        if not self.moving or not self._notice():
            return
        own = self.stage == RUNNING or self._person_acts
        if self.stage == SETTLING or (own and self.edge.terms.stop == "finish"):
            return
        if self.stage == RUNNING:
            self._cancel("cancelled", self._lost_words)
        else:
            self._end_asking(self._lost_words)
        self._settle()

    def _notice(self) -> bool:
        asked = [split_fact(one.address) for one in self.wants if one.kind == "fact"]
        return self._watch.notice([fact for fact in asked if fact is not None])

    @property
    def _lost_words(self) -> str:
        lost = "; ".join(self._watch.lost)
        return f"{self.edge} cannot go on: {lost}" if lost else ""

    @property
    def _person_acts(self) -> bool:
        return self.stage == ASKING and self.wants[0].kind == "operation"

    def _begin(self, shut: Mapping[str, str]) -> None:
        run, action = self._run, self.step.actions[self._index]
        barred = next((edge for edge in self.uncommitted if edge in shut), None)
        no = "" if barred is None else f"{barred} is {shut[barred]}"
        if not no and self._watch.begin(action):
            no = self._lost_words
        if not no and self._index:  # before the first action all guards have agreed just now
            no = doubt(run, action.edge) or self._objection()
        if no:
            self._fail(no, risky=False, pending=bool(run.transit))
            return
        run.cross(action.transit, action.moved)
        for edge in action.begins:
            function = edge.terms.function if edge.acts and not run.levels.by_person(edge) else ""
            said = {"target": edge.target, "function": function}
            run.tell("operation_started", address=edge.address, **said)
        run.hear(run.senses.forget(run.changed_by(action)))
        self._since, self._answerable, self._by = run.time, True, ""
        if run.levels.by_person(action.edge):
            self._want([operation_task(action.edge)])
            return
        run.host.begin(action.edge)
        self.stage = RUNNING

    def _objection(self) -> str:
        action = self.step.actions[self._index]
        found = objection(self._run, action.edge, [action])
        if found is None:
            return ""
        self._watch.refused_by(found.hazard)
        return found.sentence

    def _go_on(self) -> None:
        """Let the world and the function go on for one tick."""
        run = self._run
        tick, changes = run.senses.tick()
        run.hear(changes)
        if not tick.outcome:
            self.watch()
            limit = self.edge.terms.timeout
            if self.stage == RUNNING and run.time - self._since >= limit - HAIR:
                self._fault = f"{self.edge} took longer than its {limit:g} s"
                self._cancel("timed_out", self._fault)
                self._settle()
            return
        self._ended(tick.outcome, tick.message or self._by)
        if tick.outcome != "returned":
            how = "failed" if tick.outcome == "failed" else "raised an error"
            self._fault = f"{self.edge} {how}: {tick.message}"
        self._notice()
        self._settle()

    # outcome (clause 7) --------------------------------------------------------------------------

    def _settle(self) -> None:
        """Let the world settle before the state check decides."""
        self.stage, self._until = SETTLING, self._run.time + self._run.settle
        if self._run.settle <= 0 or self._watch.met:
            self._decide()

    def _decide(self) -> None:
        """End the action: the state check on sensed facts decides, whatever was returned."""
        run, action = self._run, self.step.actions[self._index]
        run.look()
        self._notice()
        if self._fault:
            self._fail(self._fault, self._blame, unanswered=self._unanswered)
            return
        if self._watch.lost:
            self._fail(self._lost_words, risky=False)
            return
        run.pending.update(action.moved)
        run.cross(action.after, {})
        targets = {**action.moved, **action.committed}
        checks = [run.check(branch, state, action.after) for branch, state in targets.items()]
        asked = in_checks(run, checks) if self._answerable else []
        if asked and all(check.truth is not False for check in checks):
            self._answerable = False
            self._want(asked)
            return
        if self._all_true(checks):
            self._succeed()

    def _all_true(self, checks: Sequence[Check]) -> bool:
        for check in checks:
            self._run.tell_check(check)
            if check.truth is not True:
                self._fail(self._run.why_not(check), risky=True)
                return False
        return True

    def _succeed(self) -> None:
        run, action = self._run, self.step.actions[self._index]
        if action.commits:
            run.commit(action)
        self._watch.end(action)
        self._index += 1
        self.stage = DONE if self._index == len(self.step.actions) else NEXT
        broken = run.broken() if self.stage == NEXT else []
        if broken:
            words = "; ".join(run.words(broken))
            self._fail(words, risky=False, pending=bool(run.transit))

    def _fail(
        self, reason: str, risky: bool, pending: bool | None = None, unanswered: bool = False
    ) -> None:
        """Fail. The step counts as pending from the start of a crossing until its commit."""
        if pending is None:
            pending = bool(self.step.actions[self._index].transit)
        lost, hazards = self._watch.lost, self._watch.met
        self.failure = Failure(self.edge, reason, risky, pending, unanswered, lost, hazards)
        self.stage = FAILED

    # people --------------------------------------------------------------------------------------

    def _want(self, questions: list[Question]) -> None:
        self.wants, self.stage = questions, ASKING

    def answered(self, closed: Sequence[Task]) -> None:
        """Go on after people have answered, or will not answer any more."""
        wants, self.wants = self.wants, []
        no = no_words(closed)
        if wants[0].kind == "operation":
            self._person_ended(closed[0], no)
        elif no:
            self._fail(no, risky=False, unanswered=True)
        else:
            self._decide()

    def unanswered(self, reason: str) -> None:
        """Fail, because nobody is there to answer."""
        kind, self.wants = self.wants[0].kind, []
        if kind == "operation":
            self._ended("cancelled", reason)
        self._fail(reason, risky=False, unanswered=True)

    def _person_ended(self, task: Task, no: str) -> None:
        """Take the end of a person's action. Only a failure is believed at once."""
        if task.yes:
            self._by = f"done by {task.who}"
            if isinstance(self._run.host.world, TableWorld):
                # Nobody can touch a table, so the function writes down what the person has done.
                self._run.host.begin(self.edge)
                self.stage = RUNNING
                return
            self._ended("returned", self._by)
        else:
            told = task.outcome == "answered"
            self._ended("failed" if told else "timed_out", no)
            self._fault, self._blame, self._unanswered = no, told, not told
        self._settle()

    # ends ----------------------------------------------------------------------------------------

    def abort(self, reason: str) -> None:
        """Cancel what goes on. The step fails when the world has settled, and nothing is risky."""
        if self.stage == RUNNING:
            self._cancel("cancelled", reason)
        elif self.stage == ASKING:
            self._end_asking(reason)
        elif self.stage == NEXT:
            self._fail(reason, risky=False, pending=bool(self._run.transit))
            return
        else:
            return
        self._fault, self._blame = reason, False
        self._settle()

    def cut(self, reason: str) -> list[FactKey]:
        """End the step as it is: nothing settles or commits any more. Return the facts that it may
        have changed.
        """
        touched = self.touched
        if self.stage == RUNNING:
            self._cancel("cancelled", reason)
        elif self.stage == ASKING:
            self._end_asking(reason)
        self.stage = FAILED
        return touched

    def _end_asking(self, reason: str) -> None:
        """Withdraw the questions. A person who was acting is taken to have stopped."""
        if self._person_acts:
            self._ended("cancelled", reason)
            self._run.hear(self._run.senses.doubt(self.touched, UNSURE))
        self.wants = []

    def _cancel(self, outcome: str, message: str) -> None:
        """End the function. What it may have changed is unknown until it is sensed again."""
        self._run.host.cancel()
        self._ended(outcome, message)
        self._run.hear(self._run.senses.doubt(self.touched, UNSURE))

    def _ended(self, outcome: str, message: str) -> None:
        said = {"outcome": outcome, "message": message}
        self._run.tell("operation_ended", address=self.edge.address, **said)
