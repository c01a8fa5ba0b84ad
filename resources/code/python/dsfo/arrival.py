"""The arrival at goals: a goal is told only after a fresh check, with readings that are newer than
the last commit, command or disturbance (clause 9).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

from .course import goal_text
from .elements import FactKey, fact_text
from .goals import Goal
from .live import LiveRun
from .trouble import Hold, Trouble

HAIR = 1e-9


class Conduct(Protocol):
    """What an arrival may cause, and what it asks of the run as a whole."""

    def finish(self, reason: str, sentence: str) -> None:
        """End the run."""

    def hold(self, hold: Hold | None) -> None:
        """Let nothing move until somebody decides."""

    def arrived(self, new: bool, moved: bool, sentence: str) -> None:
        """Handle goals that were told. ``sentence`` names them if all goals hold."""

    def lost(self) -> bool:
        """Hold if a hazard is met or a critical fact is lost, and return whether that is so."""

    def informed(self, then: Callable[[], None]) -> None:
        """Call ``then`` when people have told the facts that only they know."""

    def say(self, sentence: str) -> None:
        """Set the sentence about what the run waits for."""


class Arrival:
    """The goals that were told, and the time since when fresh readings are awaited.

    ``closing``: nobody attends any more, so the run ends whatever the check says. ``moved``: an
    operation has ended since the last look.
    """

    def __init__(
        self, run: LiveRun, goals: Sequence[Goal], trouble: Trouble, conduct: Conduct
    ) -> None:
        self.closing = self.moved = False
        self._run, self._goals = run, tuple(goals)
        self._trouble, self._conduct = trouble, conduct
        self._told: set[Goal] = set()
        self._since: float | None = None

    @property
    def _reached(self) -> list[Goal]:
        """The goals in order, up to the first one at which the run does not stand."""
        here, found = self._run.configuration, list[Goal]()
        for goal in self._goals:
            if here[goal[0]] != goal[1]:
                break
            found.append(goal)
        return found

    @property
    def open(self) -> bool:
        """Whether the run stands at a goal that was not told yet, or at all goals."""
        reached = self._reached
        return len(reached) == len(self._goals) or any(one not in self._told for one in reached)

    def begin(self, moved: bool = False) -> None:
        """Wait for readings that are newer than now."""
        self.moved = self.moved or moved
        if moved or self._since is None:
            self._since = self._run.time

    def forget(self) -> None:
        """Note that something has happened, so new readings are needed."""
        self._since = None

    def look(self) -> None:
        """Check the goals after a tick. Tell them if the check is true, and hold if it is not."""
        run, since = self._run, self._since
        if since is None:
            return
        run.look()
        if self._conduct.lost():
            return
        here = self._reached
        doubtful = any(run.check(*goal).truth is not True for goal in here)
        if self.closing and len(here) < len(self._goals):
            words = "The goals do not hold any more, and nobody is there to decide."
            self._conduct.finish("held", words)
        elif doubtful or run.broken():
            if run.time - since >= run.settle - HAIR:
                self.forget()
                self._conduct.informed(lambda: self._conduct.hold(self._trouble.unconfirmed(here)))
        else:
            late = run.senses.late(since, self._facts(here))
            names = ", ".join(map(goal_text, here))
            waits = f"{names} awaits a new reading of {', '.join(map(fact_text, late))}."
            self._conduct.say(waits if late else "")
            if not late:
                self._tell(here)

    def _tell(self, here: Sequence[Goal]) -> None:
        new = [goal for goal in here if goal not in self._told]
        arrived = self.moved or bool(new)
        self._told.update(new)
        self.moved, self._since = False, None
        for goal in new:
            self._run.tell("goal_reached", goal=goal_text(goal))
        word = "holds" if len(here) == 1 else "hold"
        whole = len(here) == len(self._goals)
        words = f"{', '.join(map(goal_text, here))} {word}." if whole else ""
        self._conduct.arrived(bool(new), arrived, words)

    def _facts(self, goals: Sequence[Goal]) -> set[FactKey]:
        """Return the facts that these goals depend on, and all critical facts."""
        run = self._run
        names = {branch for branch, _ in goals} | {name for name, _ in run.critical}
        below = {name for one in names for name in run.hierarchy.tree(one)}
        return {(n, d) for n in below for d in range(len(run.blueprint[n].flags))}
