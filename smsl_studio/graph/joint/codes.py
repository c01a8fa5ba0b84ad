"""Writes each configuration as one whole number, its code, so that arrays can hold it.

The SBs are divided into groups. A code has a field of bits for each group. The field tells the
states of all SBs of the group. So a table with one row for each value of a field answers questions
about its group.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from smsl_studio.graph.joint.products import TooLarge

MOST_OF_GROUP = 4_096
"""The largest product of the state counts of the SBs in a group. An SB with more states is a group
by itself."""

MOST_BITS = 62
"""The largest number of bits of a code."""

Array = np.ndarray[Any, Any]


class CodeLayout:
    """Where the state of each SB stands in a code.

    ``sizes`` has the number of states of each SB, and ``levels`` its place in the order, the
    highest first. Neighbours in this order share a group. TooLarge if a code would need more than
    ``MOST_BITS`` bits.
    """

    def __init__(
        self, sizes: Sequence[int], levels: Sequence[int], most: int = MOST_OF_GROUP
    ) -> None:
        self.sizes = sizes
        order = sorted(range(len(sizes)), key=lambda one: -levels[one])
        self.groups: list[list[int]] = []
        product = most
        for one in order:
            size = max(sizes[one], 1)
            if not self.groups or product * size > most:
                self.groups.append([])
                product = 1
            self.groups[-1].append(one)
            product *= size
        self.group_of = [0] * len(sizes)
        self.step_of = [0] * len(sizes)
        """How much the field of the group grows if the number of the SB's state grows by 1."""
        self.widths: list[int] = []
        for number, group in enumerate(self.groups):
            step = 1
            for one in reversed(group):
                self.group_of[one], self.step_of[one] = number, step
                step *= max(sizes[one], 1)
            self.widths.append((step - 1).bit_length())
        self.bits = sum(self.widths)
        if self.bits > MOST_BITS:
            raise TooLarge(f"{MOST_BITS} bits of a configuration")
        self.shifts = [sum(self.widths[number + 1 :]) for number in range(len(self.groups))]
        self.kind = np.dtype(np.int32 if self.bits < 31 else np.int64)

    def code(self, configuration: Sequence[int]) -> int:
        """Return the code of a configuration."""
        return sum(self.moved(one, state) for one, state in enumerate(configuration))

    def moved(self, one: int, by: int) -> int:
        """Return the change of the code if the number of an SB's state changes by ``by``."""
        return by * self.step_of[one] << self.shifts[self.group_of[one]]

    def states(self, codes: Array, one: int) -> Array:
        """Return the number of the SB's state in each configuration."""
        field = self.field(codes, self.group_of[one])
        return field // self.step_of[one] % max(self.sizes[one], 1)

    def states_in_field(self, one: int) -> Array:
        """Return an array: for each value of the field of the SB's group, the number of the SB's
        state.
        """
        fields = np.arange(1 << self.widths[self.group_of[one]])
        return fields // self.step_of[one] % max(self.sizes[one], 1)

    def field(self, codes: Array, group: int) -> Array:
        """Return the value of a group's field in each code."""
        shift = self.shifts[group]
        found = codes >> shift if shift else codes
        return found & ((1 << self.widths[group]) - 1) if group else found


class PlainNumbers:
    """Uses each code as its own number. It is for short codes."""

    def __init__(self, layout: CodeLayout) -> None:
        self.size = 1 << layout.bits

    def made_room(self, count: int) -> bool:
        """Return False: there is a number for every code."""
        return False

    def of(self, codes: Array) -> Array:
        """Return the codes themselves, each below ``size``."""
        return codes
