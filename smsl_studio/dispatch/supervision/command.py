"""A command: what somebody said to a run, and the order in which commands of one tick count."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from smsl_studio.blueprint.address import Address

PERSON = "a person"

STOP, TAKE_OVER, FAULT, TERMS, PAUSE, STEP, RUN = range(7)
"""Ranks: stop > take over > fault > veto > pause > step > run. ``TERMS`` is veto and all else that
is said about edges."""

RANKS: Mapping[str, int] = {
    "stop": STOP,
    "take_over": TAKE_OVER,
    "inject": FAULT,
    "disturb": FAULT,
    "veto": TERMS,
    "prune": TERMS,
    "restore": TERMS,
    "set_cost": TERMS,
    "pause": PAUSE,
    "step": STEP,
}
"""Every other command has the rank ``RUN``."""

HOLDS_BACK = ("stop", "take_over", "pause", "step")
STANDS = ("stop", "take_over", "pause")
"""What holds back others even where it changes nothing: whoever says it wants the run to stand."""

SETS_GOING = ("step", "ask", "resume", "give_back", "accept", "adopt", "reset", "set_automatic")


@dataclass(frozen=True, slots=True)
class Command:
    """``word`` is the method of the dispatcher that was called, ``by`` who called it.

    ``value`` and ``reason`` are what the record says of it; ``parameters`` are those of a
    disturbance or a fault.
    """

    word: str
    by: str = PERSON
    address: Address | None = None
    value: str = ""
    reason: str = ""
    parameters: Mapping[str, Any] = field(default_factory=dict)

    @property
    def rank(self) -> int:
        return RANKS.get(self.word, RUN)


def in_order(commands: Iterable[Command]) -> list[Command]:
    """The commands of one tick as they count: by rank, and as they came."""
    return sorted(commands, key=lambda command: command.rank)
