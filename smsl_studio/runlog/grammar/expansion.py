"""Which digits of which base a sub-SB expands, as the header of a log says it.

The invariant of a blueprint: a digit of a base is on if and only if its sub-SB stands in
ACTIVATING. What is committed obeys it at every moment, because a base commits with the last
crossing of its subs, and all that is pending until then is not committed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

Json = Any
MOST = 256
"""So many digits of an SB, and so many bases of a sub-SB, are judged: an event costs the same
however many there are."""


class Expanded(NamedTuple):
    """A digit of a base with its sub-SB; ``on`` are the states of the base where it is on."""

    base: str
    digit: str
    sub: str
    activating: str
    initial: str
    on: frozenset[str]


class Expansion:
    """All expanded digits that a header names. ``told`` says whether the header names them at all:
    logs of earlier programs do not, and then nothing is judged by them."""

    def __init__(self, grounds: Json) -> None:
        said = grounds.get("subs") if isinstance(grounds, dict) else None
        self.told = isinstance(said, dict)
        self._of_base: dict[str, list[Expanded]] = {}
        self._of_sub: dict[str, list[Expanded]] = {}
        for one in _expanded(said):
            for table, name in ((self._of_base, one.base), (self._of_sub, one.sub)):
                known = table.setdefault(name, [])
                if len(known) < MOST:
                    known.append(one)

    def broken(self, configuration: Mapping[str, str], moved: Iterable[str]) -> Iterator[Expanded]:
        """The digits that break the invariant, of the SBs that have moved and of their bases."""
        for branch in moved:
            for one in (*self._of_base.get(branch, ()), *self._of_sub.get(branch, ())):
                base, sub = configuration.get(one.base), configuration.get(one.sub)
                known = base is not None and sub is not None
                if known and (base in one.on) != (sub == one.activating):
                    yield one

    def may_load(self, base: str, sub: str, state: str) -> bool:
        """Whether an operation of one SB may leave another one in a state: ``subs: load`` leaves a
        sub-SB in ACTIVATING or INITIAL, and what is below it as well."""
        below = self._of_sub.get(sub, ())
        return base in self._of_base and any(state in (o.activating, o.initial) for o in below)


def _expanded(said: Json) -> Iterator[Expanded]:
    """What a header says of digits; its types are judged elsewhere, and what is wrong left out."""
    for base, digits in said.items() if isinstance(said, dict) else ():
        for digit, one in digits.items() if isinstance(digits, dict) else ():
            known = _one(base, digit, one) if isinstance(one, dict) else None
            if known is not None:
                yield known


def _one(base: str, digit: str, said: Mapping[str, Json]) -> Expanded | None:
    sub, activating, initial, on = (said.get(k) for k in ("sub", "activating", "initial", "on"))
    if not (isinstance(on, list) and all(isinstance(v, str) for v in on)):
        return None
    if not (isinstance(sub, str) and isinstance(activating, str) and isinstance(initial, str)):
        return None
    return Expanded(base, digit, sub, activating, initial, frozenset(on))
