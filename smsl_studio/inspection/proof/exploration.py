"""Explores all configurations that can be reached, breadth first, and keeps the shortest ways.

Of equally short ways the one with the least addresses counts, compared step by step. So the answer
is the same on every machine.
"""

from __future__ import annotations

from array import array
from collections.abc import Iterator, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import PlanningError
from smsl_studio.inspection.proof.space import Key, Passed, Space, Test
from smsl_studio.stop import heed

NOWHERE = -1


class Exploration:
    """The configurations that can be reached, numbered in the order of their discovery.

    ``bound`` says in words why some are missing; it is empty if there are all. ``watched`` are
    conditions for which the first passed configuration that meets each is kept.
    """

    def __init__(self, space: Space, limit: int, watched: Sequence[Test] = ()) -> None:
        self.space = space
        self.keys: list[Key] = []
        self.bound = ""
        self._number: dict[Key, int] = {}
        self._origin, self._label = array("q"), array("q")
        self._targets, self._labels = array("q"), array("q")
        self._first = array("q", [0])
        self._names: list[Address] = []
        self._known: dict[Address, int] = {}
        self._depth = array("q")
        self._watched = list(watched)
        self.met: list[tuple[int, int, Passed] | None] = [None] * len(self._watched)
        """For each watched condition: the configuration before the step, the number of the step's
        operation, and what it passes."""
        self._explore(limit)

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
        """Yield the number of the operation and of the target of each step."""
        if node < self.expanded:
            for at in range(self._first[node], self._first[node + 1]):
                yield self._labels[at], self._targets[at]

    def name(self, label: int) -> Address:
        """Return the operation with a number."""
        return self._names[label]

    def depth(self, node: int) -> int:
        """Return the number of steps from the start."""
        return self._depth[node]

    def origin(self, node: int) -> tuple[int, Address] | None:
        """Return the configuration before one on the shortest way, and the operation between
        them. None at the start."""
        before = self._origin[node]
        return None if before == NOWHERE else (before, self._names[self._label[node]])

    def path(self, node: int) -> tuple[Address, ...]:
        """Return the shortest way from the start."""
        found = []
        while self._origin[node] != NOWHERE:
            found.append(self._names[self._label[node]])
            node = self._origin[node]
        return tuple(reversed(found))

    def first(self, test: Test) -> int:
        """Return the first configuration that meets a condition, ``NOWHERE`` if none does."""
        return next((node for node, key in enumerate(self.keys) if test(key)), NOWHERE)

    def _explore(self, limit: int) -> None:
        self._add(self.space.start(), NOWHERE, NOWHERE)
        node = 0
        while node < len(self.keys):
            heed()
            try:
                steps = self.space.steps(self.keys[node])
            except PlanningError as error:
                self.bound = error.sentence
                return
            for step in steps:
                label = self._label_of(step.address)
                for at, test in enumerate(self._watched):
                    if self.met[at] is None:
                        hit = next((one for one in step.passed if test(one.key)), None)
                        if hit is not None:
                            self.met[at] = node, label, hit
                target = self._number.get(step.to, NOWHERE)
                if target == NOWHERE:
                    if len(self.keys) >= limit:
                        self.bound = f"{limit:,} configurations"
                        return
                    target = self._add(step.to, node, label)
                self._targets.append(target)
                self._labels.append(label)
            self._first.append(len(self._targets))
            node += 1

    def _add(self, key: Key, origin: int, label: int) -> int:
        number = self._number[key] = len(self.keys)
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
