"""The words of a script: the commands of the table in ``dispatch``, and the checks of their
arguments."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from smsl_studio.blueprint.address import Address, split_fact
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.procedures import procedures_of
from smsl_studio.dispatch.people.task import KINDS as TASKS
from smsl_studio.dispatch.supervision.row import (
    AMOUNT,
    DISTURBANCE,
    EDGE,
    SENSED,
    SWITCH,
    TASK,
    TEXT,
    Command,
    CommandRow,
)
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import StudioError, UsageError, did_you_mean
from smsl_studio.front.script.addresses import operations_at, state_at
from smsl_studio.front.script.script import MOMENT, WITH
from smsl_studio.monitor.disturbance import KINDS as DISTURBANCES

Json = Any
Check = Callable[[Blueprint, Json], Json]
LONGEST, NAME = 1000, 1 << 16
LARGEST = 1e9
"""The largest lengths of a text and of what may contain names, in characters, and the limit of
simulated seconds and costs. 1e9 seconds are 30 years, and still exact in microseconds."""


@dataclass(frozen=True, slots=True)
class ScriptWord:
    """A word of ``do``, with the keys that it needs and that it may have.

    ``free`` allows any other key with a scalar value. ``row`` is the command of the word; it is
    None for a word that acts before the run. ``says`` are arguments that the word itself contains.
    """

    needs: Mapping[str, Check]
    may: Mapping[str, Check] = field(default_factory=dict)
    free: bool = False
    row: CommandRow | None = None
    says: Mapping[str, Json] = field(default_factory=dict)

    def check_of(self, key: str) -> Check | None:
        """Return the check for the value of a key. None if the command does not take this key."""
        known = self.needs.get(key) or self.may.get(key)
        return known or (scalar if self.free else None)

    def command(self, given: Mapping[str, Json], by: str, **more: Json) -> Command:
        """Return the command of a line of a script. ``more`` are arguments that the line does not
        have."""
        assert self.row is not None, "it is said before the run"
        said = {**self.says, **more, **given}
        for key, argument in self.row.arguments.items():
            if argument.kind == EDGE and key in said:
                said[key] = Address(*Address.split(said[key]))
        return self.row.command(**said, by=by)


def operation(blueprint: Blueprint, value: Json) -> str:
    """Return the full address of exactly one operation. UsageError for several, AddressError for
    none."""
    found = operations_at(blueprint, [_name(value)])
    if len(found) != 1:
        raise UsageError(
            f"{value!r} stands for {len(found)} operations", advice="Write SB/State/Operation."
        )
    return str(found[0])


def state(blueprint: Blueprint, value: Json) -> str:
    """Return the full address of a state. AddressError or UsageError as in ``state_at``."""
    return str(state_at(blueprint, _name(value)))


def text(_: Blueprint, value: Json) -> str:
    """Return a text that is not empty and fits one line. UsageError for any other value."""
    return _name(value, LONGEST)


def _name(value: Json, longest: int = NAME) -> str:
    if not isinstance(value, str) or not value.strip():
        raise UsageError(f"{_shown(value)} is no text", advice='Write it in quotes: "...".')
    if not value.isprintable() or len(value) > longest:
        raise UsageError(f"{_shown(value)} cannot be printed in a line")
    return value


def seconds(_: Blueprint, value: Json) -> float:
    """Return a time (s) or a cost from 0 to ``LARGEST``. UsageError for any other value."""
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0 <= value < LARGEST:
        raise UsageError(
            f"{_shown(value)} is no number from 0 to {LARGEST:g}", advice="Write it like 2.5."
        )
    return float(value)


def yes_or_no(_: Blueprint, value: Json) -> bool:
    """Return True or False. UsageError for any other value."""
    if not isinstance(value, bool):
        raise UsageError(f"{_shown(value)} is neither yes nor no", advice="Write true or false.")
    return value


def scalar(_: Blueprint, value: Json) -> Json:
    """Return a text or a number, as a parameter of a fault may be. UsageError for any other
    value."""
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise UsageError(f"{_shown(value)} is neither a text nor a number")
    if isinstance(value, str):
        return _name(value) if value else value
    if not abs(value) < LARGEST:
        raise UsageError(f"{_shown(value)} is too large")
    return value


def sensed(blueprint: Blueprint, value: Json) -> str:
    """Return the name of a sensor, or a fact ``SB/digit`` that exists in the blueprint or in one
    that an operation runs. UsageError for an unknown fact."""
    fact = split_fact(_name(value))
    if fact is not None:
        branch = blueprint.branches.get(fact[0]) or _branch_below(blueprint, fact[0])
        if branch is None or not branch.table or fact[1] >= branch.num_facts:
            near = did_you_mean(fact[0], blueprint.branches) if branch is None else ""
            raise UsageError(f"there is no fact {value!r}", advice=near or "Write SB/digit.")
    return str(value)


def _branch_below(blueprint: Blueprint, name: str) -> StateBranch | None:
    """Return the SB of a name in what the operations of a blueprint run. None if there is none."""
    parts = procedures_of(blueprint).parts
    return next((part[name] for part in parts if name in part.branches), None)


def one_of(known: Iterable[str]) -> Check:
    """Return a check that accepts only these words and raises UsageError for any other value."""
    words = tuple(known)

    def check(_: Blueprint, value: Json) -> str:
        """Return the value if it is one of the words. UsageError has the nearest word."""
        if value not in words:
            near = did_you_mean(str(value)[:80], words)
            raise UsageError(
                f"{_shown(value)} is none of {', '.join(words)}",
                advice=near or f"Choose one of {', '.join(words)}.",
            )
        return str(value)

    return check


def _shown(value: Json) -> str:
    """Write a value for a sentence, cut to 60 characters."""
    try:
        words = repr(value)
    except ValueError:
        return "a number of more digits than can be written"
    return words if len(words) <= 60 else f"{words[:57]}..."


_CHECKS: Mapping[str, Check] = MappingProxyType(
    {
        EDGE: operation,
        TEXT: text,
        AMOUNT: seconds,
        SWITCH: yes_or_no,
        SENSED: sensed,
        DISTURBANCE: one_of(DISTURBANCES),
        TASK: one_of(TASKS),
    }
)
"""The check for each kind of argument."""


def _words() -> Iterator[tuple[str, ScriptWord]]:
    for row in COMMANDS.values():
        for word, says in row.words.items():
            said = {
                key: argument
                for key, argument in row.arguments.items()
                if argument.scripted and key not in says
            }
            needs = {key: _CHECKS[one.kind] for key, one in said.items() if one.needed}
            may = {key: _CHECKS[one.kind] for key, one in said.items() if not one.needed}
            yield word, ScriptWord(needs, may, row.free, row, says)


WORDS: Mapping[str, ScriptWord] = MappingProxyType(
    {**dict(_words()), "level": ScriptWord({"of": text, "level": text})}
)
"""Every word of ``do``. ``level`` is set before the start; all others come during the run."""


def said_as(command: Command) -> tuple[str, Mapping[str, Json]]:
    """Return the word of a script for a command, and the arguments that a script can give."""
    for name, word in WORDS.items():
        says = word.says.items()
        if word.row is command.row and all(command.said.get(key) == one for key, one in says):
            return name, {
                key: str(value) if isinstance(value, Address) else value
                for key, value in command.said.items()
                if key not in word.says and word.check_of(key) and value not in (None, "")
            }
    raise UsageError(f"a script has no word for {command.word}")


def apart(do: str, given: Mapping[str, Json]) -> dict[str, Json]:
    """Return the arguments of a command as a line has them. If a parameter has the name of a key of
    the moment, all parameters stand in an object of their own, so that their order stays."""
    if not any(key in MOMENT for key in given):
        return dict(given)
    known = {key: value for key, value in given.items() if key in WORDS[do].needs}
    return {**known, WITH: {key: value for key, value in given.items() if key not in known}}


def checked(check: Check, blueprint: Blueprint, value: Json) -> Json:
    """Return the checked value of an argument. Every StudioError of the check becomes a
    UsageError."""
    try:
        return check(blueprint, value)
    except UsageError:
        raise
    except StudioError as error:
        raise UsageError(error.sentence, advice=error.advice) from None
