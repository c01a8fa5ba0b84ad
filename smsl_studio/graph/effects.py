"""What each operation of a State Branch does to the facts, for all of its edges at once.

The effect of an edge is the set of (digit, new value) for the digits that it changes. Most edges
have one of few effects, so an edge has the number of its effect. It is computed once and kept with
the branch.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import repeat
from operator import add, mul
from typing import TYPE_CHECKING, Any

from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.facts import changed_digits, fact_strings
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.build import BranchGraph, graph_of

if TYPE_CHECKING:
    import numpy as np

Effect = tuple[tuple[int, str], ...]
"""(digit, new value) for each digit that an edge changes. Digits count from 0."""

MANY = 5_000
"""Of so many edges the effects are computed in arrays; of fewer, numpy is not loaded."""
_KEY = "_edge_effects"


@dataclass(frozen=True, eq=False)
class EdgeEffects:
    """Edge ``e`` of ``graph`` has the effect ``kinds[of[e]]``. Kinds stand in the order in which
    they first occur."""

    graph: BranchGraph
    kinds: Sequence[Effect]
    of: Sequence[int]

    @cached_property
    def counts(self) -> Mapping[tuple[str, int], int]:
        """The number of edges with this operation and this effect, in the order of the edges."""
        return Counter(zip(self.graph.operations, self.of, strict=True))

    @cached_property
    def majority(self) -> Mapping[str, Effect | None]:
        """For each operation the effect that more than half of its edges have, or None."""
        totals: Counter[str] = Counter()
        most: dict[str, tuple[int, int]] = {}
        for (name, kind), count in self.counts.items():
            totals[name] += count
            if count > most.get(name, (0, 0))[0]:
                most[name] = count, kind
        return {
            name: self.kinds[kind] if 2 * count > totals[name] else None
            for name, (count, kind) in most.items()
        }

    @cached_property
    def holders(self) -> Mapping[Effect, Sequence[str]]:
        """For each effect the operations that have it as their majority. An effect that changes
        nothing is left out."""
        found: dict[Effect, list[str]] = {}
        for name, most in self.majority.items():
            if most:
                found.setdefault(most, []).append(name)
        return found

    def edge(self, number: int) -> Operation:
        """Return an edge as a value."""
        graph = self.graph
        names, source, target = graph.names, graph.sources[number], graph.targets[number]
        return Operation(graph.branch, names[source], graph.operations[number], names[target])

    @cached_property
    def one_way(self) -> Sequence[int]:
        """The edges between two states that no edge joins in the opposite direction."""
        graph, many = self.graph, len(self.graph)
        there = map(add, map(mul, repeat(many), graph.sources), graph.targets)
        back = map(add, map(mul, repeat(many), graph.targets), graph.sources)
        known = set(there)
        return [edge for edge, key in enumerate(back) if key not in known]


def effects_of(branch: StateBranch) -> EdgeEffects:
    """Return the effects of the edges of a branch. They are computed at the first call."""
    kept = branch.__dict__.get(_KEY)
    if not isinstance(kept, EdgeEffects):
        graph = graph_of(branch)
        many = len(graph.targets) >= MANY and not branch.shape.opaque
        kept = _in_arrays(branch, graph) if many else _one_by_one(branch, graph)
        branch.__dict__[_KEY] = kept
    return kept


def effect(branch: StateBranch, source: str, target: str) -> Effect:
    """Return the effect of an operation between two states."""
    before, after = branch.facts(source), branch.facts(target)
    return tuple((digit, after[digit]) for digit in changed_digits(before, after))


def _one_by_one(branch: StateBranch, graph: BranchGraph) -> EdgeEffects:
    numbers: dict[Effect, int] = {}
    known: dict[tuple[int, int], int] = {}
    of = []
    for ends in zip(graph.sources, graph.targets, strict=True):
        number = known.get(ends)
        if number is None:
            found = effect(branch, graph.names[ends[0]], graph.names[ends[1]])
            number = known[ends] = numbers.setdefault(found, len(numbers))
        of.append(number)
    return EdgeEffects(graph, list(numbers), of)


def _in_arrays(branch: StateBranch, graph: BranchGraph) -> EdgeEffects:
    """Compute the same with arrays: one number for each edge, which grows digit by digit."""
    import numpy as np

    sources, targets = np.asarray(graph.sources), np.asarray(graph.targets)
    numbers = np.zeros(len(targets), np.int64)
    for column in _columns(branch):
        values, ranks = np.unique(column, return_inverse=True)
        before, after = ranks[sources], ranks[targets]
        new = np.where(before == after, 0, after + 1)
        if numbers.max() >= 2**62 // (len(values) + 1):
            numbers = np.unique(numbers, return_inverse=True)[1]
        numbers = numbers * (len(values) + 1) + new
    _, firsts, inverse = np.unique(numbers, return_index=True, return_inverse=True)
    order = np.argsort(firsts)
    places = np.empty_like(order)
    places[order] = np.arange(len(order))
    ends = zip(sources[firsts[order]].tolist(), targets[firsts[order]].tolist(), strict=True)
    kinds = [effect(branch, graph.names[source], graph.names[target]) for source, target in ends]
    return EdgeEffects(graph, kinds, places[inverse].tolist())


def _columns(branch: StateBranch) -> Sequence[np.ndarray[Any, Any]]:
    """Return an array for each digit: equal numbers for the states with equal values."""
    import numpy as np

    shape, count = branch.shape, len(branch.table)
    if shape.width:
        text = "".join(fact_strings(branch.table, shape.written))
        letters = np.frombuffer(text.encode("utf-32-le", "surrogatepass"), np.uint32)
        cut = letters.reshape(count, shape.num_facts, shape.width)
        if shape.width == 1:
            return [cut[:, digit, 0] for digit in range(shape.num_facts)]
        words = np.ascontiguousarray(cut).view(np.dtype((np.void, 4 * shape.width)))[:, :, 0]
        return [np.unique(words[:, d], return_inverse=True)[1] for d in range(shape.num_facts)]
    columns = zip(*map(branch.facts, branch.table), strict=True)
    codes: dict[str, int] = {}
    return [np.asarray([codes.setdefault(v, len(codes)) for v in column]) for column in columns]
