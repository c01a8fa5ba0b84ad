"""The names that people use for facts, states and operations, for the header of a log."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from itertools import islice
from typing import Any

from smsl_studio.blueprint.address import Address, escape, fact_text, note_key
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.runlog.events import Event

Json = Any
MOST = 1000
"""The largest number of names of each kind in a header, because it is one line that people read."""
LONGEST = 200
"""The largest number of characters of a name. The rest is cut."""
KINDS = ("facts", "states", "operations", "values")
_ADDRESSES = ("address", "goal", "target", "operations", "route", "goals")
_CONFIGURATIONS = ("configuration", "start")


def names_of(blueprint: Blueprint) -> Mapping[str, Json]:
    """Return the names in a blueprint, by kind. An element without a name is left out.

    The keys are ``SB/digit`` for facts, ``SB/digit/value`` for their values, ``SB/State`` for
    states, and ``SB/Operation`` or ``SB/State/Operation`` for operations, as in ``_operations``.
    """
    of_all = (_facts, _states, _operations, _values)
    found = zip(KINDS, (of(blueprint) for of in of_all), strict=True)
    return {
        kind: {key: name[:LONGEST] for key, name in islice(((k, n) for k, n in pairs if n), MOST)}
        for kind, pairs in found
    }


@dataclass(frozen=True, slots=True)
class HeaderNames:
    """The names in a header. A name is shown beside the address, and never instead of it."""

    facts: Mapping[str, str] = field(default_factory=dict)
    states: Mapping[str, str] = field(default_factory=dict)
    operations: Mapping[str, str] = field(default_factory=dict)
    values: Mapping[str, str] = field(default_factory=dict)

    @staticmethod
    def of_header(said: Json) -> HeaderNames:
        """Return the names in a header. Anything but a map of texts is left out, because a log
        comes from outside.
        """
        given = said if isinstance(said, dict) else {}
        return HeaderNames(*(_texts(given.get(kind)) for kind in KINDS))

    def fact(self, branch: str, digit: int) -> str:
        """Return the name of a fact, or ``Fact 1`` (counted from 1) if it has none."""
        return self.facts.get(fact_text(branch, digit)) or f"Fact {digit + 1}"

    def value(self, fact: str, value: str) -> str:
        """Return a value of the fact ``SB/digit`` with its meaning, such as ``0 "free"``, if it has
        one.
        """
        name = self.values.get(f"{fact}/{escape(value)}")
        return f'{value} "{name}"' if name else value

    def address(self, text: str) -> str:
        """Return an address with its title, such as ``SB/State/Operation "Fix it"``, if it has
        one.
        """
        parts = Address.split(text)
        if len(parts) == 3:
            name = self.operations.get(text) or self.operations.get(_operation(parts[0], parts[2]))
        else:
            name = self.states.get(text)
        return f'{text} "{name}"' if name else text

    def told_in(self, event: Event) -> Event:
        """Return the same event with titles in its addresses, as ``address`` writes them."""
        if not (self.states or self.operations):
            return event
        changed = {name: value for name, value in self._named(event) if value}
        return replace(event, **changed) if changed else event

    def _named(self, event: Event) -> Iterator[tuple[str, Json]]:
        for item in fields(event):
            value = getattr(event, item.name)
            if item.name == "target" and isinstance(value, str):
                # This field has the target state of an operation without its SB.
                branch = Address.split(getattr(event, "address", ""))[0]
                yield item.name, self._state(branch, value)
            elif item.name in _ADDRESSES and isinstance(value, str):
                yield item.name, self.address(value)
            elif item.name in _ADDRESSES and isinstance(value, tuple):
                yield item.name, tuple(map(self.address, value))
            elif item.name in _CONFIGURATIONS:
                yield item.name, self._configuration(value)
            elif item.name == "candidates":
                yield item.name, tuple(map(self._configuration, value))

    def _configuration(self, states: Mapping[str, str]) -> Mapping[str, str]:
        return {branch: self._state(branch, state) for branch, state in states.items()}

    def _state(self, branch: str, state: str) -> str:
        name = self.states.get(str(Address(branch, state)))
        return f'{state} "{name}"' if name else state


NAMELESS = HeaderNames()


def _facts(blueprint: Blueprint) -> Iterator[tuple[str, str]]:
    for branch in blueprint:
        for digit, note in branch.notes.facts.items():
            yield fact_text(branch.name, digit), note.name


def _values(blueprint: Blueprint) -> Iterator[tuple[str, str]]:
    for branch in blueprint:
        for digit, note in branch.notes.facts.items():
            for value, words in note.values.items():
                yield f"{fact_text(branch.name, digit)}/{escape(value)}", words


def _states(blueprint: Blueprint) -> Iterator[tuple[str, str]]:
    for branch in blueprint:
        for state, note in branch.notes.states.items():
            yield str(Address(branch.name, state)), note.title


def _operations(blueprint: Blueprint) -> Iterator[tuple[str, str]]:
    for branch in blueprint:
        for key, note in branch.notes.operations.items():
            yield f"{escape(branch.name)}/{key}", note.title


def _operation(branch: str, operation: str) -> str:
    return f"{escape(branch)}/{note_key(operation)}"


def _texts(said: Json) -> Mapping[str, str]:
    pairs = said.items() if isinstance(said, dict) else ()
    kept = ((key, name[:LONGEST]) for key, name in pairs if isinstance(name, str) and name)
    return dict(islice(kept, MOST))
