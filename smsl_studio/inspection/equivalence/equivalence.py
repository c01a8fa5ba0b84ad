"""Compares two blueprints by what they do: bisimulation from their starts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import PlanningError
from smsl_studio.inspection.equivalence.refinement import Refinement
from smsl_studio.inspection.equivalence.transitions import (
    FactAt,
    Label,
    Transitions,
    fact_keys,
    transitions_of,
)
from smsl_studio.inspection.proof.way import way_to
from smsl_studio.stop import heed

Json = Any
Facts = Sequence[tuple[str, ...]]
Labels = tuple[str, ...]
Pair = tuple[int, int]
Keys = tuple[dict[str, FactAt], dict[str, FactAt]]
"""The facts of both sides that are compared, under the same keys."""


class ComparedView(NamedTuple):
    """The names under which the facts and the operations of both sides are compared.

    ``names`` stand for the two sides in sentences.
    """

    keys: Keys
    labels: tuple[Label, Label]
    names: tuple[str, str] = ("the file", "the result")


@dataclass(frozen=True)
class Equivalence:
    """Whether two blueprints behave alike. ``equal`` is None if a limit was met before that is
    known.

    ``path`` has the labels of a shortest run after which they differ, and ``reason`` says how: by
    a fact, or by an operation that only one of them permits. Then this operation is the last of
    the path. ``configurations`` are the numbers of those that were reached.
    """

    equal: bool | None
    path: tuple[str, ...]
    reason: str
    configurations: tuple[int, int]

    def as_json(self) -> dict[str, Json]:
        """Return it as ``diff --behaviour`` writes it."""
        return {
            "equal": self.equal,
            "path": list(self.path),
            "reason": self.reason,
            "configurations": list(self.configurations),
        }


def equivalence(
    first: Blueprint,
    second: Blueprint,
    limit: int,
    view: ComparedView | None = None,
    names: tuple[str, str] | None = None,
) -> Equivalence:
    """Compare the behaviour of two blueprints, each with at most ``limit`` stored configurations.

    INITIAL, facts and permitted operations must be equal. ACTIVATING, costs and titles may differ.
    ``view`` renames facts and operations before they are compared. Without a view, sentences call
    the blueprints by ``names`` instead of their files. RunRefused if one of them has no start.
    """
    names = names or (first.file, second.file)
    labels = view.labels if view else (None, None)
    sides = transitions_of(first, limit, labels[0]), transitions_of(second, limit, labels[1])
    counts = len(sides[0].keys), len(sides[1].keys)
    for side, name in zip(sides, names, strict=True):
        if side.bound:
            reason = f"{name} met the limit of {side.bound}"
            return Equivalence(None, (), reason, counts)
    if view is not None:
        return _Compared(sides, view.keys, limit, view.names).equivalence(counts)
    keys = fact_keys(first), fact_keys(second)
    if keys[0].keys() != keys[1].keys():
        keys = fact_keys(first, named=False), fact_keys(second, named=False)
    return _Compared(sides, keys, limit, names).equivalence(counts)


class _Compared:
    """Two transition systems, and the facts that are compared."""

    def __init__(
        self,
        sides: tuple[Transitions, Transitions],
        keys: Keys,
        limit: int,
        names: tuple[str, str],
    ) -> None:
        self._sides, self._keys, self._limit, self._names = sides, keys, limit, names
        self._both = sorted(keys[0].keys() & keys[1].keys())
        first, second = (
            list(side.facts({key: known[key] for key in self._both}))
            for side, known in zip(sides, keys, strict=True)
        )
        self._facts: tuple[Facts, Facts] = first, second

    def equivalence(self, counts: tuple[int, int]) -> Equivalence:
        """Return the answer."""
        missing = self._keys[0].keys() ^ self._keys[1].keys()
        if missing:
            key = min(missing)
            has, lacks = (0, 1) if key in self._keys[0] else (1, 0)
            reason = f"{self._file(has)} has the fact {key}, and {self._file(lacks)} has not"
            return Equivalence(False, (), reason, counts)
        try:
            plain = self._is_plain(0) and self._is_plain(1)
            path = self._walked() if plain else self._refined()
        except PlanningError as error:
            return Equivalence(None, (), error.sentence, counts)
        if path is None:
            return Equivalence(True, (), "", counts)
        return Equivalence(False, path, self._reason(path), counts)

    def _file(self, side: int) -> str:
        return self._names[side]

    def _is_plain(self, side: int) -> bool:
        """Whether each label leads to one configuration at most."""
        return all(
            one[0] != other[0] for row in self._sides[side].labels for one, other in pairwise(row)
        )

    def _walked(self) -> Labels | None:
        """Walk both systems together. Return the shortest run after which they differ, None if
        there is none. PlanningError if too many pairs of configurations come together.
        """
        left, right = (side.labels for side in self._sides)
        came: dict[Pair, tuple[Pair, str] | None] = {(0, 0): None}
        layer, odd = [(0, 0)], None
        while layer and odd is None:
            following: list[Pair] = []
            for here in layer:
                heed()
                if self._facts[0][here[0]] != self._facts[1][here[1]]:
                    return way_to(here, came.__getitem__)[1]
                one, other = dict(left[here[0]]), dict(right[here[1]])
                only = min(one.keys() ^ other.keys(), default=None)
                if only is not None:
                    odd = odd or (*way_to(here, came.__getitem__)[1], only)
                    continue
                for label, target in one.items():
                    after = target, other[label]
                    if after not in came:
                        came[after] = here, label
                        following.append(after)
                if len(came) > 2 * self._limit:
                    raise PlanningError(f"more than {2 * self._limit:,} pairs came together")
            layer = following
        return odd

    def _refined(self) -> Labels | None:
        """Compare by partition refinement, because a label leads to several configurations."""
        first, second = self._sides
        shift = len(first.keys)
        moved = [[(label, at + shift) for label, at in row] for row in second.labels]
        found = Refinement([*self._facts[0], *self._facts[1]], [*first.labels, *moved])
        return None if found.alike(0, shift) else found.run(0, shift)

    def _reason(self, path: Labels) -> str:
        """Return how the two differ at the end of a run."""
        after = f"after {counted(len(path))}" if path else "at the start"
        nodes: tuple[set[int], set[int]] = ({0}, {0})
        for label in path:
            one, other = (
                {target for node in nodes[at] for name, target in rows[node] if name == label}
                for at, rows in enumerate(side.labels for side in self._sides)
            )
            if not (one and other):
                can, cannot = (0, 1) if one else (1, 0)
                return f"{after} {self._file(can)} has {label}, and {self._file(cannot)} has not"
            nodes = one, other
        seen = [{self._facts[at][node] for node in nodes[at]} for at in (0, 1)]
        if len(seen[0]) == len(seen[1]) == 1 and seen[0] != seen[1]:
            (one_values,), (other_values,) = seen
            pairs = zip(self._both, one_values, other_values, strict=True)
            key, left, right = next(item for item in pairs if item[1] != item[2])
            return f"{after} {key} is {left} in {self._file(0)} and {right} in {self._file(1)}"
        return f"{after} one of them can be where the other cannot follow"


def counted(operations: int) -> str:
    """Return a number of operations in words."""
    return f"{operations:,} operation{'' if operations == 1 else 's'}"
