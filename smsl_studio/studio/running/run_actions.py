"""What the keys of a run ask for."""

from __future__ import annotations

from typing import Protocol


class RunActions(Protocol):
    """What actions ask of the run, in every mode."""

    def play(self) -> None: ...
    def pause(self) -> None: ...
    def step(self) -> None: ...
    def show_monitor(self) -> None: ...
