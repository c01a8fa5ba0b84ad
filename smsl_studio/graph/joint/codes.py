"""Configurations as single numbers, for searches in arrays.

Some SBs together are a group. A code has a field of bits for each group, and a field says in which
states its SBs are. So what is true in a configuration is looked up group by group.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from smsl_studio.graph.joint.products import TooLarge

MOST_OF_GROUP = 4_096
"""The largest product of the state counts of a group, unless it has one SB alone."""

MOST_BITS = 62
"""The largest number of bits of a code."""

Array = np.ndarray[Any, Any]


class CodeLayout:
    """Where the states of each SB stand in a code.

    ``sizes`` are the numbers of states and ``levels`` the order of the SBs, the highest first; near
    SBs are in one group. TooLarge if a code has no room for all of them.
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
        """What one state more of an SB adds to the field of its group."""
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
        """Return what a code changes by if an SB moves by a number of states."""
        return by * self.step_of[one] << self.shifts[self.group_of[one]]

    def states(self, codes: Array, one: int) -> Array:
        """Return the states of an SB in some configurations."""
        field = self.field(codes, self.group_of[one])
        return field // self.step_of[one] % max(self.sizes[one], 1)

    def states_in_field(self, one: int) -> Array:
        """Return the state of an SB for each value that the field of its group can have."""
        fields = np.arange(1 << self.widths[self.group_of[one]])
        return fields // self.step_of[one] % max(self.sizes[one], 1)

    def field(self, codes: Array, group: int) -> Array:
        """Return the fields of a group."""
        shift = self.shifts[group]
        found = codes >> shift if shift else codes
        return found & ((1 << self.widths[group]) - 1) if group else found


class PlainNumbers:
    """Numbers configurations by their codes."""

    def __init__(self, layout: CodeLayout) -> None:
        self.size = 1 << layout.bits

    def made_room(self, count: int) -> bool:
        """Return False: there is room for all."""
        return False

    def of(self, codes: Array) -> Array:
        """Return the number of each configuration, below ``size``."""
        return codes
