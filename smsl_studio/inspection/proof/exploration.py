"""Explores all configurations that can be reached, breadth first."""

from __future__ import annotations

from array import array
from collections.abc import Callable, Iterator, Sequence
from functools import reduce
from itertools import pairwise
from operator import and_, or_

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.properties.meaning import Meaning, States
from smsl_studio.errors import PlanningError
from smsl_studio.inspection.proof.space import Key, Space, Test
from smsl_studio.inspection.proof.verdict import Counterexample
from smsl_studio.inspection.proof.way import way_to
from smsl_studio.stop import BoundMet, heed

Tell = Callable[[int], object]
"""Hears how many configurations were found so far. It is called in the thread of the work."""


def nobody(count: int) -> None:
    """Hear nothing."""


NOWHERE = -1
MOST_STEPS = 6_000_000
"""The largest number of steps that are stored."""
KEPT_BACK = 500_000
"""Up to so many steps are kept in the other direction, too."""
MOST_BITS = 400_000_000
"""The largest number of bits (50 MB) to remember which configurations meet a condition."""


class Exploration:
    """The configurations that can be reached, numbered in the order of their discovery.

    ``bound`` says in words why some are missing; it is empty if there are all. ``starts`` are
    those that the search begins with, the start of a run if none are given. ``watched`` are
    conditions for which the first passed configurations that meet each are kept. ``tell`` gets the
    number of configurations that were found so far, again and again.
    """

    def __init__(
        self,
        space: Space,
        limit: int,
        watched: Sequence[Test] = (),
        starts: Sequence[Key] = (),
        tell: Tell = nobody,
    ) -> None:
        self.space = space
        self._tell = tell
        self.keys: list[Key] = []
        self.bound = ""
        self._limit, self._limit_words = space.storable(limit)
        self._number: dict[Key, int] = {}
        self._origin, self._label = array("q"), array("q")
        self._targets, self._labels = array("q"), array("q")
        self._first = array("q", [0])
        self._names: list[Address] = []
        self._known: dict[Address, int] = {}
        self._depth = array("q")
        self._watched = list(watched)
        self._kept: dict[States, int] = {}
        self._columns: dict[int, tuple[dict[str, int], list[int]]] = {}
        self._backward: list[list[int]] | None = None
        self.met: list[list[tuple[int, int]]] = [[] for _ in self._watched]
        """For each watched condition: the configurations out of which a step passes one that meets
        it, and the operation of that step. Only the nearest ones are kept."""
        for start in starts or (space.start(),):
            self._seen(start, NOWHERE, NOWHERE)
        self.starts = range(len(self.keys))
        self._explore()

    def __len__(self) -> int:
        return len(self.keys)

    @property
    def expanded(self) -> int:
        """The number of configurations whose steps are known."""
        return len(self._first) - 1

    def onward(self, node: int) -> Iterator[int]:
        """Yield the configurations that the steps of one lead to."""
        if node < self.expanded:
            yield from self._targets[self._first[node] : self._first[node + 1]]

    def steps(self, node: int) -> Iterator[tuple[int, int]]:
        """Yield the number of the operation and of the target of each step, by address."""
        if node < self.expanded:
            for at in range(self._first[node], self._first[node + 1]):
                yield self._labels[at], self._targets[at]

    def name(self, label: int) -> Address:
        """Return the operation with a number."""
        return self._names[label]

    def number(self, key: Key) -> int:
        """Return the number of a configuration, ``NOWHERE`` if it was not reached."""
        return self._number.get(key, NOWHERE)

    def origin(self, node: int) -> tuple[int, Address] | None:
        """Return the configuration before one on the shortest way, and the operation between
        them. None at the start."""
        before = self._origin[node]
        return None if before == NOWHERE else (before, self.name(self._label[node]))

    @property
    def is_plain(self) -> bool:
        """Whether ``origin`` leads to the first of the shortest runs by its addresses.

        This is so if there is one start and no step of the SBs is left out.
        """
        return len(self.starts) == 1 and not self.space.cone.quiet

    def way(self, node: int) -> Counterexample:
        """Return the run to a node, found by following ``origin`` back."""
        start, path = way_to(node, self.origin)
        return self.run(start, path, node)

    def along(self, nodes: Sequence[int]) -> Counterexample:
        """Return the run through these nodes. Of several steps between two it takes the first."""
        path = []
        for here, there in pairwise(nodes):
            heed()
            path.append(self.name(next(one for one, to in self.steps(here) if to == there)))
        return self.run(nodes[0], path, nodes[-1])

    def run(self, start: int, path: Sequence[Address], end: int) -> Counterexample:
        """Return a run from one configuration to another, with all SBs, also those that do not
        move.
        """
        space = self.space
        first, last = (space.in_order(space.whole(self.keys[one])) for one in (start, end))
        return Counterexample(first, tuple(path), last)

    def depth(self, node: int) -> int:
        """Return the number of steps from the nearest start."""
        return self._depth[node]

    def first(self, meaning: Meaning) -> int:
        """Return the first configuration that meets a condition, ``NOWHERE`` if none does."""
        found = self._meeting(meaning)
        return (found & -found).bit_length() - 1

    def meeting(self, meaning: Meaning) -> str:
        """Return for each configuration "1" if it meets a condition, else "0"."""
        return format(self._meeting(meaning), f"0{len(self.keys)}b")[::-1]

    def backward(self) -> list[list[int]]:
        """Return for each configuration those whose steps lead to it."""
        if self._backward is not None:
            return self._backward
        back: list[list[int]] = [[] for _ in self.keys]
        targets, first = self._targets, self._first
        for node in range(self.expanded):
            for target in targets[first[node] : first[node + 1]]:
                back[target].append(node)
        if len(targets) <= KEPT_BACK:
            self._backward = back
        return back

    def _meeting(self, meaning: Meaning) -> int:
        """Return which configurations meet a condition: bit n of the number is for configuration n.

        A file may have thousands of conditions about the same facts. So the numbers for conditions
        about one SB are kept, as long as there is memory for them (``MOST_BITS``).
        """
        heed()
        if not isinstance(meaning, States):
            parts = map(self._meeting, meaning.parts)
            everywhere = (1 << len(self.keys)) - 1
            return reduce(and_, parts, everywhere) if meaning.every else reduce(or_, parts, 0)
        found = self._kept.get(meaning)
        if found is None:
            if len(self._kept) * len(self.keys) > MOST_BITS:
                self._kept.clear()
            found = self._kept[meaning] = int("".join(self._bits(meaning)), 2)
        return found

    def _bits(self, meaning: States) -> Iterator[str]:
        """Yield for each configuration, the last first, "1" if it is in one of some states."""
        at = self.space.place(meaning.branch)
        if at not in self._columns:
            names = self.space.blueprint[meaning.branch].table
            index = {name: number for number, name in enumerate(names)}
            self._columns[at] = index, [index[key[at]] for key in reversed(self.keys)]
        index, column = self._columns[at]
        marks = ["0"] * len(index)
        for state in meaning.states:
            if state in index:
                marks[index[state]] = "1"
        return map(marks.__getitem__, column)

    def _explore(self) -> None:
        node = 0
        while node < len(self.keys) and not self.bound:
            try:
                heed()
                self._tell(len(self.keys))
                steps = self.space.steps(self.keys[node])
            except PlanningError as error:
                self.bound = error.sentence
                return
            except BoundMet as error:
                self.bound = str(error)
                return
            depth = self._depth[node]
            for step in steps:
                label = self._label_of(step.address)
                for at, test in enumerate(self._watched if step.passed else ()):
                    heed()
                    met = self.met[at]
                    if (not met or self._depth[met[0][0]] == depth) and any(
                        test(one.key) for one in step.passed
                    ):
                        met.append((node, label))
                target = self._seen(step.to, node, label)
                if target == NOWHERE:
                    # Close the row of this node, so that a walk can still go through all stored
                    # nodes.
                    self._first.append(len(self._targets))
                    return
                self._targets.append(target)
                self._labels.append(label)
            self._first.append(len(self._targets))
            node += 1
            if len(self._targets) > MOST_STEPS:
                count = f"{len(self.keys):,} configurations"
                self.bound = f"{count} with {MOST_STEPS:,} steps, which would fill the memory"

    def _seen(self, key: Key, origin: int, label: int) -> int:
        """Return the number of a configuration, ``NOWHERE`` if it is one too many."""
        number = self._number.get(key)
        return self._add(key, origin, label) if number is None else number

    def _add(self, key: Key, origin: int, label: int) -> int:
        """Give a configuration that is new a number, ``NOWHERE`` if it is one too many."""
        number = len(self.keys)
        if number >= self._limit:
            self.bound = self._limit_words
            return NOWHERE
        self._number[key] = number
        self.keys.append(key)
        self._origin.append(origin)
        self._label.append(label)
        self._depth.append(0 if origin == NOWHERE else self._depth[origin] + 1)
        return number

    def _label_of(self, address: Address) -> int:
        found = self._known.get(address)
        if found is None:
            found = self._known[address] = len(self._names)
            self._names.append(address)
        return found
