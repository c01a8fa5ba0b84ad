"""Searches configurations in arrays, breadth first, to find shortest runs.

A layer has all configurations at the same distance from the start. Each of them has one run that
leads to it. The layer is sorted by the addresses of these runs. So of all shortest runs the search
finds the first one by its addresses.
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
"""The number of configurations that the search handles with one call of numpy."""

_DIGIT = 255
_MARKS = np.arange(1, _DIGIT + 1, dtype=np.uint8)


class Numbering(Protocol):
    """Gives each configuration a number from 0 to ``size`` - 1, to mark it as seen in an array."""

    @property
    def size(self) -> int:
        """The length of an array with one cell for each number."""
        ...

    def of(self, codes: Array) -> Array:
        """Return the number of each configuration."""
        ...

    def made_room(self, count: int) -> bool:
        """Make room for ``count`` configurations in total.

        Return True if the old numbers are no longer valid. Then the caller must ask for the number
        of each configuration again.
        """
        ...


class ArrayBound(NamedTuple):
    """The limits of a search: the configurations that it stores, and the steps that it tries."""

    configurations: int = 40_000_000
    steps: int = 600_000_000


class ConditionBits(NamedTuple):
    """The conditions of a search, as masks of bits (see ``BitTables``).

    The search ends at a configuration that has a bit of ``hits``. It may also end at one that has a
    bit of ``passing``: one step from there passes through a wanted configuration. If ``may`` is
    given, only configurations that have one of its bits are left by a step.
    """

    hits: Array
    passing: Array | None = None
    may: Array | None = None


class FoundWay(NamedTuple):
    """A shortest run: the operation of each step, and the codes of all configurations on it.

    ``during`` is True if the last configuration is not wanted itself, but one step from there
    passes through a wanted one.
    """

    operations: list[OneOperation]
    codes: list[int]
    during: bool


class ArraySearch:
    """Searches the configurations that can be reached from the code ``start``."""

    def __init__(
        self, tables: BitTables, numbering: Numbering, start: int, bound: ArrayBound | None = None
    ) -> None:
        self.tables, self._numbering = tables, numbering
        self._bound = bound or ArrayBound()
        self._operations = tables.operation_mask
        begun = np.array([start], tables.layout.kind)
        self.layers = [begun]
        """Item n has the configurations that are n steps from the start. The steps out of the last
        item may not have been tried yet."""
        self._origins = [np.zeros(1, np.int32)]
        self._next: list[Array] = []
        self._mark_all()
        self.count, self._steps = 1, 0

    def nearest(self, ends: ConditionBits) -> FoundWay | None:
        """Return the shortest run to a hit, or None if there is none.

        If a configuration with a bit of ``passing`` is nearer by more than one step, return the run
        to that one. TooLarge or BoundMet if a limit is reached.
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
        """Search everything that can be reached. Return the limit that ended the search, in words.

        The text is empty if the search is complete. After a limit, ``layers`` has only the
        configurations near the start.
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
        """Search the last layer, and add the layer after it.

        Return two places in the last layer: that of the first hit, and that of the first
        configuration with a bit of ``passing``. A place is -1 if there is no such configuration. If
        there is a hit, no layer is added, and the second place is -1.
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
        """Return the new configurations after one step from ``here``.

        The second array has, for each of them, the place in ``here`` of the configuration before
        it.
        """
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
        """Mark the numbers as seen. Return for each different number the first place where it
        stands.

        Every place has a digit that is not 0. It is written into the cell of its number, from the
        last place to the first. At the end a cell has the digit of the first place of its number.
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
        """Return the run from the start to one place of a layer."""
        codes = []
        for back in range(layer, -1, -1):
            codes.append(int(self.layers[back][at]))
            at = int(self._origins[back][at])
        codes.reverse()
        return FoundWay(self._asked(codes), codes, during)

    def _asked(self, codes: Sequence[int]) -> list[OneOperation]:
        """Return an operation for each two neighbouring codes of a run.

        If several operations lead from one to the other, the first one by its address is taken.
        """
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
    """Return the arrays joined.

    If there are no parts, return an empty array of the type of ``like``.
    """
    if len(parts) == 1:
        return parts[0]
    return np.concatenate(parts) if parts else like[:0]


def first_set(bits: Array, mask: Array) -> int:
    """Return the place of the first configuration that has a bit of the mask, or -1."""
    met = bits & mask
    if not met.any():
        return -1
    (found,) = np.nonzero(met.any(axis=1) if met.ndim > 1 else met)
    return int(found[0])
