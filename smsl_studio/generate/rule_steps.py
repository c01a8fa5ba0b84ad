"""Where the operations of rules lead, for many states at once.

A state is packed into a few bytes: the number of each of its values, from 1.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import prod

import numpy as np
from numpy.typing import NDArray

from smsl_studio.generate.rule_circuit import (
    Codes,
    RuleCircuit,
    Truths,
    Words,
    bits,
    code_type,
    every_state,
)
from smsl_studio.generate.rule_conditions import Values
from smsl_studio.generate.rule_file import RuleSet

_MOST_AHEAD = 1 << 19
"""The largest number of combinations of values that are followed at once."""
_SHARE = 64
"""All combinations are followed at once as soon as one of so many is known to be reached. Before
that they may be far more than the states."""


@dataclass(frozen=True, slots=True)
class StepRows:
    """The operations of some states, one state after the other, and where each leads. ``ends`` has
    the number of all operations up to the end of each state."""

    ends: list[int]
    operations: list[str]
    targets: list[bytes]


@dataclass(frozen=True, slots=True)
class _StepArrays:
    """The same as arrays. ``operations`` are numbers."""

    ends: NDArray[np.int64]
    operations: NDArray[np.int64]
    targets: NDArray[np.bytes_]

    def of(self, states: NDArray[np.int64]) -> _StepArrays:
        """Return the steps of some of the states."""
        begins = np.concatenate(([0], self.ends))[states]
        counts = self.ends[states] - begins
        ends = np.cumsum(counts)
        steps = np.arange(counts.sum()) + np.repeat(begins - ends + counts, counts)
        return _StepArrays(ends, self.operations[steps], self.targets[steps])


class RuleSteps:
    """The cases of all operations of some rules, as arrays."""

    def __init__(self, rules: RuleSet) -> None:
        self._facts = rules.facts
        self._alphabets = [list(values) for values in rules.facts.values()]
        self._type = code_type(rules.facts)
        self._width = len(self._alphabets) * self._type.itemsize
        cases = [(number, place, case) for number, one in enumerate(rules.operations)
                 for place, case in enumerate(one.cases)]  # fmt: skip
        self._when = RuleCircuit(rules.facts, [case.when for *_, case in cases])
        self._never = RuleCircuit(rules.facts, [one for _, one in rules.never])
        self._operation = np.array([number for number, *_ in cases], np.int64)
        self._change = np.zeros((len(cases), len(self._alphabets)), self._type)
        for at, (*_, case) in enumerate(cases):
            for digit, value in case.change:
                self._change[at, digit] = self._alphabets[digit].index(value) + 1
        places = np.array([place for _, place, _ in cases], np.int64)
        self._turns = [np.flatnonzero(places == turn) for turn in range(max(places, default=0) + 1)]
        self._names = np.array([one.name for one in rules.operations], object)
        self._sizes = [len(own) for own in self._alphabets]
        self._followed = 0
        self._ahead: _StepArrays | None = None

    def packed(self, values: Values) -> bytes:
        """Return the key of a state."""
        codes = [own.index(value) + 1 for own, value in zip(self._alphabets, values, strict=True)]
        found: bytes = self._keys(np.array([codes], self._type)).tolist()[0]
        return found

    def left_out(self, key: bytes) -> bool:
        """Return whether a condition of ``never`` holds in a state."""
        return bool(self._never_holds(self._codes([key]))[0])

    def names(self, keys: Sequence[bytes]) -> list[str]:
        """Return the values of each state as one text."""
        codes = self._codes(keys)
        wide = len(self._alphabets[0][0])
        # The last column keeps null characters at the end of a text.
        found = np.full((len(keys), len(self._alphabets) + 1), "_" * wide)
        for digit, own in enumerate(self._alphabets):
            found[:, digit] = np.array(own)[codes[:, digit] - 1]
        texts: list[str] = found.view(f"U{found.shape[1] * wide}").ravel().tolist()
        return [text[:-wide] for text in texts]

    def rows(self, keys: Sequence[bytes]) -> Iterator[StepRows]:
        """Give the steps of states, some at a time. No operation leads where a condition of
        ``never`` holds."""
        codes = self._codes(keys)
        if self._ahead is None and self._is_worth_all():
            self._ahead = self._all()
        if self._ahead is not None:
            yield self._named(self._ahead.of(self._numbers(codes)))
            return
        self._followed += len(keys)
        for own in self._some(codes):
            yield self._named(own)

    def _is_worth_all(self) -> bool:
        size = prod(self._sizes)
        return size <= _MOST_AHEAD and size <= _SHARE * self._followed

    def _all(self) -> _StepArrays:
        """Return the steps of all combinations of values."""
        parts = list(self._some(every_state(self._facts)))
        counts = np.cumsum([0, *(len(one.operations) for one in parts[:-1])])
        return _StepArrays(
            np.concatenate([one.ends + before for one, before in zip(parts, counts, strict=True)]),
            np.concatenate([one.operations for one in parts]),
            np.concatenate([one.targets for one in parts]),
        )

    def _numbers(self, codes: Codes) -> NDArray[np.int64]:
        """Return the number of each state among all combinations of values."""
        found = np.zeros(len(codes), np.int64)
        for digit, size in enumerate(self._sizes):
            found = found * size + (codes[:, digit].astype(np.int64) - 1)
        return found

    def _named(self, steps: _StepArrays) -> StepRows:
        names: list[str] = self._names[steps.operations].tolist()
        return StepRows(steps.ends.tolist(), names, steps.targets.tolist())

    def _some(self, codes: Codes) -> Iterator[_StepArrays]:
        """Give the steps of states, some at a time."""
        for at, holds in self._when.holding(codes):
            yield self._steps(codes[at : at + holds.shape[1] * 64], holds)

    def _steps(self, codes: Codes, holds: Words) -> _StepArrays:
        """Return the steps from some states. ``holds`` tells which case applies in which state."""
        if len(self._turns) > 1:
            holds = self._first(holds)
        states, cases = np.nonzero(bits(holds, len(codes)).T)
        targets, change = codes[states], self._change[cases]
        np.copyto(targets, change, where=change > 0)
        if self._never.size:
            kept = ~self._never_holds(targets)
            states, cases, targets = states[kept], cases[kept], targets[kept]
        ends = np.cumsum(np.bincount(states, minlength=len(codes)))
        return _StepArrays(ends, self._operation[cases], self._keys(targets))

    def _first(self, holds: Words) -> Words:
        """Return which case of each operation is the first that holds."""
        taken = np.zeros((len(self._names), holds.shape[1]), np.uint64)
        first = np.zeros_like(holds)
        for turn in self._turns:
            own = self._operation[turn]
            first[turn] = holds[turn] & ~taken[own]
            taken[own] |= holds[turn]
        return first

    def _never_holds(self, codes: Codes) -> Truths:
        found = [bits(np.bitwise_or.reduce(holds, axis=0, keepdims=True), len(codes) - at)[0]
                 for at, holds in self._never.holding(codes)]  # fmt: skip
        return np.concatenate(found) if found else np.zeros(0, np.bool_)

    def _codes(self, keys: Sequence[bytes]) -> Codes:
        """Return the codes of some states. Null bytes at the end of a key are not stored."""
        return np.array(keys, f"S{self._width}").view(self._type).reshape(len(keys), -1)

    def _keys(self, codes: Codes) -> NDArray[np.bytes_]:
        return np.ascontiguousarray(codes).view(f"S{self._width}").ravel()
