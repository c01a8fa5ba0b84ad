"""The effects on the whole run that a part of it may cause, without knowing the driver."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

from smsl_studio.blueprint.joint import JointStep
from smsl_studio.dispatch.execution.trouble import Hold


class Conduct(Protocol):
    """A run that can begin a step, hold, pause and end."""

    def begin(self, step: JointStep, chosen: bool) -> None:
        """Carry out a step from this tick on. All guards have agreed. ``chosen`` says that a person
        asked for it.
        """

    def hold(self, hold: Hold | None) -> None:
        """Let nothing move until somebody decides. None does nothing."""

    def finish(
        self, reason: str, sentence: str, refusals: Sequence[Mapping[str, str]] = ()
    ) -> None:
        """End the run. Each of the ``refusals`` has a code and a sentence."""

    def arrived(self, new: bool, moved: bool, sentence: str) -> None:
        """Note that the run stands at goals, after a fresh check. ``new`` says that one of them is
        told for the first time. ``moved`` says that, or that an operation has ended there.
        ``sentence`` names all goals if all hold, and is empty otherwise.
        """

    def say(self, sentence: str) -> None:
        """Set the sentence about what the run waits for."""

    def paused_or_held(self, why: str) -> None:
        """Pause, because the person or agent who was asked wants so. Without attendance, hold."""

    def taken_over(self, by: str, why: str) -> None:
        """Lock the automation out, because ``by`` wants so. Without attendance, hold."""

    def withdraw(self) -> None:
        """Withdraw what was proposed."""
