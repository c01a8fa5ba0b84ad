"""The states of an SB as numbers, and the targets of its operations."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import chain, count
from operator import methodcaller

from smsl_studio.blueprint.model import StateBranch

_KEY = "_numbers"
_values = methodcaller("values")


@dataclass(frozen=True, eq=False)
class Numbers:
    """``of`` has the number of each state in written order. ``targets`` has the number of the
    target of every operation in written order, or None if the SB has no such state.
    """

    of: dict[str, int]
    targets: list[int | None]

    @cached_property
    def dangles(self) -> bool:
        """Whether an operation leads to no state of the SB (rule R02)."""
        return None in self.targets


def numbers_of(branch: StateBranch) -> Numbers:
    """Return the numbers of a branch. They are computed at the first call and kept with it."""
    kept = branch.__dict__.get(_KEY)
    if isinstance(kept, Numbers):
        return kept
    table = branch.table
    of = dict(zip(table, count(), strict=False))
    targets = chain.from_iterable(map(_values, table.values()))
    numbers = Numbers(of, list(map(of.get, targets)))
    branch.__dict__[_KEY] = numbers
    return numbers
