"""The run state of a live run, and what commands and holds make of it."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.dispatch.execution.trouble import Hold
from smsl_studio.runlog.phase import RunMode


class RunState(RunMode):
    """What a run state is made of, and how it becomes another.

    ``pausing``: it will be paused when the running operation has ended. ``offered``: the
    configuration that giving back found. ``touched``: the facts that a stop may have left anywhere.
    ``too_late``: the edge for which a veto came too late.
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

    # pausing and going on -----------------------------------------------------------------------

    def pause(self, carrying: bool) -> None:
        """A person paused it; ``carrying``: in the middle of a step, or while people are asked."""
        self.paused, self.pausing, self.once, self.frozen = True, False, False, carrying

    def pause_later(self) -> None:
        """It will be paused when the running operation has ended."""
        self.pausing = True

    def resume(self) -> None:
        """It goes on."""
        self.paused = self.pausing = self.frozen = self.once = False

    def step(self) -> None:
        """One operation, then wait again."""
        self.once, self.paused, self.pausing, self.frozen = True, False, False, False

    def stepped(self) -> None:
        """The one operation is over."""
        self.once = False

    def thaw(self) -> None:
        """What a pause held in the middle is held no more."""
        self.frozen = False

    def follow(self, route: bool) -> None:
        """Follow the route by itself, or wait to be asked."""
        self.by_hand = not route

    def begin(self, chosen: bool) -> None:
        """A step begins. One that a person chose in a run that holds leaves it paused."""
        if chosen:
            self.paused |= self.held is not None and not self.by_hand
        self.held, self.too_late = None, None

    # holding ------------------------------------------------------------------------------------

    def hold(self, why: Hold) -> None:
        """It cannot go on by itself."""
        self.held = why
        self.once = self.pausing = self.paused = False

    def release(self) -> None:
        """It holds no longer."""
        self.held = None

    def come_too_late(self, address: Address) -> None:
        """A veto of this operation came too late."""
        self.too_late = address

    # latches ------------------------------------------------------------------------------------

    def stop(self, by: str, touched: tuple[FactKey, ...]) -> None:
        """Latched; ``touched`` are the facts that it may have left anywhere."""
        self._latch()
        self.taken_over, self.stopped, self.touched = "", by, touched

    def reset(self) -> tuple[FactKey, ...]:
        """Unlatched, to paused and no further; the facts that the stop may have left anywhere."""
        touched, self.touched, self.stopped = self.touched, (), ""
        self.pause(carrying=False)
        return touched

    def take_over(self, by: str) -> None:
        """Automation is locked out."""
        self._latch()
        self.taken_over = by

    def offer(self, configuration: Mapping[str, str] | None) -> None:
        """What giving back found, to be accepted; None: nothing."""
        self.offered = configuration

    def give_back(self) -> None:
        """Nobody has taken over any more; by hand it is ready, else paused."""
        self._latch()
        self.taken_over = ""
        self.paused = not self.by_hand

    def show_map(self, on: bool) -> None:
        """A supervisor sees the whole map, or no longer."""
        self.full_map = on

    def _latch(self) -> None:
        """Nothing that was going on or wanted goes on by itself."""
        self.resume()
        self.held, self.offered, self.too_late = None, None, None
