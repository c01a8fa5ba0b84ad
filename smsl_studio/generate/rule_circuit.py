"""Conditions of rules, decided for many states at once.

Each part of a condition is a wire: one bit for each state, 64 states in a word. Gates join wires:
all of them hold, one of them, none, or as many as a count wants. All gates of one kind whose inputs
are known are decided in one step of numpy. Equal parts of conditions are one wire.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import prod
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from smsl_studio.generate.rule_conditions import (
    Alphabets,
    Condition,
    Counted,
    EveryPart,
    Has,
    Not,
    SomePart,
)
from smsl_studio.stop import heed

Codes = NDArray[Any]
"""States by facts: the number of each value in its alphabet, from 1."""
Truths = NDArray[np.bool_]
Words = NDArray[np.uint64]
"""Wires by words of 64 states."""
Kind = Literal["all", "one", "none", "count"]
_CELLS = 1 << 23
"""So many truths at once are stored at most."""
_WORD = 64


def code_type(facts: Alphabets) -> np.dtype[Any]:
    """Return the smallest type that holds the number of each value."""
    return np.min_scalar_type(max(map(len, facts.values())))


def every_state(facts: Alphabets) -> Codes:
    """Return the codes of all combinations of values, the last fact changing first."""
    sizes = [len(values) for values in facts.values()]
    numbers = np.arange(prod(sizes))
    found = np.empty((len(numbers), len(sizes)), code_type(facts))
    for digit in reversed(range(len(sizes))):
        numbers, found[:, digit] = np.divmod(numbers, sizes[digit])
    found += 1
    return found


class _Gate(NamedTuple):
    """One gate. A count holds if its sum lies between two bounds, or, if ``odd``, if not."""

    kind: Kind
    inputs: tuple[int, ...]
    low: int = 0
    high: int = 0
    odd: bool = False


class _Layer:
    """The gates of one kind and depth, as arrays. ``places`` are the numbers of their wires."""

    def __init__(self, kind: Kind, gates: Sequence[tuple[int, _Gate]]) -> None:
        self._kind = kind
        self.places = np.array([place for place, _ in gates], np.int64)
        self._inputs = np.array([wire for _, gate in gates for wire in gate.inputs], np.int64)
        counts = [len(gate.inputs) for _, gate in gates]
        self._begins = np.cumsum([0, *counts[:-1]])
        self._low = np.array([gate.low for _, gate in gates], np.uint16)[:, None]
        self._high = np.array([gate.high for _, gate in gates], np.uint16)[:, None]
        self._odd = np.array([gate.odd for _, gate in gates], np.bool_)[:, None]

    def decided(self, wires: Words) -> Words:
        """Return the wires of these gates."""
        own = wires[self._inputs]
        if self._kind == "all":
            return np.bitwise_and.reduceat(own, self._begins, axis=0)
        if self._kind == "one":
            return np.bitwise_or.reduceat(own, self._begins, axis=0)
        if self._kind == "none":
            return ~np.bitwise_or.reduceat(own, self._begins, axis=0)
        bits = np.unpackbits(own.view(np.uint8), axis=1, bitorder="little")
        sums = np.add.reduceat(bits, self._begins, axis=0, dtype=np.uint16)
        return _packed(((sums >= self._low) & (sums <= self._high)) ^ self._odd)


class RuleCircuit:
    """The gates of some conditions. ``size`` is the number of conditions. One that is None always
    holds."""

    def __init__(self, facts: Alphabets, conditions: Sequence[Condition | None]) -> None:
        self.size = len(conditions)
        self._alphabets = [list(values) for values in facts.values()]
        self._wires: dict[tuple[int, int, bool] | _Gate, int] = {}
        self._depths: list[int] = []
        outputs = [-1 if one is None else self._wire(one) for one in conditions]
        self._outputs = np.array(outputs, np.int64)
        atoms = [(place, key) for key, place in self._wires.items() if not isinstance(key, _Gate)]
        self._places = np.array([place for place, _ in atoms], np.int64)
        self._digits = np.array([digit for _, (digit, _, _) in atoms], np.int64)
        codes = [code for _, (_, code, _) in atoms]
        self._codes = np.array(codes, code_type(facts))[:, None]
        self._unequal = np.array([not equal for _, (*_, equal) in atoms], np.bool_)[:, None]
        self._layers = self._by_depth()

    def holding(self, codes: Codes) -> Iterator[tuple[int, Words]]:
        """Give for some states at a time the number of the first, and which conditions hold in
        them: conditions by words of states (see ``bits``)."""
        most = max(1, _CELLS // (1 + len(self._depths) + self.size) // _WORD) * _WORD
        for at in range(0, len(codes), most):
            heed()
            yield at, self._decided(codes[at : at + most])

    def _decided(self, codes: Codes) -> Words:
        # The last wire always holds.
        wires = np.full((len(self._depths) + 1, -(-len(codes) // _WORD)), ~np.uint64(0))
        wires[self._places] = _packed((codes.T[self._digits] == self._codes) ^ self._unequal)
        for layer in self._layers:
            wires[layer.places] = layer.decided(wires)
        return wires[self._outputs]

    def _wire(self, condition: Condition) -> int:
        """Return the number of the wire of a condition."""
        match condition:
            case Has(digit, value, equal):
                code = self._alphabets[digit].index(value) + 1
                return self._numbered((digit, code, equal), 0)
            case Not(part):
                return self._gate("none", [part])
            case EveryPart(parts):
                return self._gate("all", parts)
            case SomePart(parts):
                return self._gate("one", parts)
            case Counted(digits, value, low, high, odd):
                parts = tuple(Has(digit, value, True) for digit in digits)
                return self._gate("count", parts, low, high, odd)

    def _gate(self, kind: Kind, parts: Sequence[Condition], *bounds: int) -> int:
        inputs = tuple(map(self._wire, parts))
        depth = 1 + max(self._depths[wire] for wire in inputs)
        return self._numbered(_Gate(kind, inputs, *bounds), depth)  # type: ignore[arg-type]

    def _numbered(self, key: tuple[int, int, bool] | _Gate, depth: int) -> int:
        if key not in self._wires:
            self._wires[key] = len(self._depths)
            self._depths.append(depth)
        return self._wires[key]

    def _by_depth(self) -> list[_Layer]:
        groups: dict[tuple[int, Kind], list[tuple[int, _Gate]]] = {}
        for key, place in self._wires.items():
            if isinstance(key, _Gate):
                groups.setdefault((self._depths[place], key.kind), []).append((place, key))
        return [_Layer(kind, groups[depth, kind]) for depth, kind in sorted(groups)]


def bits(words: Words, states: int) -> Truths:
    """Return the truths of so many states, or of all that the words have: wires by states."""
    most = min(states, words.shape[1] * _WORD)
    found = np.unpackbits(words.view(np.uint8), axis=1, count=most, bitorder="little")
    return found.view(np.bool_)


def _packed(truths: Truths) -> Words:
    """Return truths as words of 64 states; the rest of the last word is 0."""
    width = -(-truths.shape[1] // _WORD) * (_WORD // 8)
    found = np.zeros((len(truths), width), np.uint8)
    own = np.packbits(truths, axis=1, bitorder="little")
    found[:, : own.shape[1]] = own
    return found.view(np.uint64)
