"""The run state of a live run, and its changes by commands and holds."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.dispatch.execution.trouble import Hold
from smsl_studio.runlog.phase import RunMode


class RunState(RunMode):
    """The values that a run state follows from, and their changes.

    ``pausing`` says that the run will pause when the running operation has ended. ``offered`` is
    the configuration that giving back found. ``touched`` are the facts that a stopped operation may
    have changed. ``too_late`` is the edge for which a veto came too late.
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
        """Pause. ``carrying`` says that a step is carried out or people are asked."""
        self.paused, self.pausing, self.once, self.frozen = True, False, False, carrying

    def pause_later(self) -> None:
        """Pause when the running operation has ended."""
        self.pausing = True

    def resume(self) -> None:
        """Go on."""
        self.paused = self.pausing = self.frozen = self.once = False

    def step(self) -> None:
        """Carry out one operation, then wait again."""
        self.once, self.paused, self.pausing, self.frozen = True, False, False, False

    def stepped(self) -> None:
        """Note that the single operation is over."""
        self.once = False

    def thaw(self) -> None:
        """Note that no step is frozen by a pause any more."""
        self.frozen = False

    def follow(self, route: bool) -> None:
        """Follow the route without requests, or wait for requests."""
        self.by_hand = not route

    def begin(self, chosen: bool) -> None:
        """Note that a step begins. If a person chose it while the run held, the run is paused
        afterwards.
        """
        if chosen:
            self.paused |= self.held is not None and not self.by_hand
        self.held, self.too_late = None, None

    # holding ------------------------------------------------------------------------------------

    def hold(self, why: Hold) -> None:
        """Hold, because the run cannot go on by itself."""
        self.held = why
        self.once = self.pausing = self.paused = False

    def release(self) -> None:
        """End the hold."""
        self.held = None

    def come_too_late(self, address: Address) -> None:
        """Note that a veto of this operation came too late."""
        self.too_late = address

    # latches ------------------------------------------------------------------------------------

    def stop(self, by: str, touched: tuple[FactKey, ...]) -> None:
        """Latch a stop. ``touched`` are the facts that the stopped operation may have changed."""
        self._latch()
        self.taken_over, self.stopped, self.touched = "", by, touched

    def reset(self) -> tuple[FactKey, ...]:
        """Release the stop to paused. Return the facts that the stopped operation may have
        changed.
        """
        touched, self.touched, self.stopped = self.touched, (), ""
        self.pause(carrying=False)
        return touched

    def take_over(self, by: str) -> None:
        """Lock automation out."""
        self._latch()
        self.taken_over = by

    def offer(self, configuration: Mapping[str, str] | None) -> None:
        """Set the configuration that giving back found, None for nothing."""
        self.offered = configuration

    def give_back(self) -> None:
        """End a take-over. The run is then ready if it is run by hand, else paused."""
        self._latch()
        self.taken_over = ""
        self.paused = not self.by_hand

    def show_map(self, on: bool) -> None:
        """Show the whole map to the supervisor, or only the partial view."""
        self.full_map = on

    def _latch(self) -> None:
        """Clear everything that would go on by itself."""
        self.resume()
        self.held, self.offered, self.too_late = None, None, None
