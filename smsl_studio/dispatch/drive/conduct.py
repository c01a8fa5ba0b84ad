"""What a part of a run may have the whole run do, without knowing who drives it."""

from __future__ import annotations

from typing import Protocol

from smsl_studio.blueprint.joint import JointStep
from smsl_studio.dispatch.execution.trouble import Hold


class Conduct(Protocol):
    """A run that can be held, ended, paused, or told to begin a step."""

    def begin(self, step: JointStep, chosen: bool) -> None:
        """Carry a step out from this tick on; every guard was asked. ``chosen``: by a person."""

    def hold(self, hold: Hold | None) -> None:
        """Nobody moves until someone decides; None does nothing."""

    def finish(self, reason: str, sentence: str) -> None:
        """The run is over."""

    def arrived(self, new: bool, moved: bool, sentence: str) -> None:
        """The run stands at goals, confirmed by a fresh check. ``new``: one was not told before;
        ``moved``: that, or an operation led there. ``sentence`` has all goals where all hold."""

    def say(self, sentence: str) -> None:
        """What the run waits for now, for people."""

    def paused_or_held(self, why: str) -> None:
        """Whoever is asked about an operation wants a pause; unattended, the run is over."""

    def withdraw(self) -> None:
        """What was proposed is so no longer."""
