"""Bisimulation by partition refinement, where a label may lead to several configurations.

Round by round configurations are told apart by more steps: in round 0 by their facts, in each
further round by the labels they have and by what these lead to.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Sequence

from smsl_studio.errors import PlanningError
from smsl_studio.stop import heed

Labels = Sequence[Sequence[tuple[str, int]]]
Row = Sequence[tuple[Hashable, int]]
"""For each step out of a place what it is, and the number of the place that it leads to."""
MOST = 100_000_000
"""The largest number of entries that are kept, over all rounds."""


class Refinement:
    """The classes of the configurations of two systems, round by round.

    The configurations of the second system are numbered after those of the first. PlanningError if
    there are too many rounds.
    """

    def __init__(self, facts: Sequence[Hashable], labels: Labels) -> None:
        self._labels = labels
        self._rounds = [numbered(facts)]
        while (following := refined(self._rounds[-1], labels)) is not None:
            self._rounds.append(following)
            if len(self._rounds) * len(following) > MOST:
                words = f"more than {MOST:,} entries of classes"
                raise PlanningError(f"comparing met the limit of {words}")

    def alike(self, one: int, other: int) -> bool:
        """Whether two configurations behave alike."""
        return self._rounds[-1][one] == self._rounds[-1][other]

    def round_of(self, one: int, other: int) -> int:
        """Return the round in which two configurations are told apart first."""
        return next(at for at, row in enumerate(self._rounds) if row[one] != row[other])

    def run(self, one: int, other: int) -> tuple[str, ...]:
        """Return the labels of a run that tells two configurations apart. It has at most as many
        labels as ``round_of`` says."""
        path: list[str] = []
        while self.round_of(one, other):
            label, one, other = next(self._telling(one, other))
            path.append(label)
            if one < 0 or other < 0:
                break
        return tuple(path)

    def _telling(self, one: int, other: int) -> Iterator[tuple[str, int, int]]:
        """Yield steps after which the rest is told apart sooner; -1 stands for no step at all."""
        row = self._rounds[self.round_of(one, other) - 1]
        for label in sorted({label for at in (one, other) for label, _ in self._labels[at]}):
            heed()
            left, right = self._after(one, label), self._after(other, label)
            for ends, others, swapped in ((left, right, False), (right, left, True)):
                for end in ends:
                    if all(row[end] != row[rival] for rival in others):
                        rival = self._nearest_rival(end, others)
                        yield (label, rival, end) if swapped else (label, end, rival)

    def _nearest_rival(self, end: int, others: Sequence[int]) -> int:
        """Return the configuration that is told apart from ``end`` last, -1 if there is none."""
        return max(others, key=lambda other: self.round_of(end, other), default=-1)

    def _after(self, at: int, label: str) -> list[int]:
        return [target for one, target in self._labels[at] if one == label]


def refined(classes: Sequence[int], rows: Sequence[Row]) -> list[int] | None:
    """Return the classes that one more step tells apart, or None if there are no more than before.

    ``classes`` has the number of the class of each place, and ``rows`` its steps.
    """
    further = numbered(
        (classes[at], frozenset((what, classes[to]) for what, to in row))
        for at, row in enumerate(rows)
    )
    return None if max(further, default=0) == max(classes, default=0) else further


def numbered(values: Iterable[Hashable]) -> list[int]:
    """Return a number for each value; equal values have equal numbers, from 0 on."""
    known: dict[Hashable, int] = {}
    found = []
    for value in values:
        heed()
        found.append(known.setdefault(value, len(known)))
    return found
