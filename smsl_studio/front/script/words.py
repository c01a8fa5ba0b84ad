"""The words of a script: each command of the table in ``dispatch``, and how a value is checked."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from smsl_studio.blueprint.address import Address, split_fact
from smsl_studio.blueprint.model import Blueprint
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
from smsl_studio.monitor.disturbance import KINDS as DISTURBANCES

Json = Any
Check = Callable[[Blueprint, Json], Json]
LONGEST = 1000
LARGEST = 1e9
"""Characters of a text at most; simulated seconds and costs stay below it: 30 years, and exact."""


@dataclass(frozen=True, slots=True)
class ScriptWord:
    """A word of ``do``: the keys that must and that may stand with it; ``free``: and any other
    scalar. ``row`` is the command that it says, with what the word says by itself (``says``); None
    where it is said before the run."""

    needs: Mapping[str, Check]
    may: Mapping[str, Check] = field(default_factory=dict)
    free: bool = False
    row: CommandRow | None = None
    says: Mapping[str, Json] = field(default_factory=dict)

    def check_of(self, key: str) -> Check | None:
        """How the value of a key is checked; None where the command does not take it."""
        known = self.needs.get(key) or self.may.get(key)
        return known or (scalar if self.free else None)

    def command(self, given: Mapping[str, Json], by: str, **more: Json) -> Command:
        """The command as a line of a script says it; ``more`` is what the line leaves open."""
        assert self.row is not None, "it is said before the run"
        said = {**self.says, **more, **given}
        for key, argument in self.row.arguments.items():
            if argument.kind == EDGE and key in said:
                said[key] = Address(*Address.split(said[key]))
        return self.row.command(**said, by=by)


def operation(blueprint: Blueprint, value: Json) -> str:
    """The address of exactly one operation, written out."""
    found = operations_at(blueprint, [text(blueprint, value)])
    if len(found) != 1:
        raise UsageError(
            f"{value!r} stands for {len(found)} operations", advice="Write SB/State/Operation."
        )
    return str(found[0])


def state(blueprint: Blueprint, value: Json) -> str:
    """The address of a state, written out."""
    return str(state_at(blueprint, text(blueprint, value)))


def text(_: Blueprint, value: Json) -> str:
    """A text that is not empty and fits one line; raises ``UsageError`` for any other value."""
    if not isinstance(value, str) or not value.strip():
        raise UsageError(f"{_shown(value)} is no text", advice='Write it in quotes: "...".')
    if not value.isprintable() or len(value) > LONGEST:
        raise UsageError(f"{_shown(value)} cannot be printed in a line")
    return value


def seconds(_: Blueprint, value: Json) -> float:
    """A time or a cost: not below 0, and finite."""
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0 <= value < LARGEST:
        raise UsageError(
            f"{_shown(value)} is no number from 0 to {LARGEST:g}", advice="Write it like 2.5."
        )
    return float(value)


def yes_or_no(_: Blueprint, value: Json) -> bool:
    """True or false; raises ``UsageError`` for any other value."""
    if not isinstance(value, bool):
        raise UsageError(f"{_shown(value)} is neither yes nor no", advice="Write true or false.")
    return value


def scalar(_: Blueprint, value: Json) -> Json:
    """A text or a number, as facts may have it; raises ``UsageError`` for any other value."""
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise UsageError(f"{_shown(value)} is neither a text nor a number")
    if isinstance(value, str):
        return text(_, value) if value else value
    if not abs(value) < LARGEST:
        raise UsageError(f"{_shown(value)} is too large")
    return value


def sensed(blueprint: Blueprint, value: Json) -> str:
    """A sensor by its name, or a fact that exists, written ``SB/digit``."""
    fact = split_fact(text(blueprint, value))
    if fact is not None:
        branch = blueprint.branches.get(fact[0])
        if branch is None or not branch.table or fact[1] >= branch.num_facts:
            near = did_you_mean(fact[0], blueprint.branches) if branch is None else ""
            raise UsageError(f"there is no fact {value!r}", advice=near or "Write SB/digit.")
    return str(value)


def one_of(known: Iterable[str]) -> Check:
    """A check that lets one of these words pass and raises ``UsageError`` for any other value."""
    words = tuple(known)

    def check(_: Blueprint, value: Json) -> str:
        """The value where it is one of the words; raises ``UsageError`` with the nearest word."""
        if value not in words:
            near = did_you_mean(str(value)[:80], words)
            raise UsageError(
                f"{_shown(value)} is none of {', '.join(words)}",
                advice=near or f"Choose one of {', '.join(words)}.",
            )
        return str(value)

    return check


def _shown(value: Json) -> str:
    """A value in a sentence, however long it is."""
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
"""How the arguments of commands are checked, by what they are."""


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


def checked(check: Check, blueprint: Blueprint, value: Json) -> Json:
    """A value as its command takes it; UsageError with a sentence and an advice otherwise."""
    try:
        return check(blueprint, value)
    except UsageError:
        raise
    except StudioError as error:
        raise UsageError(error.sentence, advice=error.advice) from None
