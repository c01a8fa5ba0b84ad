"""A search through configurations in arrays, breadth first, layer by layer.

A layer is in the order of the runs that lead to its configurations, compared by their addresses; so
of all shortest runs the first is found.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np

from smsl_studio.graph.joint.codes import Array
from smsl_studio.graph.joint.operation_bits import BitTables, OneOperation
from smsl_studio.graph.joint.products import TooLarge
from smsl_studio.stop import BoundMet, heed

AT_ONCE = 8_192
"""So many configurations are worked on together."""

_DIGIT = 255
_MARKS = np.arange(1, _DIGIT + 1, dtype=np.uint8)


class Numbering(Protocol):
    """Numbers the configurations that can be reached, below ``size``."""

    @property
    def size(self) -> int:
        """One more than the largest number."""
        ...

    def of(self, codes: Array) -> Array:
        """Return the number of each configuration."""
        ...

    def made_room(self, count: int) -> bool:
        """Have numbers for ``count`` configurations. Return whether all must be numbered anew."""
        ...


class ArrayBound(NamedTuple):
    """How much a search may take: configurations that are kept, and steps that are looked at."""

    configurations: int = 40_000_000
    steps: int = 600_000_000


class ConditionBits(NamedTuple):
    """The bits of a table that say where a search ends and where it goes on.

    ``hits`` are wanted, out of one of ``passing`` a step passes what is wanted. Steps begin where
    one of ``may`` is set, if it is given.
    """

    hits: Array
    passing: Array | None = None
    may: Array | None = None


class FoundWay(NamedTuple):
    """A shortest run: the operation of each step, and the codes of all configurations on it.

    With ``during`` the last one is none that is wanted, but a step out of it passes one.
    """

    operations: list[OneOperation]
    codes: list[int]
    during: bool


class ArraySearch:
    """Searches all configurations that can be reached from the code ``start``."""

    def __init__(
        self, tables: BitTables, numbering: Numbering, start: int, bound: ArrayBound | None = None
    ) -> None:
        self.tables, self._numbering = tables, numbering
        self._bound = bound or ArrayBound()
        self._operations = tables.operation_mask
        begun = np.array([start], tables.layout.kind)
        self.layers = [begun]
        """The configurations by their distance from the start. Those of the last layer may not have
        been looked at."""
        self._origins = [np.zeros(1, np.int32)]
        self._next: list[Array] = []
        self._mark_all()
        self.count, self._steps = 1, 0

    def nearest(self, ends: ConditionBits) -> FoundWay | None:
        """Return the shortest run to a hit, None if there is none. TooLarge if a bound is met.

        If one of ``passing`` is nearer by more than a step, the run to it is returned.
        """
        met = -1
        while len(self.layers[-1]):
            layer = len(self.layers) - 1
            hit, passing = self._further(ends)
            if hit >= 0:
                return self.way(layer, hit, False)
            if met >= 0:
                return self.way(layer - 1, met, True)
            met = passing
        return None if met < 0 else self.way(len(self.layers) - 2, met, True)

    def everything(self) -> str:
        """Look at all that can be reached. Return the bound that was met; empty if none was.

        Then ``layers`` has the nearest configurations alone, layer by layer.
        """
        nothing = ConditionBits(self.tables.mask(()))
        try:
            while len(self.layers[-1]):
                self._further(nothing)
        except (TooLarge, BoundMet) as error:
            self._next = []
            return str(error)
        return ""

    def _mark_all(self) -> None:
        self._seen = np.zeros(self._numbering.size, np.uint8)
        for layer in (*self.layers, *self._next):
            for begin in range(0, len(layer), AT_ONCE):
                heed()
                self._seen[self._numbering.of(layer[begin : begin + AT_ONCE])] = 1

    def _further(self, ends: ConditionBits) -> tuple[int, int]:
        """Add the next layer. Return where in the last one the first hit is, without adding one,
        and else the first that passes; -1 if there is none.
        """
        layer = self.layers[-1]
        found, origins = self._next, []
        passing = -1
        for begin in range(0, len(layer), AT_ONCE):
            heed()
            here = layer[begin : begin + AT_ONCE]
            bits = self.tables.bits(here)
            hit = first_set(bits, ends.hits)
            if hit >= 0:
                return begin + hit, -1
            if passing < 0 and ends.passing is not None:
                met = first_set(bits, ends.passing)
                passing = begin + met if met >= 0 else -1
            if ends.may is not None:
                fine = bits & ends.may
                bits[~fine.any(axis=1) if fine.ndim > 1 else fine == 0] = 0
            fresh, rows = self._fresh(here, bits & self._operations)
            if len(fresh):
                found.append(fresh)
                origins.append((rows + begin).astype(np.int32))
                self.count += len(fresh)
                if self.count > self._bound.configurations:
                    raise TooLarge(f"{self._bound.configurations:,} configurations in arrays")
        self.layers.append(_joined(found, layer))
        self._origins.append(_joined(origins, self._origins[0]))
        self._next = []
        return -1, passing

    def _fresh(self, here: Array, bits: Array) -> tuple[Array, Array]:
        """Return the configurations that were not seen before, and where each came from first."""
        rows, operations = self.tables.asked(bits)
        self._steps += len(rows)
        if self._steps > self._bound.steps:
            raise TooLarge(f"{self._bound.steps:,} steps in arrays")
        codes = self.tables.led(here.take(rows), operations)
        if self._numbering.made_room(self.count + len(codes)):
            self._mark_all()
        numbers = self._numbering.of(codes)
        (new,) = (self._seen.take(numbers) == 0).nonzero()
        first = new.take(self._firsts(numbers.take(new)))
        return codes.take(first), rows.take(first)

    def _firsts(self, numbers: Array) -> Array:
        """Mark numbers as seen, and return where each of them comes first.

        Each place writes a digit of its own into the cell of its number, the last place first. What
        stands there in the end is the digit of the first place. Digits are not 0.
        """
        if len(numbers) <= _DIGIT:  # as in most layers of long runs
            marks = _MARKS[: len(numbers)]
            self._seen[numbers[::-1]] = marks[::-1]
            return np.flatnonzero(self._seen.take(numbers) == marks)
        left: Array = np.arange(len(numbers))
        digits = left
        while True:
            marks = (digits % _DIGIT + 1).astype(np.uint8)
            self._seen[numbers[::-1]] = marks[::-1]
            (kept,) = (self._seen.take(numbers) == marks).nonzero()
            left, numbers, digits = left.take(kept), numbers.take(kept), digits.take(kept)
            digits = digits // _DIGIT
            if not digits.any():
                return left

    # the run

    def way(self, layer: int, at: int, during: bool) -> FoundWay:
        """Return the run to one place of a layer."""
        codes = []
        for back in range(layer, -1, -1):
            codes.append(int(self.layers[back][at]))
            at = int(self._origins[back][at])
        codes.reverse()
        return FoundWay(self._asked(codes), codes, during)

    def _asked(self, codes: Sequence[int]) -> list[OneOperation]:
        """Return the first operation between each two configurations that follow each other."""
        found: list[OneOperation] = []
        tables, all_codes = self.tables, np.array(codes, self.tables.layout.kind)
        for begin in range(0, len(codes) - 1, AT_ONCE):
            heed()
            here = all_codes[begin : begin + AT_ONCE][: len(codes) - 1 - begin]
            wanted = all_codes[begin + 1 : begin + 1 + len(here)]
            rows, operations = tables.asked(tables.bits(here) & self._operations)
            fits = np.flatnonzero(tables.led(here.take(rows), operations) == wanted.take(rows))
            _, firsts = np.unique(rows.take(fits), return_index=True)
            found += [tables.operations[one] for one in operations.take(fits.take(firsts))]
        return found


def _joined(parts: Sequence[Array], like: Array) -> Array:
    """Return arrays as one. Without any it is empty, and of the kind of ``like``."""
    if len(parts) == 1:
        return parts[0]
    return np.concatenate(parts) if parts else like[:0]


def first_set(bits: Array, mask: Array) -> int:
    """Return the first configuration in whose bits one of a mask is set, -1 if there is none."""
    met = bits & mask
    if not met.any():
        return -1
    (found,) = np.nonzero(met.any(axis=1) if met.ndim > 1 else met)
    return int(found[0])
