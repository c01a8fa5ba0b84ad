"""The commands to a run: what each does, and the run states that refuse it.

A command waits for the next tick. There one event answers it, and its effects follow. An effect
returns why it was not carried out, or the empty text.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from . import effects, latches
from .driver import Driver
from .errors import WorldGone

PERSON = "a person"
OPEN = ("ready", "running", "paused", "waiting", "no_route", "taken_over", "fault_hold", "stopped")
STOP, TAKE_OVER, FAULT, TERMS, PAUSE, STEP, RUN = range(7)
"""The ranks: of the commands of one tick, those with a smaller rank come first."""

_STOPPED = "the run is stopped, reset it first"
_TAKEN = "{by} has taken over, automation is locked out until it is given back"
_ASKED = "people are being asked, it goes on when they have answered"
_HOLDS = "the run holds already"
_LOCKED = {"taken_over": _TAKEN, "stopped": _STOPPED}


def _only(words: str, *phases: str) -> dict[str, str]:
    return {phase: words for phase in OPEN if phase not in phases}


@dataclass(frozen=True)
class Row:
    """One command of the table.

    ``refused`` has the run states that refuse it. One that ``sets_going`` is refused if one that
    ``holds_back`` came before it in the same tick; ``stands`` says that it holds back even if it
    was refused. ``needs`` and ``may`` are its arguments. ``free`` allows any others.
    """

    effect: Callable[..., str]
    refused: Mapping[str, str] = field(default_factory=dict)
    needs: tuple[str, ...] = ()
    may: tuple[str, ...] = ()
    free: bool = False
    value: str = ""
    rank: int = RUN
    sets_going: bool = False
    holds_back: bool = False
    stands: bool = False


TABLE: Mapping[str, Row] = {
    "ask": Row(effects.ask, {**_LOCKED, "waiting": _ASKED}, needs=("address",), sets_going=True),
    "pause": Row(
        effects.pause,
        {**_LOCKED, "paused": "it is paused already", "no_route": _HOLDS, "fault_hold": _HOLDS},
        rank=PAUSE,
        holds_back=True,
        stands=True,
    ),
    "resume": Row(
        effects.resume,
        {**_LOCKED, "running": "it runs already", "waiting": _ASKED},
        sets_going=True,
    ),
    "step": Row(
        effects.step, {**_LOCKED, "waiting": _ASKED}, rank=STEP, sets_going=True, holds_back=True
    ),
    "set_automatic": Row(
        effects.set_automatic, _LOCKED, needs=("automatic",), value="automatic", sets_going=True
    ),
    "veto": Row(effects.veto, _LOCKED, may=("address",), rank=TERMS),
    "prune": Row(effects.prune, needs=("address", "reason"), rank=TERMS),
    "restore": Row(effects.restore, needs=("address",), rank=TERMS),
    "set_cost": Row(effects.set_cost, needs=("address", "cost"), value="cost", rank=TERMS),
    "take_over": Row(
        latches.take_over,
        {"taken_over": "{by} has taken over already", "stopped": _STOPPED},
        rank=TAKE_OVER,
        holds_back=True,
        stands=True,
    ),
    "give_back": Row(
        latches.give_back, _only("nobody has taken over", "taken_over"), sets_going=True
    ),
    "accept": Row(latches.accept, _only("nobody has taken over", "taken_over"), sets_going=True),
    "adopt": Row(
        latches.adopt, _only("the run does not hold on a mismatch", "fault_hold"), sets_going=True
    ),
    "stop": Row(
        latches.stop, {"stopped": "it is stopped already"}, rank=STOP, holds_back=True, stands=True
    ),
    "reset": Row(latches.reset, _only("the run is not stopped", "stopped"), sets_going=True),
    "end": Row(
        latches.end,
        _only(
            "only a run that is stopped or holds can be ended, stop it first",
            "stopped",
            "no_route",
            "fault_hold",
        ),
    ),
    "answer": Row(effects.answer, needs=("option",), may=("kind", "address", "role"), value="task"),
    "full_map": Row(effects.full_map, needs=("on",), value="on"),
    "disturb": Row(
        effects.disturb, needs=("target", "kind"), free=True, value="target kind", rank=FAULT
    ),
    "inject": Row(effects.inject, needs=("fault",), free=True, value="fault", rank=FAULT),
}
"""Every command by its word."""


@dataclass(frozen=True)
class Command:
    """A command that somebody gave, with its arguments by name."""

    word: str
    by: str
    said: Mapping[str, Any]

    @property
    def row(self) -> Row:
        """Its row in the table."""
        return TABLE[self.word]

    def told(self, refused: str) -> dict[str, Any]:
        """Return the values of the event that answers it."""
        names_edge = "address" in (*self.row.needs, *self.row.may) and self.word != "answer"
        value = " ".join(_text(self.said.get(key, "")) for key in self.row.value.split())
        return {
            "command": self.word,
            "by": self.by,
            "address": (self.said.get("address") or "") if names_edge else "",
            "value": value,
            "reason": self.said.get("reason", "") if self.word in ("prune", "veto") else "",
            "refused": refused,
        }


def _text(value: object) -> str:
    if isinstance(value, bool):
        return "on" if value else "off"
    return str(float(value)) if isinstance(value, (int, float)) else str(value)


def obey(driver: Driver, commands: list[Command]) -> None:
    """Carry out the commands of one tick, in order of rank, and answer each."""
    done: list[Command] = []
    gone: WorldGone | None = None
    for one in sorted(commands, key=lambda command: command.row.rank):
        command, at = one, len(driver.run.events)
        try:
            refused = gone.sentence if gone is not None else _why_not(driver, command, done)
            if not refused:
                command = _meant(driver, command)
                refused = command.row.effect(driver, by=command.by, **command.said)
        except WorldGone as error:
            gone, refused = error, f"the world is gone: {error.sentence}"
        if not refused or command.row.stands:
            done.append(command)
        told = {"event": "commanded", "t": driver.run.time, **command.told(refused)}
        driver.run.events.insert(at, told)
    if gone is not None:
        raise gone


def refuse(driver: Driver, commands: list[Command], reason: str) -> None:
    """Refuse commands that cannot be carried out any more."""
    for command in commands:
        driver.run.tell("commanded", **command.told(reason))


def _why_not(driver: Driver, command: Command, done: list[Command]) -> str:
    if driver.ended is not None:
        return "the run is over"
    by = driver.state.taken_over
    words = command.row.refused.get(driver.phase, "").format(by=by[:1].upper() + by[1:])
    before = [one for one in done if one.row.holds_back and one.row.rank < command.row.rank]
    if not words and before and command.row.sets_going:
        word = before[0].word.replace("_", " ")
        return f"{word} came at the same tick and counts more"
    return words


def _meant(driver: Driver, command: Command) -> Command:
    """Return the command with its operation: a veto that names none means the next one."""
    if command.word != "veto" or command.said.get("address"):
        return command
    return replace(command, said={**command.said, "address": effects.next_edge(driver)})
