"""The graph of one State Branch as integer arrays. It is built once and kept with the branch."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import accumulate, chain, islice, repeat
from typing import cast

from smsl_studio.blueprint.model import StateBranch, Table
from smsl_studio.blueprint.numbers import numbers_of
from smsl_studio.errors import AddressError, did_you_mean

_KEY = "_graph"


@dataclass(frozen=True, eq=False)
class BranchGraph:
    """The states and operations of a State Branch by number, in written order.

    Edge ``e`` is the operation ``operations[e]`` from state ``sources[e]`` to state ``targets[e]``.
    The edges that leave state ``i`` are ``range(starts[i], starts[i + 1])``. An operation whose
    target is not a state of the SB (rule R02) has no edge here.
    """

    branch: str
    names: tuple[str, ...]
    index: dict[str, int]
    starts: Sequence[int]
    targets: Sequence[int]
    table: Table = field(repr=False)
    """The branch's table, from which the graph was made."""

    def __len__(self) -> int:
        return len(self.names)

    def number(self, state: str) -> int:
        """Return the number of a state. AddressError if the SB has no such state."""
        try:
            return self.index[state]
        except KeyError:
            raise AddressError(
                f"there is no state {state!r} in {self.branch}",
                advice=did_you_mean(state, self.index),
            ) from None

    def is_like(self, other: BranchGraph) -> bool:
        """Whether the operations lead from and to the same states by number, in one order."""
        return self.starts == other.starts and self.targets == other.targets

    def edges_out(self, state: int) -> range:
        """Return the numbers of the edges that leave a state."""
        return range(self.starts[state], self.starts[state + 1])

    @cached_property
    def all_edges_out(self) -> list[range]:
        """For each state the numbers of the edges that leave it."""
        return list(map(range, self.starts, islice(self.starts, 1, None)))

    @cached_property
    def sources(self) -> list[int]:
        """For each edge the number of the state it leaves."""
        counts = map(operator.sub, islice(self.starts, 1, None), self.starts)
        return list(chain.from_iterable(map(repeat, range(len(self.names)), counts)))

    @cached_property
    def operations(self) -> list[str]:
        """For each edge the name of its operation."""
        if len(self.targets) == sum(map(len, self.table.values())):
            return list(chain.from_iterable(self.table.values()))
        index = self.index
        return [
            operation
            for operations in self.table.values()
            for operation, target in operations.items()
            if target in index
        ]

    @cached_property
    def successors(self) -> list[list[int]]:
        """For each state the numbers of the states its operations lead to, in written order."""
        starts, targets = self.starts, list(self.targets)
        return [targets[starts[i] : starts[i + 1]] for i in range(len(self.names))]

    @cached_property
    def predecessors(self) -> list[list[int]]:
        """For each state the numbers of the states whose operations lead to it."""
        found: list[list[int]] = [[] for _ in self.names]
        for source, target in zip(self.sources, self.targets, strict=True):
            found[target].append(source)
        return found

    @cached_property
    def edges_in(self) -> list[list[int]]:
        """For each state the numbers of the edges that lead to it."""
        found: list[list[int]] = [[] for _ in self.names]
        for edge, target in enumerate(self.targets):
            found[target].append(edge)
        return found

    @cached_property
    def neighbours(self) -> list[list[int]]:
        """For each state the numbers of the other states that an operation joins with it, in either
        direction.
        """
        found: list[dict[int, None]] = [{} for _ in self.names]
        for source, target in zip(self.sources, self.targets, strict=True):
            if source != target:
                found[source][target] = None
                found[target][source] = None
        return [list(near) for near in found]


def graph_of(branch: StateBranch) -> BranchGraph:
    """Return the graph of a branch. It is built at the first call.

    It is kept in the branch's own dictionary, as a ``cached_property`` would be. A branch is
    frozen, so its graph never changes, and it is freed together with the branch.
    """
    kept = branch.__dict__.get(_KEY)
    if isinstance(kept, BranchGraph):
        return kept
    graph = _build(branch)
    branch.__dict__[_KEY] = graph
    return graph


def _build(branch: StateBranch) -> BranchGraph:
    table, numbers = branch.table, numbers_of(branch)
    if numbers.dangles:
        counts = [sum(target in numbers.of for target in o.values()) for o in table.values()]
        targets = [target for target in numbers.targets if target is not None]
    else:
        counts = list(map(len, table.values()))
        targets = cast("list[int]", numbers.targets)
    starts = list(accumulate(counts, initial=0))
    return BranchGraph(branch.name, tuple(table), numbers.of, starts, targets, table)
