"""What the keys of a run ask for."""

from __future__ import annotations

from typing import Protocol


class RunActions(Protocol):
    """What actions ask of the run, in every mode."""

    def play(self) -> None:
        """Let the run go on; without a run, begin one."""

    def pause(self) -> None:
        """Pause the run."""

    def step(self) -> None:
        """Do one operation, then pause; without a run, begin one."""

    def show_monitor(self) -> None:
        """Show the monitor page."""
