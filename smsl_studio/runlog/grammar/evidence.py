"""What the logged facts say about states: which state check can be true, and which cannot.

The header of a log has the values that each state needs, and says which facts are sensed. For an SB
that is not in the header, a state needs the values that were logged when its check was first true.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from smsl_studio.blueprint.address import split_fact

Json = Any
MOST = 256
"""The largest number of facts of an SB that are judged, so that the cost of an event is bounded."""
Wanted = Mapping[int, str]


class Evidence:
    """The logged facts up to now, and the values that states need.

    ``off`` has the SBs with a fact that differs from their state. ``open`` has the SBs for which
    the facts alone do not decide a state check. ``differ`` is the number of facts of all other SBs
    that differ from their state or are unknown.
    """

    def __init__(self, grounds: Json) -> None:
        said = grounds if isinstance(grounds, dict) else {}
        self.off: set[str] = set()
        self.open: set[str] = set()
        self.differ = 0
        self._differing: dict[str, int] = {}
        self._wanted: dict[tuple[str, str], Wanted] = {}
        self._whole: set[str] = set()
        self._facts: dict[str, list[Json]] = {}
        self._drawn: set[str] = set()
        self._sensed: dict[str, set[int]] = {}
        self._told: dict[str, dict[int, str | None]] = {}
        self._known: set[tuple[str, int]] = set()
        self._draw(said.get("states"))
        self._sense(said.get("sensed"))

    def _draw(self, states: Json) -> None:
        """Take the values that states need from the header. Anything in another form is left
        out.
        """
        for branch, table in states.items() if isinstance(states, dict) else ():
            if not isinstance(table, dict) or not all(isinstance(v, list) for v in table.values()):
                continue
            self._drawn.add(branch)
            if all(len(v) <= MOST and None not in v for v in table.values()):
                self._whole.add(branch)
            longest: list[Json] = max(table.values(), key=len, default=[])
            self._facts[branch] = longest
            for state, values in table.items():
                pairs = enumerate(values[:MOST])
                self._wanted[branch, state] = {n: v for n, v in pairs if isinstance(v, str)}

    def _sense(self, sensed: Json) -> None:
        for text in sensed if isinstance(sensed, list) else ():
            fact = split_fact(text) if isinstance(text, str) else None
            if fact is not None and fact[1] < MOST:
                self._sensed.setdefault(fact[0], set()).add(fact[1])

    def tell(self, branch: str, digit: int, value: str | None) -> None:
        """Note the value of a fact."""
        if digit < MOST:
            self._told.setdefault(branch, {})[digit] = value
            if value is not None:
                self._known.add((branch, digit))

    def stand(self, branch: str, state: str) -> None:
        """Compare the facts of an SB with its state, after either has changed."""
        (self.off.add if self.misses(branch, state) else self.off.discard)(branch)
        sure = self.decides(branch)
        (self.open.discard if sure else self.open.add)(branch)
        many = self.misses(branch, state) + self.unknown(branch) if sure else 0
        self.differ += many - self._differing.get(branch, 0)
        self._differing[branch] = many

    def can_tell(self, branch: str, digit: int, value: str | None) -> bool:
        """Return whether the SB can have this fact, according to the header.

        A fact that a sub-SB expands is never known. A log can only say that it became unknown.
        """
        facts = self._facts.get(branch)
        if facts is None:
            return True
        return digit < len(facts) and (value is None or facts[digit] is not None)

    def learn(self, branch: str, state: str) -> None:
        """Note that the check of a state was true."""
        if branch not in self._drawn and (branch, state) not in self._wanted:
            told = self._told.get(branch, {}).items()
            self._wanted[branch, state] = {n: value for n, value in told if value is not None}

    def is_drawn(self, branch: str, state: str) -> bool:
        """Return whether the blueprint has this state, according to the header."""
        return branch not in self._drawn or (branch, state) in self._wanted

    def are_alike(self, branch: str, one: str, other: str) -> bool:
        """Return whether two states are known to have the same facts.

        Facts that sub-SBs expand are not compared.
        """
        first, second = (self._wanted.get((branch, state)) for state in (one, other))
        return branch in self._drawn and first is not None and first == second

    def misses(self, branch: str, state: str) -> int:
        """Return how many facts have another value than a state needs."""
        wanted, told = self._wanted.get((branch, state), {}), self._told.get(branch)
        if not told:
            return 0
        return sum(told.get(n) not in (None, value) for n, value in wanted.items())

    def unknown(self, branch: str) -> int:
        """Return how many facts of an SB are unknown now that were known before or are sensed."""
        told = self._told.get(branch, {})
        lost = [n for n, value in told.items() if value is None and (branch, n) in self._known]
        silent = [n for n in self._sensed.get(branch, ()) if told.get(n) is None]
        return len({*lost, *silent})

    def holds(self, branch: str, state: str) -> bool:
        """Return whether all facts of a state may have the values that it needs."""
        return not self.misses(branch, state) and not self.unknown(branch)

    def decides(self, branch: str) -> bool:
        """Return whether the facts alone decide a state check of an SB: the header has all its
        values, no sub-SB expands a digit, and every unknown fact was known before or is sensed.
        """
        told = self._told.get(branch, {})
        return branch in self._whole and all(
            value is not None or (branch, n) in self._known or n in self._sensed.get(branch, ())
            for n, value in told.items()
        )
