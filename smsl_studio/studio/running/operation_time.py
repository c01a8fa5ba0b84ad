"""The time for which a run shows an operation that takes no time of its own.

The table world carries out an operation in one tick, which nobody can follow. So the runner waits
before this tick for the declared duration of the operation. Only wall time passes: the events and
the simulated time of the run stay the same.
"""

from __future__ import annotations

from dataclasses import dataclass
from time import monotonic

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.supervision.row import PAUSE, TERMS
from smsl_studio.world.engines import TABLE

WHY = (
    "It is shown for this time, so that it can be followed. "
    "In the simulated time of the run, below, it takes one tick"
)
USUAL = 1.0
"""Seconds for which an operation is shown that declares no duration."""


@dataclass(frozen=True, slots=True)
class ShownTime:
    """How long the running operation has been shown, and for how long it will be (s, at speed 1).

    ``declared`` says that the blueprint declares this duration.
    """

    address: Address
    elapsed: float
    whole: float
    declared: bool

    @property
    def share(self) -> float:
        """The share of the time that has passed, from 0 to 1."""
        return min(self.elapsed / self.whole, 1.0) if self.whole > 0 else 1.0

    @property
    def words(self) -> str:
        """The time in words, such as ``0.4 of 1.0 s``."""
        return f"{min(self.elapsed, self.whole):.1f} of {self.whole:.1f} s"

    @property
    def said(self) -> str:
        """The same time, told apart from the simulated time of the run."""
        return f"shown for {self.words}"


def shown_duration(blueprint: Blueprint, address: Address) -> tuple[float, bool]:
    """The seconds for which an operation is shown, and whether the blueprint declares them."""
    note = blueprint[address.branch].operation_note(address.state, address.operation)
    return (USUAL, False) if note.duration is None else (note.duration, True)


class OperationTime:
    """Counts the shown time of the operation that is under way. The thread of the run calls it.

    ``shown`` may be read from any thread. It is None while nothing has to be shown.
    """

    def __init__(self, blueprint: Blueprint | None) -> None:
        self._blueprint = blueprint
        self.shown: ShownTime | None = None
        self._counted: float | None = None
        self._address: Address | None = None

    def follow(self, dispatcher: Dispatcher) -> None:
        """Look after a tick which operation is under way; a new one is shown from its begin."""
        opened, address = dispatcher.opened, dispatcher.under_way
        if opened is None or opened.world != TABLE or self._blueprint is None:
            return
        self._counted = None
        if dispatcher.phase != "paused" and address != self._address:
            self._address, self.shown = address, None
            if address is not None:
                whole, declared = shown_duration(self._blueprint, address)
                self.shown = ShownTime(address, 0.0, whole, declared)

    def left(self, dispatcher: Dispatcher, speed: float) -> float:
        """Wall seconds to wait before the next tick; 0 to tick at once.

        A command that ends or holds the operation, or lets something go wrong, does not wait.
        """
        shown = self.shown
        if shown is None or shown.share >= 1.0 or dispatcher.under_way is None:
            return 0.0
        if any(_is_urgent(command.row.rank) or command.address == shown.address
               for command in dispatcher.waiting):  # fmt: skip
            return 0.0
        now = monotonic()
        passed = 0.0 if self._counted is None else (now - self._counted) * speed
        self._counted = now
        elapsed = min(shown.elapsed + passed, shown.whole)
        self.shown = ShownTime(shown.address, elapsed, shown.whole, shown.declared)
        return (shown.whole - elapsed) / speed


def _is_urgent(rank: int) -> bool:
    return rank <= PAUSE and rank != TERMS
