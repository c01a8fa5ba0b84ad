"""Edges that one case of a rule can make, because they lead to the same new values."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from smsl_studio.generate.examples.atoms import Atoms
from smsl_studio.generate.examples.family import Family
from smsl_studio.generate.examples.table import ExampleTable
from smsl_studio.stop import heed

MOST_GROUPS = 90
"""The most groups that are looked for."""
_MOST_WAYS = 64
_MOST_COMPARED = 2_000_000
Assignment = tuple[str, str]
"""A fact and its new value, as a rule writes them."""
_Signature = tuple[int, frozenset[int], frozenset[Assignment]]
"""The number of an operation, the facts that an edge changes, and what is true after it."""


@dataclass
class EdgeGroup:
    """Edges that one case can make. ``sets`` has what all of them have in common, ``changed`` the
    facts that they change, by the number of the operation."""

    changed: dict[int, frozenset[int]]
    sets: frozenset[Assignment]
    mask: int


class EdgeGroups:
    """Sorts the edges of a family into few groups, in two ways. None if there are too many."""

    def __init__(self, table: ExampleTable, family: Family, atoms: Atoms) -> None:
        self._table, self._family, self._atoms = table, family, atoms
        self._states = table.states
        self._numbers = {values: at for at, values in enumerate(self._states)}
        self._signatures = self._signed()

    def common(self) -> list[EdgeGroup] | None:
        """Take the change that most edges share, again and again."""
        ways: dict[frozenset[Assignment], None] = {}
        for number, moved, true in (signature for signature, _ in self._signatures):
            for way in self._ways(number, moved, true):
                ways[way] = None
            if len(ways) * len(self._signatures) > _MOST_COMPARED:
                return None
        facts = self._atoms.terms.facts
        reach: dict[frozenset[Assignment], list[int]] = {}
        for way in ways:
            heed()
            digits = [facts[fact] for fact, _ in way]
            reach[way] = [
                at
                for at, ((number, moved, true), _) in enumerate(self._signatures)
                if way <= true and moved <= {own[number] for own in digits}
            ]
        groups: list[EdgeGroup] = []
        left = set(range(len(self._signatures)))
        while left:
            if len(groups) >= MOST_GROUPS or not reach:
                return None
            counts = {way: len(left.intersection(own)) for way, own in reach.items()}
            best = max(counts, key=lambda way: (counts[way], -len(way)))
            if not counts[best]:
                return None
            group = EdgeGroup({}, best, 0)
            for at in left.intersection(reach.pop(best)):
                (number, moved, _), mask = self._signatures[at]
                group.changed[number] = group.changed.get(number, frozenset()) | moved
                group.mask |= mask
                left.discard(at)
            groups.append(group)
        return sorted(groups, key=lambda group: -group.mask.bit_count())

    def merged(self) -> list[EdgeGroup] | None:
        """Put each edge to the group with which it has the most in common."""
        groups: list[EdgeGroup] = []
        for (number, moved, true), mask in self._signatures:
            heed()
            fitting = [(group, group.sets & true) for group in groups]
            for group, sets in sorted(fitting, key=lambda one: -len(one[1])):
                wanted = {**group.changed}
                wanted[number] = wanted.get(number, frozenset()) | moved
                same = len(sets) == len(group.sets) and wanted == group.changed
                if same or self._covers(sets, wanted):
                    group.changed, group.sets = wanted, sets
                    group.mask |= mask
                    break
            else:
                if len(groups) >= MOST_GROUPS:
                    return None
                groups.append(EdgeGroup({number: moved}, true, mask))
        return sorted(groups, key=lambda group: -group.mask.bit_count())

    def _signed(self) -> list[tuple[_Signature, int]]:
        """Return what there is to know of each edge, with the edges of which that is true: those
        that change most first."""
        signatures: dict[tuple[object, ...], int] = {}
        seen: dict[tuple[object, ...], _Signature] = {}
        changing = self._changing()
        for at, operation in enumerate(self._family.operations):
            possible = self._possible(at, changing)
            for source, target in self._table.edges.get(operation, {}).items():
                heed()
                changed = frozenset(d for d in changing if source[d] != target[d])
                key: tuple[object, ...] = (at, changed, tuple(target[d] for d in changing))
                bit = 1 << (at * len(self._states) + self._numbers[source])
                signatures[key] = signatures.get(key, 0) | bit
                if key not in seen:
                    true = frozenset(one for one, digit, text in possible if target[digit] == text)
                    seen[key] = at, changed, true
        order = sorted(
            signatures, key=lambda key: (-len(seen[key][1]), -signatures[key].bit_count())
        )
        return [(seen[key], signatures[key]) for key in order]

    def _ways(
        self, number: int, moved: frozenset[int], true: frozenset[Assignment]
    ) -> Iterator[frozenset[Assignment]]:
        """Give the shortest changes that an edge could be: one way to set each fact it changes."""
        facts = self._atoms.terms.facts
        choices = [
            sorted(one for one in true if facts[one[0]][number] == digit) for digit in sorted(moved)
        ]
        for chosen in itertools.islice(itertools.product(*choices), _MOST_WAYS):
            yield frozenset(chosen)

    def _changing(self) -> tuple[int, ...]:
        found: set[int] = set()
        for operation in self._family.operations:
            for source, target in self._table.edges.get(operation, {}).items():
                heed()
                found.update(d for d, v in enumerate(source) if target[d] != v)
        return tuple(sorted(found))

    def _possible(self, at: int, changing: Sequence[int]) -> list[tuple[Assignment, int, str]]:
        """Return all ways to set a fact that changes, with its digit and its value."""
        terms = self._atoms.terms
        return [
            ((fact, value), digits[at], texts[at])
            for fact, digits in terms.facts.items()
            if digits[at] in changing
            for value, texts in terms.values.items()
            if terms.valid(fact, value, self._atoms.alphabets)
        ]

    def _covers(self, sets: frozenset[Assignment], wanted: Mapping[int, frozenset[int]]) -> bool:
        """Return whether all facts that change are set."""
        facts = self._atoms.terms.facts
        digits = [facts[fact] for fact in {fact for fact, _ in sets}]
        return all(changed <= {own[at] for own in digits} for at, changed in wanted.items())
