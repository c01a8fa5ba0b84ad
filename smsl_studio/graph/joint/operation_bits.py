"""Tables that tell for many configurations at once which operations are permitted.

Each operation is one bit. So one number for each configuration says which operations are permitted
there. An operation that several states of an SB have shares one bit, because only one of these
states is active. An operation gets several bits if its steps are several products. The bits are in
the order of the addresses. The bits of conditions follow them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from smsl_studio.blueprint.address import escape
from smsl_studio.graph.joint.codes import Array, CodeLayout
from smsl_studio.graph.joint.joint_steps import JointSteps
from smsl_studio.graph.joint.products import JointBox, TooLarge
from smsl_studio.stop import heed

MOST_OPERATIONS = 2_048
"""The largest number of bits that a configuration may have."""

MOST_BYTES = 8_000_000
"""The largest size of the tables of bits, in bytes."""

MOST_ENTRIES = 8_000_000
"""The largest number of entries of the tables of changes."""


class OneOperation(NamedTuple):
    """One operation: for each SB that takes part, the target state of each state (as numbers)."""

    branch: str
    name: str
    targets: Mapping[int, Mapping[int, int]]


def one_by_one(steps: JointSteps) -> list[OneOperation]:
    """Return the operations sorted by address. TooLarge if they are too many."""
    found = list(_split(steps))
    found.sort(key=lambda one: (f"{escape(one.branch)}/", escape(one.name)))
    return found


def _split(steps: JointSteps) -> Iterator[OneOperation]:
    at, number = steps.numbers.at, steps.numbers.number
    count = 0
    for edges, moves, *_ in steps.asked:
        by_name: dict[str, set[tuple[int, int]]] = {}
        own = at[edges[0].branch]
        for edge in edges:
            heed()
            pair = number[own][edge.source], number[own][edge.target]
            if pair in moves[own]:
                by_name.setdefault(edge.name, set()).add(pair)
        rest = {one: dict(sorted(pairs)) for one, pairs in moves.items() if one != own}
        if any(len(rest[one]) < len(moves[one]) for one in rest):
            raise TooLarge("steps that lead from one configuration to several")
        for name, pairs in by_name.items():
            count += 1
            if count > MOST_OPERATIONS:
                raise TooLarge(f"{MOST_OPERATIONS:,} operations at once")
            yield OneOperation(edges[0].branch, name, {**rest, own: dict(sorted(pairs))})


class BitTables:
    """Tells for many configurations at once which bits are set, and where operations lead.

    ``boxes`` are conditions: the bit of a box is set in the configurations that belong to it.
    TooLarge if the tables would be too large.
    """

    def __init__(
        self, layout: CodeLayout, operations: Sequence[OneOperation], boxes: Sequence[JointBox]
    ) -> None:
        self.layout, self.operations = layout, operations
        rows = [{one: tuple(targets) for one, targets in operation.targets.items()}
                for operation in operations]  # fmt: skip
        rows += [{one: tuple(sorted(states)) for one, states in box.items()} for box in boxes]
        self.count = len(operations)
        width = 8
        while width < len(rows):
            width *= 2
        cells = sum(1 << one for one in layout.widths)
        if len(rows) > MOST_OPERATIONS or cells * (width // 8) > MOST_BYTES:
            raise TooLarge(f"{MOST_OPERATIONS:,} operations at once")
        self._width = width
        self._shift = width.bit_length() - 1
        self._tables = self._set(rows)
        self.changes = np.array([self._change(one) for one in operations], layout.kind)
        self._vary()

    def _set(self, rows: Sequence[Mapping[int, Sequence[int]]]) -> list[Array]:
        """Return one table for each group of SBs.

        Its row n has the bits that value n of the field allows.
        """
        found = []
        for group, width in enumerate(self.layout.widths):
            bits = np.zeros((1 << width, self._width), np.bool_)
            bits[:, : len(rows)] = True
            for one in self.layout.groups[group]:
                heed()
                states = self.layout.states_in_field(one)
                for number, row in enumerate(rows):
                    if one in row:
                        fits = np.zeros(max(self.layout.sizes[one], 1), np.bool_)
                        fits[list(row[one])] = True
                        bits[:, number] &= fits[states]
            found.append(self._packed(bits))
        return found

    def _packed(self, bits: Array) -> Array:
        word = np.dtype(f"<u{min(self._width // 8, 8)}")
        packed = np.packbits(bits, axis=1, bitorder="little").view(word)
        return np.ascontiguousarray(packed[:, 0] if packed.shape[1] == 1 else packed)

    def mask(self, boxes: Sequence[int]) -> Array:
        """Return a mask with the bits of some boxes.

        ``boxes`` has their places in the list of boxes.
        """
        bits = np.zeros((1, self._width), np.bool_)
        bits[0, [self.count + one for one in boxes]] = True
        found: Array = self._packed(bits)[0]
        return found

    @property
    def operation_mask(self) -> Array:
        """A mask with the bits of all operations."""
        bits = np.zeros((1, self._width), np.bool_)
        bits[0, : self.count] = True
        found: Array = self._packed(bits)[0]
        return found

    def asked(self, bits: Array) -> tuple[Array, Array]:
        """Return two arrays with one entry for each set bit.

        They have the place of the configuration and the number of the operation, in this order.
        """
        flat = np.unpackbits(bits.view(np.uint8).reshape(-1), bitorder="little")
        (places,) = flat.view(np.bool_).nonzero()
        return places >> self._shift, places & (self._width - 1)

    def bits(self, codes: Array) -> Array:
        """Return the bits that are set in each configuration."""
        layout = self.layout
        found = self._tables[0].take(layout.field(codes, 0), axis=0)
        for group in range(1, len(self._tables)):
            found &= self._tables[group].take(layout.field(codes, group), axis=0)
        return found

    # where operations lead

    def _change(self, operation: OneOperation) -> int:
        """Return the number that an operation always adds to a code.

        SBs whose change depends on their state are left out; ``_vary`` has tables for them.
        """
        total = 0
        for one, targets in operation.targets.items():
            by = {target - source for source, target in targets.items()}
            if len(by) == 1:
                total += self.layout.moved(one, *by)
        return total

    def _vary(self) -> None:
        """Make the tables for the operations whose change of the code depends on the states."""
        layout = self.layout
        uneven = {
            number: moving
            for number, operation in enumerate(self.operations)
            if (moving := [one for one, targets in operation.targets.items()
                           if len({b - a for a, b in targets.items()}) > 1])
        }  # fmt: skip
        self._uneven = np.full(max(self.count, 1), -1, np.int32)
        self._uneven[list(uneven)] = np.arange(len(uneven))
        self._more: list[Array | None] = [None] * len(layout.groups)
        if len(uneven) * sum(1 << one for one in layout.widths) > MOST_ENTRIES:
            raise TooLarge(f"{MOST_ENTRIES:,} entries of tables")
        for row, (number, moving) in enumerate(uneven.items()):
            heed()
            for one in moving:
                group = layout.group_of[one]
                more = self._more[group]
                if more is None:
                    shape = len(uneven), 1 << layout.widths[group]
                    more = self._more[group] = np.zeros(shape, layout.kind)
                by = np.zeros(max(layout.sizes[one], 1), layout.kind)
                for source, target in self.operations[number].targets[one].items():
                    by[source] = layout.moved(one, target - source)
                more[row] += by[layout.states_in_field(one)]
        self._is_uneven = bool(uneven)

    def led(self, codes: Array, operations: Array) -> Array:
        """Return the code after each step: operation n is taken in configuration n."""
        found: Array = codes + self.changes.take(operations)
        if self._is_uneven:
            kinds = self._uneven.take(operations)
            (which,) = np.nonzero(kinds >= 0)
            if len(which):
                rows, here = kinds[which], codes[which]
                for group, more in enumerate(self._more):
                    if more is not None:
                        found[which] += more[rows, self.layout.field(here, group)]
        return found
