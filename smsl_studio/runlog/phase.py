"""The phase of a run: who lets it move now, the plan, a person, or nobody."""

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
"""A hold of this kind, and the run state in which it leaves a run."""
_ENDS: Mapping[str, str] = MappingProxyType(
    {"goal_reached": "done", "no_route": NO_ROUTE, "stopped": "stopped", "refused": "idle"}
)


def phase_at_end(reason: str) -> str:
    """The run state in which a run ended for this reason."""
    return _ENDS.get(reason, "fault_hold")


class HoldKind(Protocol):
    """Why a run holds, as far as its phase depends on it."""

    @property
    def kind(self) -> str:
        """``no_route`` where nothing permitted leads to the goal."""


class RunMode:
    """What the phase of a run follows from, besides what is carried out.

    ``by_hand``: it waits to be asked. ``paused``: a person paused it. ``once``: one operation, then
    wait again. ``frozen``: paused in the middle of a joint step. ``held``: why it cannot go on by
    itself. ``taken_over``, ``stopped``: who did it.
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
        """One of ``RUN_STATES`` between ``ready`` and ``stopped``, while an operation is carried
        out (``carrying``) or people are asked (``asking``)."""
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
        """Who has stopped it or taken it over."""
        return self.stopped or self.taken_over
