"""The verbs of supervision: every command of the dispatcher, in the name of who works here.

A command is queued and taken at the next tick; whether it was done, or refused and why, is told by
the run's events (``commanded``).
"""

from __future__ import annotations

from abc import abstractmethod
from inspect import signature
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.studio.running.inbox import Command

SOMEBODY = "a person"


def nobody_named() -> str:
    """Where nobody said who works here."""
    return SOMEBODY


class Verbs:
    """What a run can be told to do. ``who`` names the person in whose name it is done."""

    who = staticmethod(nobody_named)

    @abstractmethod
    def _command(self, command: Command, word: str = "") -> None:
        """Have the run obey before its next tick; ``word`` is what the command is called."""

    def command(self, word: str, *said: Any, by: str = "") -> None:
        """Any command by its word."""
        name = by or self.who()

        def obey(dispatcher: Dispatcher) -> None:
            verb = getattr(dispatcher, word)
            if "by" in signature(verb).parameters:
                verb(*said, by=name)
            else:
                verb(*said)

        self._command(obey, word)

    def play(self) -> None:
        """Go on: after a pause, after a hold, by hand along the route."""
        self.command("resume")

    def pause(self) -> None:
        self.command("pause")

    def step(self) -> None:
        self.command("step")

    def stop(self) -> None:
        self.command("stop")

    def reset(self) -> None:
        """Unlatch a stop; the run is paused then."""
        self.command("reset")

    def end(self) -> None:
        """Finish a run that is stopped or holds."""
        self.command("end")

    def ask(self, address: Address) -> None:
        """Carry out an operation that a person chose."""
        self.command("ask", address)

    def veto(self, address: Address | None = None) -> None:
        """Have the next operation, or this one, skipped once."""
        self.command("veto", address)

    def prune(self, address: Address, reason: str) -> None:
        self.command("prune", address, reason)

    def restore(self, address: Address) -> None:
        self.command("restore", address)

    def take_over(self) -> None:
        """Lock the automation out; it only observes then."""
        self.command("take_over")

    def give_back(self) -> None:
        """Have the scene located."""
        self.command("give_back")

    def accept(self) -> None:
        """Go on from the state that was located."""
        self.command("accept")

    def adopt(self) -> None:
        """While held: take the one configuration that the scene agrees with."""
        self.command("adopt")

    def answer(self, task: str, option: str, name: str, role: str = "") -> None:
        """What a person says to a task."""
        self.command("answer", task, option, role, by=name)

    def full_map(self, on: bool) -> None:
        """Say that the whole of an SB is shown from now on, or no longer; it is recorded."""
        self.command("full_map", on)

    def disturb(self, target: str, kind: str, **parameters: float | str) -> None:
        """Disturb a sensor, or all of one fact (``SB/digit``); ``none`` ends it."""
        name = self.who()
        self._command(lambda one: one.disturb(target, kind, by=name, **parameters))

    def inject(self, fault: str, **parameters: float | str) -> None:
        """Have something go wrong in the world (``faults`` has the names)."""
        name = self.who()
        self._command(lambda one: one.inject(fault, by=name, **parameters))

    def set_automatic(self, automatic: bool) -> None:
        self.command("set_automatic", automatic)
