"""The run state: who lets the run move now, the plan, a person, or nobody."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.dispatch.trouble import NO_ROUTE, Hold

RUN_STATES = (
    "idle",
    "ready",
    "running",
    "paused",
    "waiting",
    "no_route",
    "taken_over",
    "fault_hold",
    "stopped",
    "done",
)


class RunState:
    """What a run state is made of.

    ``by_hand``: it waits to be asked. ``paused``: a person paused it. ``pausing``: it will be
    paused when the running operation has ended. ``once``: one operation, then wait again.
    ``frozen``: paused in the middle of a joint step. ``held``: why it cannot go on by itself.
    ``taken_over``, ``stopped``: who did it. ``offered``: the configuration that giving back
    found. ``touched``: the facts that a stop may have left anywhere. ``too_late``: the edge for
    which a veto came too late.
    """

    def __init__(self, by_hand: bool) -> None:
        self.by_hand = by_hand
        self.paused = self.pausing = self.once = self.frozen = False
        self.held: Hold | None = None
        self.taken_over = self.stopped = ""
        self.offered: Mapping[str, str] | None = None
        self.touched: tuple[FactKey, ...] = ()
        self.too_late: Address | None = None
        self.full_map = False

    def phase(self, carrying: bool, asking: bool = False) -> str:
        """One of ``RUN_STATES`` between ``ready`` and ``stopped``; ``asking``: people are asked."""
        if self.stopped:
            return "stopped"
        if self.taken_over:
            return "taken_over"
        if asking or carrying:
            if self.frozen:
                return "paused"
            return "waiting" if asking else "running"
        if self.held is not None:
            return "no_route" if self.held.kind == NO_ROUTE else "fault_hold"
        if self.paused or self.frozen:
            return "paused"
        return "ready" if self.by_hand and not self.once else "running"

    @property
    def by(self) -> str:
        """Who has stopped it or taken it over."""
        return self.stopped or self.taken_over

    def pause(self, carrying: bool) -> None:
        self.paused, self.pausing, self.once, self.frozen = True, False, False, carrying

    def resume(self) -> None:
        self.paused = self.pausing = self.frozen = self.once = False

    def step(self) -> None:
        self.once, self.paused, self.pausing, self.frozen = True, False, False, False

    def latch(self) -> None:
        """Nothing that was going on or wanted goes on by itself."""
        self.resume()
        self.held, self.offered, self.too_late = None, None, None
