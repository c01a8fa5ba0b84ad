"""Where a joint step stands, and how it ends where it does not succeed."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from smsl_studio.blueprint.edges import Edge
from smsl_studio.host.protocol import Outcome, Tick

ENDED = {
    Outcome.RETURNED: "returned",
    Outcome.FAILED: "failed",
    Outcome.RAISED: "raised",
    Outcome.IDLE: "lost",
}
"""What is told of the end of a function."""


class ActionStage(Enum):
    """Where the current action stands."""

    NEXT = "next"
    RUNNING = "running"
    ASKING = "asking"
    SETTLING = "settling"
    DONE = "done"
    FAILED = "failed"


@dataclass(frozen=True)
class StepFailure:
    """Why a joint step ended early. ``risky`` says that the operation itself is to blame,
    ``unanswered`` that people were asked and did not say what it needed. ``lost`` are the
    sentences about facts that it rested on and that were false or unknown meanwhile."""

    edge: Edge
    reason: str
    risky: bool
    pending: bool
    unanswered: bool = False
    lost: tuple[str, ...] = ()


def fault_words(edge: Edge, tick: Tick) -> str:
    """Why a function failed; empty where it returned."""
    words = f": {tick.message}" if tick.message else ""
    if tick.outcome is Outcome.FAILED:
        return f"{edge} failed{words}" if words else f"{edge} says that it failed"
    if tick.outcome is Outcome.RAISED:
        return f"{edge} raised an error{words}"
    if tick.outcome is Outcome.IDLE:
        return f"{edge} was lost by the host"
    return ""
