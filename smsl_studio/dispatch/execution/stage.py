"""The stage of a joint step, and the reason of its failure."""

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
"""The words for the end of a function."""


class ActionStage(Enum):
    """The stage of the current action."""

    NEXT = "next"
    RUNNING = "running"
    ASKING = "asking"
    SETTLING = "settling"
    DONE = "done"
    FAILED = "failed"


NEXT, RUNNING, ASKING, SETTLING, DONE, FAILED = ActionStage
"""The same stages as plain names, because an attribute of an enumeration is slow to look up."""


@dataclass(frozen=True)
class StepFailure:
    """Why a joint step has failed.

    ``risky`` says that the operation itself is to blame. ``pending`` says that it failed during a
    crossing. ``unanswered`` says that people did not answer a question. ``lost`` has sentences
    about the needed facts that were false or unknown meanwhile. ``hazards`` are the names of the
    hazards that were met, or that refused the next function.
    """

    edge: Edge
    reason: str
    risky: bool
    pending: bool
    unanswered: bool = False
    lost: tuple[str, ...] = ()
    hazards: tuple[str, ...] = ()


def fault_words(edge: Edge, tick: Tick) -> str:
    """Return why a function failed, or the empty text if it returned."""
    words = f": {tick.message}" if tick.message else ""
    if tick.outcome is Outcome.FAILED:
        return f"{edge} failed{words}" if words else f"{edge} says that it failed"
    if tick.outcome is Outcome.RAISED:
        return f"{edge} raised an error{words}"
    if tick.outcome is Outcome.IDLE:
        return f"{edge} was lost by the host"
    return ""
