"""The driver: what a run does at each tick, and what a person's commands make of it.

It stands between the door (``dispatcher``), which queues commands and tells what happened, and
the carrier, which carries out one joint step.
"""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.dispatch.carrier import Carrier, Stage
from smsl_studio.dispatch.course import Course
from smsl_studio.dispatch.guards import Supervisor, asked, refusals
from smsl_studio.dispatch.outlook import Outlook
from smsl_studio.dispatch.pace import Pace
from smsl_studio.dispatch.planner import holds
from smsl_studio.dispatch.run import Run
from smsl_studio.dispatch.trouble import Hold, Trouble
from smsl_studio.errors import PlanningError
from smsl_studio.runlog.events import (
    GoalReached,
    Held,
    OperationEnded,
    OperationPruned,
    OperationRefused,
    OperationRestored,
    Paused,
    Resumed,
    RoutePlanned,
    RunFinished,
)


class Driver:
    """One opened run. ``reason`` is empty until it has ended; ``sentence`` says why it ended or
    holds. ``attended`` says whether someone is there to decide when it holds."""

    def __init__(
        self,
        run: Run,
        course: Course,
        pace: Pace,
        trouble: Trouble,
        *,
        supervisor: Supervisor | None,
        attended: bool,
    ) -> None:
        self.run, self.course, self.pace, self.trouble = run, course, pace, trouble
        self.outlook = Outlook(run, course)
        self.carrier: Carrier | None = None
        self.reason = self.sentence = ""
        self._supervisor = supervisor
        self._attended = attended
        self._told: set[Address] = set()
        self._broken_since: float | None = None

    @property
    def phase(self) -> str:
        return "finished" if self.reason else self.pace.phase(self.carrier is not None)

    # what a person may say ----------------------------------------------------------------------

    def ask(self, address: Address) -> None:
        """Carry out one operation; refused with every reason, before anything moves."""
        run = self.run
        reasons: tuple[str, ...]
        if self.carrier is not None:
            reasons = (f"{self.carrier.step.asked} is being carried out",)
        elif self.phase == "running":
            reasons = ("the run is automatic, pause it first",)
        else:
            run.look()
            answer = asked(run, self.course, address, self._supervisor)
            if isinstance(answer, JointStep):
                self.course.drop_plan()
                self.pace.paused |= bool(self.pace.held) and not self.pace.by_hand
                self._begin(answer)
                return
            reasons = answer
        run.emit(OperationRefused(t=run.time, address=str(address), reasons=reasons))

    def pause(self) -> None:
        """Hold now, or as the running operation declares: finish it, abort it."""
        carrier = self.carrier
        if self.phase in ("paused", "held"):
            return
        if carrier is None or not carrier.moving or carrier.bound.stop == "hold":
            self._now_paused()
            return
        self.pace.pausing = True
        if carrier.bound.stop == "abort":
            carrier.abort("abort", "it was paused and cannot be held")

    def resume(self) -> None:
        """Go on after a pause or a hold; by hand, follow the route from here."""
        if self.phase == "ready":
            self.pace.by_hand = False
        self.pace.resume()
        self.run.emit(Resumed(t=self.run.time))
        self._reread()

    def step(self) -> None:
        """One operation of the route, then wait again; ignored while one runs."""
        if self.phase != "running":
            self.pace.step()
            self._reread()

    def stop(self) -> None:
        """Brake and end."""
        run, carrier = self.run, self.carrier
        if carrier is not None and carrier.stage is Stage.RUNNING:
            run.host.cancel("hold" if carrier.bound.stop == "finish" else carrier.bound.stop)
            address = str(carrier.action.edge)
            run.emit(OperationEnded(t=run.time, address=address, outcome="cancelled"))
        self.finish("stopped", "Stopped by a person.")

    def adopt(self) -> None:
        """While held: take the one configuration the scene agrees with."""
        found = self.trouble.candidates
        if self.pace.held and len(found) == 1:
            self._release()
            self.trouble.adopt(found[0])

    def prune(self, address: Address, reason: str) -> None:
        """Shut an edge out; if its function runs, stop it."""
        self.course.prune(address, reason)
        self.run.emit(OperationPruned(t=self.run.time, address=str(address), reason=reason))
        if self.carrier is not None and self.carrier.running == address:
            self.carrier.abort("hold", f"{address} was pruned: {reason}")

    def restore(self, address: Address) -> None:
        """Let a pruned, avoided or risky edge be used again."""
        if self.course.restore(address):
            self.run.emit(OperationRestored(t=self.run.time, address=str(address)))

    # one tick -----------------------------------------------------------------------------------

    def go_on(self) -> None:
        """One host tick where something runs or lives, otherwise the next proposal."""
        phase = self.phase
        if phase == "paused":
            return
        if self.carrier is not None:
            self._carry(self.carrier)
        elif phase in ("held", "ready"):
            self._idle()
        else:
            self._propose()

    def _idle(self) -> None:
        """The world lives while a person thinks; integrity is watched (clause 9)."""
        run = self.run
        _, changes = run.senses.tick()
        run.emit(*changes)
        if not run.broken():
            self._broken_since = None
        elif self._broken_since is None:
            self._broken_since = run.time
        if self.pace.held or self._broken_since is None:
            return
        if run.time - self._broken_since >= run.opened.settle:
            self._hold(self.trouble.relocalise())

    def _propose(self) -> None:
        run, course = self.run, self.course
        self._tell_goals()
        if holds(run.configuration, course.goals):
            self._arrived()
            return
        try:
            step, leg = course.next_step(run.configuration)
            if step is None:
                self._hold(self.trouble.no_way(self.outlook.details()))
                return
        except PlanningError as error:
            words = f"{error.sentence[:1].upper()}{error.sentence[1:]}."
            self._hold(Hold(words, (error.advice,)))
            return
        if leg is not None:
            operations = tuple(map(str, leg.operations))
            goal = leg.aim
            run.emit(RoutePlanned(t=run.time, goal=goal, operations=operations, cost=leg.cost))
        reasons = refusals(run, step, self._supervisor)
        if reasons:
            course.drop_plan()
            run.emit(OperationRefused(t=run.time, address=str(step.asked), reasons=reasons))
            self._hold(Hold(f"{step.asked} cannot begin: {reasons[0]}", reasons))
            return
        self._begin(step)

    def _begin(self, step: JointStep) -> None:
        self._release()
        self.carrier = Carrier(self.run, step)
        self._carry(self.carrier)

    def _carry(self, carrier: Carrier) -> None:
        carrier.advance(self.course.shut)
        if carrier.failure is not None:
            self.carrier = None
            self._hold(self.trouble.failed(carrier.step, carrier.failure))
        elif carrier.stage is Stage.DONE:
            self.carrier = None
            if self.run.broken():
                self._hold(self.trouble.relocalise())
        if self.reason:
            return
        if self.pace.pausing and not carrier.moving:
            self._now_paused()
        if self.carrier is None:
            self._tell_goals()
            if self.pace.once:
                self.pace.once = False
                if not self.pace.by_hand:
                    self._now_paused()

    def _tell_goals(self) -> None:
        """Goals count as reached in their order."""
        run = self.run
        for goal in self.course.goals:
            if not holds(run.configuration, [goal]):
                return
            if goal not in self._told:
                self._told.add(goal)
                run.emit(GoalReached(t=run.time, goal=str(goal)))

    def _arrived(self) -> None:
        if self.pace.by_hand:
            self.pace.once = False
            return
        goals = self.course.goals
        word = "holds" if len(goals) == 1 else "hold"
        self.finish("goal_reached", f"{', '.join(map(str, goals))} {word}.")

    # waiting and ending -------------------------------------------------------------------------

    def _now_paused(self) -> None:
        self.pace.pause(carrying=self.carrier is not None)
        self.run.emit(Paused(t=self.run.time))

    def _reread(self) -> None:
        """After a hold the scene decides whether the run may go on."""
        if self.pace.held:
            self._release()
            self._hold(self.trouble.relocalise())

    def _hold(self, hold: Hold | None) -> None:
        if hold is None:
            return
        self.pace.held = self.sentence = hold.reason
        self.pace.once = False
        self.run.emit(Held(t=self.run.time, reason=hold.reason, details=tuple(hold.details)))
        if not self._attended:
            self.finish(hold.kind, hold.reason)

    def _release(self) -> None:
        self.pace.held, self.sentence, self._broken_since = "", "", None

    def finish(self, reason: str, sentence: str) -> None:
        """The run is over; the last event says why."""
        self.reason, self.sentence, self.carrier = reason, sentence, None
        run = self.run
        run.emit(
            RunFinished(
                t=run.time,
                reason=reason,
                sentence=sentence,
                operations=run.operations,
                configuration=dict(run.configuration),
            )
        )
