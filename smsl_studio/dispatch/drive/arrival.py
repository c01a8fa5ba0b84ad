"""The arrival at goals. A goal is reached, and a run is over, only after a fresh check.

The configuration is only what the run believes. Before a goal counts, the world goes on for at
least one more tick, and every sensor is read. Then the goal's state check must be true, with
readings that are newer than the last commit, command or disturbance.
"""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.blueprint.address import Address, fact_text
from smsl_studio.blueprint.check import FactKey
from smsl_studio.dispatch.drive.conduct import Conduct
from smsl_studio.dispatch.drive.integrity import Integrity
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.senses import Moment
from smsl_studio.dispatch.execution.trouble import Trouble
from smsl_studio.runlog.events import GoalReached

HAIR = 1e-9


class Arrival:
    """The goals of one run that were told, and the time since when fresh readings are awaited.

    ``closing`` says that nobody attends the run any more, so it ends whatever the check says.
    ``moved`` says that an operation has ended since the last look at the goals. A run by hand looks
    only then.
    """

    def __init__(
        self,
        run: LiveRun,
        goals: Sequence[Address],
        integrity: Integrity,
        trouble: Trouble,
        conduct: Conduct,
    ) -> None:
        self.closing = self.moved = False
        self._integrity, self._trouble, self._conduct = integrity, trouble, conduct
        self._run, self._goals = run, tuple(goals)
        self._told: set[Address] = set()
        self._since: Moment | None = None

    @property
    def open(self) -> bool:
        """Whether the run stands at a goal that was not told yet, or at all goals."""
        here = self._run.configuration
        # a loop, because this is asked at every tick and a generator is slow
        for goal in self._goals:
            if here[goal.branch] != goal.state:
                return False
            if goal not in self._told:
                return True
        return True

    @property
    def _reached(self) -> tuple[Address, ...]:
        """The goals in order, up to the first one at which the run does not stand."""
        here = self._run.configuration
        away = (n for n, goal in enumerate(self._goals) if here[goal.branch] != goal.state)
        return self._goals[: next(away, len(self._goals))]

    def begin(self, moved: bool = False) -> None:
        """Wait for readings that are newer than now. ``moved`` says that an operation has ended, so
        an earlier time no longer counts.
        """
        self.moved |= moved
        if moved or self._since is None:
            self._since = self._run.senses.moment

    def close(self) -> None:
        """Note that nobody attends the run any more."""
        self.closing = True

    def forget(self) -> None:
        """Note that something has happened, so new readings are needed."""
        self._since = None

    def look(self) -> None:
        """Check the goals after a tick. Tell them if the check is true, and hold if it is not.
        Nothing happens while readings are awaited, or within the settling time.
        """
        run, since = self._run, self._since
        if since is None:
            return
        run.look()
        if self._integrity.lost():
            return
        here = self._reached
        if self.closing and len(here) < len(self._goals):
            words = "The goals do not hold any more, and nobody is there to decide."
            self._conduct.finish("held", words)
        elif _doubtful(run, here) or run.broken():
            if run.time - since.time >= run.opened.settle - HAIR:
                self.forget()
                self._integrity.informed(lambda: self._hold(here))
        else:
            late = run.senses.late(since, self._facts(here))
            self._conduct.say(_waits(here, late) if late else "")
            if not late:
                self._tell(here)

    def _hold(self, goals: Sequence[Address]) -> None:
        self._conduct.hold(self._trouble.unconfirmed(goals))

    def _tell(self, here: Sequence[Address]) -> None:
        run = self._run
        new = [goal for goal in here if goal not in self._told]
        arrived = self.moved or bool(new)
        self._told.update(new)
        self.moved, self._since = False, None
        for goal in new:
            run.emit(GoalReached(t=run.time, goal=str(goal)))
        word = "holds" if len(here) == 1 else "hold"
        words = f"{', '.join(map(str, here))} {word}." if len(here) == len(self._goals) else ""
        self._conduct.arrived(bool(new), arrived, words)

    def _facts(self, goals: Sequence[Address]) -> set[FactKey]:
        """Return the facts that these goals depend on, and all critical facts."""
        run = self._run
        found = {(name, digit) for name, digits in run.critical.items() for digit in digits}
        names = {goal.branch for goal in goals} | {name for name, _ in found}
        below = {name for one in names for name in run.hierarchy.tree(one)}
        return found | {(n, d) for n in below for d in range(run.blueprint[n].num_facts)}


def _doubtful(run: LiveRun, goals: Sequence[Address]) -> bool:
    return any(run.check(goal.branch, goal.state).truth is not True for goal in goals)


def _waits(goals: Sequence[Address], late: Sequence[FactKey]) -> str:
    names = ", ".join(map(str, goals))
    return f"{names} awaits a new reading of {', '.join(fact_text(*key) for key in late)}."
