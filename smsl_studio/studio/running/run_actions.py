"""What the actions of the window may ask of the run."""

from __future__ import annotations

from typing import Protocol


class RunActions(Protocol):
    """The requests that actions send to the run, in every mode."""

    def play(self) -> None:
        """Continue the run; without a run, begin one."""

    def pause(self) -> None:
        """Pause the run."""

    def step(self) -> None:
        """Carry out one operation, then pause; without a run, begin one."""

    def show_monitor(self) -> None:
        """Show the monitor page."""
