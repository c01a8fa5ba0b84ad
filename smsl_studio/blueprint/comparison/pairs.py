"""Finds the renamed states of an SB: which state of one version is which state of the other.

A name on both sides is the same state. For the other states pairs are proposed. The two states of a
proposal stand at the same place in the file, have the same facts, are both the start or the goal,
or are reached from a known pair. A pair is accepted if at least half of its operations agree. Each
pair is compared only a few times, so the work grows linearly with the number of operations.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple, TypeVar

from smsl_studio.blueprint.model import StateBranch, Table

ENOUGH = 0.5
_LOOKS = 4

Pair = tuple[str, str]
Ends = Sequence[tuple[str, str]]
K = TypeVar("K", bound=Hashable)


def renamed_states(before: StateBranch, after: StateBranch) -> dict[str, str]:
    """Return the new name of every state of ``before`` that has another name in ``after``."""
    gone = [name for name in before.table if name not in after.table]
    come = [name for name in after.table if name not in before.table]
    if not gone or not come:
        return {}
    return _PairSearch(before, after, gone, come).found()


class _PairSearch:
    """The search for pairs. ``gone`` and ``come`` are the names that only one side has."""

    def __init__(
        self, before: StateBranch, after: StateBranch, gone: list[str], come: list[str]
    ) -> None:
        self.before, self.after = before, after
        self.gone = {name: number for number, name in enumerate(gone)}
        self.come = {name: number for number, name in enumerate(come)}
        self.into_before, self.into_after = _into(before.table), _into(after.table)
        self.pairs: dict[str, str] = {}
        self.taken: set[str] = set()
        self.looks: Counter[Pair] = Counter()

    def found(self) -> dict[str, str]:
        """Return the pairs: the certain ones first, and those with only the same place in the file
        last.
        """
        for proposals in (self._certain(), _same_place(self.before.table, self.after.table)):
            fresh = self._accept(proposals)
            while fresh:
                fresh = self._accept(pair for known in fresh for pair in self._around(*known))
        return self.pairs

    def _certain(self) -> Iterator[Pair]:
        """Yield pairs with the same role or the same facts, and the targets of states that kept
        their names.
        """
        yield self.before.initial, self.after.initial
        yield self.before.activating, self.after.activating
        for name in self.before.table:
            if name in self.after.table:
                yield from self._around(name, name)
        yield from self._same_facts()

    def _same_facts(self) -> Iterator[Pair]:
        old = _unique((self.before.facts(name), name) for name in self.gone)
        new = _unique((self.after.facts(name), name) for name in self.come)
        for facts, name in old.items():
            if facts in new:
                yield name, new[facts]

    def _around(self, old: str, new: str) -> Iterator[Pair]:
        """Yield the targets of a known pair by operations of the same name, and the sources that
        alone lead to it by one name.
        """
        others = self.after.table[new]
        for operation, target in self.before.table[old].items():
            if operation in others:
                yield target, others[operation]
        left = _unique((op, source) for source, op in self._open(self.into_before, self.gone, old))
        if not left:
            return
        right = _unique((op, source) for source, op in self._open(self.into_after, self.come, new))
        for operation, source in left.items():
            if operation in right:
                yield source, right[operation]

    def _open(self, into: Mapping[str, Ends], wanted: Mapping[str, int], name: str) -> Ends:
        return [end for end in into.get(name, ()) if end[0] in wanted]

    def _accept(self, proposals: Iterable[Pair]) -> list[Pair]:
        """Accept some of the proposed pairs, the best first, and return them. Each state is paired
        once.
        """
        scored = []
        for pair in dict.fromkeys(proposals):
            if self._is_open(pair) and self.looks[pair] < _LOOKS:
                self.looks[pair] += 1
                score = self._score(*pair)
                if score >= ENOUGH:
                    here, there = self.gone[pair[0]], self.come[pair[1]]
                    # Two pairs of one state never have equal keys, so both directions give the same
                    # result.
                    scored.append((-score, abs(here - there), here + there, here, pair))
        fresh = []
        for *_, pair in sorted(scored):
            if self._is_open(pair):
                self.pairs[pair[0]] = pair[1]
                self.taken.add(pair[1])
                fresh.append(pair)
        return fresh

    def _is_open(self, pair: Pair) -> bool:
        old, new = pair
        return (
            old in self.gone
            and new in self.come
            and old not in self.pairs
            and new not in self.taken
        )

    def _score(self, old: str, new: str) -> float:
        """Return the share of equal operations in and out of both states, 1.0 if they have none.

        It is 0.0 if one has so many more operations than the other that the share cannot be
        ``ENOUGH``. So the operations of a state with very many are not counted again for each
        comparison.
        """
        fewer, more = sorted(
            (
                len(self.before.table[old]) + len(self.into_before.get(old, ())),
                len(self.after.table[new]) + len(self.into_after.get(new, ())),
            )
        )
        if fewer < ENOUGH * more:
            return 0.0
        one = Counter(("out", op, self._old(t)) for op, t in self.before.table[old].items())
        one.update(("in", op, self._old(s)) for s, op in self.into_before.get(old, ()))
        other = Counter(("out", op, self._new(t)) for op, t in self.after.table[new].items())
        other.update(("in", op, self._new(s)) for s, op in self.into_after.get(new, ()))
        total = max(one.total(), other.total())
        return (one & other).total() / total if total else 1.0

    def _old(self, name: str) -> str:
        """Return the later name of a neighbour. All unknown ones count as the same."""
        return self.pairs.get(name, "") if name in self.gone else name

    def _new(self, name: str) -> str:
        return "" if name in self.come and name not in self.taken else name


def _into(table: Table) -> dict[str, list[tuple[str, str]]]:
    """Return for each target the sources and names of the operations that lead to it."""
    found: dict[str, list[tuple[str, str]]] = {}
    for source, operations in table.items():
        for operation, target in operations.items():
            found.setdefault(target, []).append((source, operation))
    return found


def _unique(items: Iterable[tuple[K, str]]) -> dict[K, str]:
    """Return the items whose key occurs once."""
    found: dict[K, str] = {}
    doubled = set()
    for key, value in items:
        if key in found:
            doubled.add(key)
        found[key] = value
    return {key: value for key, value in found.items() if key not in doubled}


def _same_place(before: Table, after: Table) -> Iterator[Pair]:
    """Yield pairs of names at the same place between the same kept names."""
    one, other = _runs(before, after), _runs(after, before)
    for anchor, names in one.items():
        others = other.get(anchor, [])
        if len(others) == len(names):
            yield from zip(names, others, strict=True)


def _runs(table: Table, kept: Table) -> dict[str, list[str]]:
    """Return the names after each kept name, and those before the first one."""
    found: dict[str, list[str]] = {}
    anchor = ""
    for name in table:
        if name in kept:
            anchor = name
        else:
            found.setdefault(anchor, []).append(name)
    return found


def renamed_branches(
    before: Mapping[str, StateBranch], after: Mapping[str, StateBranch]
) -> dict[str, str]:
    """Return the new name of every SB that was renamed.

    An SB is recognised by its content. Two thirds of its states must have the same names. Two
    thirds of its operations must have the same source, name and target. If both SBs have names of
    facts or titles of states, two thirds of these must be equal, too. It must expand the same facts
    of the same bases. So a deleted SB and an added SB are not taken for one, even if both have
    ``State_0`` and ``State_1``.
    """
    gone = [name for name in before if name not in after]
    come = [name for name in after if name not in before]
    if not gone or not come:
        return {}
    places = _places(before, after), _places(after, before)
    sides = _Sided(before, gone, places[0]), _Sided(after, come, places[1])
    if max(len(gone), len(come)) > _MOST_BRANCHES:
        return _equal_branches(*sides)
    return _pair_branches(*sides)


class _Sided(NamedTuple):
    """One version of a blueprint: its SBs, the ``names`` that only it has, the expanded facts."""

    branches: Mapping[str, StateBranch]
    names: list[str]
    places: Mapping[str, set[tuple[str, int]]]


def _places(
    branches: Mapping[str, StateBranch], others: Mapping[str, StateBranch]
) -> dict[str, set[tuple[str, int]]]:
    """Return for each sub-SB the facts that it expands. Bases with other names are left out."""
    found: dict[str, set[tuple[str, int]]] = {}
    for base, branch in branches.items():
        for digit, sub in branch.subs.items() if base in others else ():
            found.setdefault(sub, set()).add((base, digit))
    return found


_ALIKE = 2 / 3
"""The least share of states, of operations and of words that a renamed SB keeps."""
_MOST_BRANCHES = 40
"""With more SBs than these on a side, only SBs with equal tables are paired."""


def _pair_branches(before: _Sided, after: _Sided) -> dict[str, str]:
    scored = [
        (-share, abs(i - j), i + j, i, (old, new))
        for i, old in enumerate(before.names)
        for j, new in enumerate(after.names)
        if before.places.get(old) == after.places.get(new)
        and (share := _share(before.branches[old], after.branches[new])) >= _ALIKE
    ]
    found: dict[str, str] = {}
    for *_, (old, new) in sorted(scored):
        if old not in found and new not in found.values():
            found[old] = new
    return found


def _equal_branches(before: _Sided, after: _Sided) -> dict[str, str]:
    """Pair only SBs with equal tables. This is for many SBs, because it is quick."""
    one, other = (
        _unique((_print_of(side.branches[name]), name) for name in side.names)
        for side in (before, after)
    )
    return {
        name: other[key]
        for key, name in one.items()
        if key in other and before.places.get(name) == after.places.get(other[key])
    }


def _share(one: StateBranch, other: StateBranch) -> float:
    """Return how much two SBs have in common (0 to 1).

    It is the smallest of three shares: of states, of operations, and of names and titles.
    """
    states, operations = (
        max(len(one.table), len(other.table)),
        max(one.edge_count, other.edge_count),
    )
    both = [name for name in one.table if name in other.table]
    if not states or len(both) < _ALIKE * states:
        return 0.0
    if not operations:
        return 1.0 if len(both) == states else 0.0
    same = sum(len(one.table[n].items() & other.table[n].items()) for n in both)
    said, known = _words(one), _words(other)
    fewer = min(len(said), len(known))
    words = len(said & known) / fewer if fewer else 1.0
    return min(len(both) / states, same / operations, words)


def _words(branch: StateBranch) -> set[tuple[Hashable, str]]:
    """Return the names of facts and the titles of states."""
    notes = branch.notes
    facts = {(digit, note.name) for digit, note in notes.facts.items() if note.name}
    return facts | {(state, note.title) for state, note in notes.states.items() if note.title}


def _print_of(branch: StateBranch) -> Hashable:
    return tuple((name, tuple(operations.items())) for name, operations in branch.table.items())
