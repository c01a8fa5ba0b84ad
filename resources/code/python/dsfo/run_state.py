"""The run state: whether the plan, a person or nobody lets the run move now."""

from __future__ import annotations

from collections.abc import Mapping

from .elements import FactKey
from .trouble import NO_ROUTE, Hold


class RunState:
    """The values that a run state follows from.

    ``once``: it carries out one operation and then waits again. ``frozen``: it is paused in the
    middle of a step. ``pausing``: it will pause when the operation has ended. ``stopped`` and
    ``taken_over``: who did it. ``offered`` is what giving back has found.
    """

    def __init__(self) -> None:
        self.by_hand = self.paused = self.pausing = self.once = self.frozen = False
        self.held: Hold | None = None
        self.taken_over = self.stopped = ""
        self.offered: Mapping[str, str] | None = None
        self.touched: list[FactKey] = []

    def phase(self, carrying: bool, asking: bool) -> str:
        """Return the run state in one word."""
        if self.stopped or self.taken_over:
            return "stopped" if self.stopped else "taken_over"
        if asking or carrying:
            return "paused" if self.frozen else "waiting" if asking else "running"
        if self.held is not None:
            return NO_ROUTE if self.held.kind == NO_ROUTE else "fault_hold"
        if self.paused or self.frozen:
            return "paused"
        return "ready" if self.by_hand and not self.once else "running"

    def pause(self, carrying: bool) -> None:
        """Pause. ``carrying`` says that a step is carried out or people are asked."""
        self.paused, self.pausing, self.once, self.frozen = True, False, False, carrying

    def resume(self) -> None:
        """Go on."""
        self.paused = self.pausing = self.frozen = self.once = False

    def step(self) -> None:
        """Carry out one operation, then wait again."""
        self.once, self.paused, self.pausing, self.frozen = True, False, False, False

    def begin(self, chosen: bool) -> None:
        """Note that a step begins. If a person chose it while the run held, it is paused
        afterwards.
        """
        if chosen and self.held is not None and not self.by_hand:
            self.paused = True
        self.held = None

    def hold(self, why: Hold) -> None:
        """Hold, because the run cannot go on by itself."""
        self.held = why
        self.once = self.pausing = self.paused = False

    def latch(self, stopped: str = "", taken_over: str = "") -> None:
        """Clear everything that would go on by itself."""
        self.resume()
        self.held, self.offered = None, None
        self.stopped, self.taken_over = stopped, taken_over
