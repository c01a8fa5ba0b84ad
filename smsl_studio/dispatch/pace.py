"""Pace: who lets the run move now, the plan, a person, or nobody."""

from __future__ import annotations


class Pace:
    """The five words a run's phase is made of.

    ``by_hand``: it waits to be asked. ``paused``: a person stopped it. ``pausing``: it will be
    paused when the running operation has ended. ``once``: one operation, then wait again.
    ``frozen``: paused in the middle of a joint step. ``held``: why a person must decide.
    """

    def __init__(self, by_hand: bool) -> None:
        self.by_hand = by_hand
        self.paused = self.pausing = self.once = self.frozen = False
        self.held = ""

    def phase(self, carrying: bool) -> str:
        """``ready``, ``running``, ``paused`` or ``held``."""
        if carrying and not self.frozen:
            return "running"
        if self.held:
            return "held"
        if self.paused or self.frozen:
            return "paused"
        return "ready" if self.by_hand and not self.once else "running"

    def pause(self, carrying: bool) -> None:
        self.paused, self.pausing, self.frozen = True, False, carrying

    def resume(self) -> None:
        self.paused = self.pausing = self.frozen = self.once = False

    def step(self) -> None:
        self.once, self.paused, self.frozen = True, False, False
