"""The digits of bases that sub-SBs expand, as the header of a log has them.

A blueprint has this invariant: a digit of a base is on if and only if its sub-SB is in ACTIVATING.
Committed states obey it at every moment, because a base commits together with the last crossing of
its subs. Until then its step is pending.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, NamedTuple

Json = Any
MOST = 256
"""The largest number of digits of an SB and of bases of a sub-SB that are judged, so that the cost
of an event is bounded.
"""


class Expanded(NamedTuple):
    """A digit of a base with its sub-SB. ``on`` has the states of the base in which the digit is
    on.
    """

    base: str
    digit: str
    sub: str
    activating: str
    initial: str
    on: frozenset[str]


class Expansion:
    """All expanded digits in a header.

    ``told`` says whether the header has them at all. Logs of earlier programs do not, and then
    nothing is judged by them.
    """

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
        """Yield the digits that break the invariant, for the SBs that have moved and their
        bases.
        """
        for branch in moved:
            for one in (*self._of_base.get(branch, ()), *self._of_sub.get(branch, ())):
                base, sub = configuration.get(one.base), configuration.get(one.sub)
                known = base is not None and sub is not None
                if known and (base in one.on) != (sub == one.activating):
                    yield one

    def bases_of(self, sub: str) -> Iterator[str]:
        """Yield the known bases of a sub-SB."""
        return (one.base for one in self._of_sub.get(sub, ()))

    def apart(self, base: str, state: str, stands: Callable[[str], str]) -> Iterator[Expanded]:
        """Yield the digits of a base's state that do not agree with their sub-SBs.

        ``stands`` returns the state of a sub-SB.
        """
        for one in self._of_base.get(base, ()):
            if (state in one.on) != (stands(one.sub) == one.activating):
                yield one

    def is_alone(self, branch: str) -> bool:
        """Return whether an SB is known to have neither sub-SBs nor bases.

        Then each of its steps is one operation.
        """
        return self.told and branch not in self._of_base and branch not in self._of_sub

    def may_load(self, base: str, sub: str, state: str) -> bool:
        """Return whether an operation of ``base`` may put the SB ``sub`` into a state. An operation
        with ``subs: load`` puts sub-SBs, and those below them, into ACTIVATING or INITIAL.
        """
        below = self._of_sub.get(sub, ())
        return base in self._of_base and any(state in (o.activating, o.initial) for o in below)


def _expanded(said: Json) -> Iterator[Expanded]:
    """Yield the digits in a header. Values of a wrong type are left out here and reported
    elsewhere.
    """
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
