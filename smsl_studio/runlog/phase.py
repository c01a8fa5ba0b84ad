"""The phase of a run: whether the plan, a person or nobody lets it move now."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Protocol

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
NO_ROUTE = "no_route"
"""The kind of a hold without a route, and the run state that it causes."""
_ENDS: Mapping[str, str] = MappingProxyType(
    {"goal_reached": "done", "no_route": NO_ROUTE, "stopped": "stopped", "refused": "idle"}
)


def phase_at_end(reason: str) -> str:
    """Return the state of a run that has ended for this reason."""
    return _ENDS.get(reason, "fault_hold")


class HoldKind(Protocol):
    """The part of a hold that the phase of a run depends on."""

    @property
    def kind(self) -> str:
        """The kind of the hold. ``no_route`` means that no permitted route leads to the goal."""


class RunMode:
    """The fields that the phase of a run follows from, besides the operations that are carried out.

    ``by_hand``: the run waits for requests. ``paused``: a person has paused it. ``once``: it
    carries out one operation and then waits again. ``frozen``: it is paused in the middle of a
    joint step. ``held``: why it cannot go on by itself. ``stopped`` and ``taken_over``: who did it.
    """

    __slots__ = ()
    by_hand: bool
    once: bool
    paused: bool
    frozen: bool
    held: HoldKind | None
    stopped: str
    taken_over: str

    def phase_while(self, carrying: bool, asking: bool) -> str:
        """Return the phase of a run that has begun and not ended, one of ``RUN_STATES``.

        ``carrying`` says that an operation is carried out, ``asking`` that people are asked.
        """
        if self.stopped:
            return "stopped"
        if self.taken_over:
            return "taken_over"
        if asking or carrying:
            if self.frozen:
                return "paused"
            return "waiting" if asking else "running"
        if self.held is not None:
            return NO_ROUTE if self.held.kind == NO_ROUTE else "fault_hold"
        if self.paused or self.frozen:
            return "paused"
        return "ready" if self.by_hand and not self.once else "running"

    @property
    def by(self) -> str:
        """The name of the person who has stopped the run or taken it over."""
        return self.stopped or self.taken_over
