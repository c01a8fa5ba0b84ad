"""Sets of configurations as shared trees: multi-valued decision diagrams.

A node of level k has a child for each state of the SB at this level. Level 0 is the lowest. Node 0
is the empty set, node 1 the end of a configuration. Equal sets are the same node.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import islice

from smsl_studio.graph.joint.products import JointBox, JointMoves, TooLarge
from smsl_studio.stop import heed

MOST_NODES = 100_000
"""The largest number of nodes of one diagram."""

MOST_FOR_QUESTION = 1_000_000
"""The same for a question about what is kept, such as the layers of a shortest run."""

MOST_CELLS = 10_000_000
"""The largest number of children of all nodes together, about 0.2 GB."""

MOST_WORK = 5_000_000
"""The largest number of looks at nodes for what is kept, some seconds. A question may take four
times as many."""

SHELVES = 64
"""The number of tables in which answers about pairs are kept. One table of a million pairs would
take a tenth of a second whenever it grows or is freed, and all threads would wait for it."""
PORTION = 10_000
"""The number of nodes that are forgotten in one step."""

Shelves = tuple[dict[tuple[int, int], int], ...]
"""Answers about pairs of nodes. A pair is in the table of the number that the sum of both
leaves when it is divided by ``SHELVES``."""

Rows = list[tuple[int, int]]
"""Pairs (from, to) of states of one level."""


def shelves() -> Shelves:
    """Return empty tables for answers about pairs."""
    return tuple({} for _ in range(SHELVES))


def clear(tables: Iterable[dict[tuple[int, int], int]]) -> None:
    """Empty the tables one after the other, so that other threads get a turn in between."""
    for table in tables:
        table.clear()


class Relation:
    """A product by levels: its pairs at each level (None: stands still), its lowest and highest."""

    def __init__(self, moves: JointMoves, levels: Sequence[int], back: bool = False) -> None:
        self.rows: list[Rows | None] = [None] * len(levels)
        for one, pairs in moves.items():
            heed()
            found = sorted((b, a) for a, b in pairs) if back else sorted(pairs)
            self.rows[levels[one]] = found
        places = [levels[one] for one in moves]
        self.bottom, self.top = min(places), max(places)


class Diagram:
    """Makes nodes for SBs with ``sizes`` states; ``levels`` has the level of each SB.

    ``most`` is the largest number of nodes. Work is counted and never timed, so the same question
    meets the same bound everywhere. TooLarge if a bound is met.
    """

    def __init__(self, sizes: Sequence[int], levels: Sequence[int], most: int = MOST_NODES) -> None:
        self.levels, self._most = levels, most
        self._cells, self._work, self._kept = 0, 0, 2
        self._most_work = MOST_WORK
        self.height = len(sizes)
        self.sizes = [0] * self.height
        for one, level in enumerate(levels):
            self.sizes[level] = sizes[one]
        self.children: list[tuple[int, ...]] = [(), ()]
        self._known: list[dict[tuple[int, ...], int]] = [{} for _ in sizes]
        self._unions, self._cuts = shelves(), shelves()
        self._counts: dict[int, int] = {0: 0, 1: 1}

    def node(self, level: int, children: tuple[int, ...]) -> int:
        """Return the node with these children."""
        if not any(children):
            return 0
        known = self._known[level]
        found = known.get(children)
        if found is None:
            self._cells += len(children)
            if len(self.children) > self._most or self._cells > MOST_CELLS:
                raise TooLarge(f"{self._most:,} nodes of a diagram")
            found = known[children] = len(self.children)
            self.children.append(children)
        return found

    def spend(self) -> None:
        """Count a look at a node, and heed the listener (see ``stop``)."""
        self._work += 1
        if self._work > self._most_work:
            raise TooLarge(f"{self._most_work:,} looks at the nodes of a diagram")
        heed()

    def allow(self, work: int = 4 * MOST_WORK) -> None:
        """Raise TooLarge after ``work`` further looks at nodes."""
        self._most_work = self._work + work

    def keep(self) -> None:
        """Keep the nodes that there are. Those that come later are forgotten by ``renew``."""
        self._kept = len(self.children)
        self._most = MOST_FOR_QUESTION
        self.renew()

    def renew(self) -> None:
        """Forget all nodes but those that are kept, and count the work anew for a new question."""
        kept = self._kept
        for gone in self.children[kept:]:
            self._cells -= len(gone)
        self._cut_off(kept)
        for level, known in enumerate(self._known):
            late = [children for children, node in known.items() if node >= kept]
            for children in late:
                del self._known[level][children]
        self._counts = {node: count for node, count in self._counts.items() if node < kept}
        clear(self._unions)
        clear(self._cuts)
        self._work = 0
        self.allow()

    def _cut_off(self, kept: int) -> None:
        """Forget the children of the nodes after the first ``kept``."""
        while len(self.children) > kept:
            del self.children[max(kept, len(self.children) - PORTION) :]

    def __del__(self) -> None:
        """Free the large tables in small steps."""
        clear((*self._unions, *self._cuts))
        for known in self._known:
            known.clear()
        self._cut_off(0)

    def box(self, values: Mapping[int, Collection[int]]) -> int:
        """Return the configurations with these states of some SBs, and any states of the others."""
        by_level = {self.levels[one]: states for one, states in values.items()}
        found = 1
        for level in range(self.height):
            states = by_level.get(level)
            found = self.node(
                level,
                tuple(
                    found if states is None or state in states else 0
                    for state in range(self.sizes[level])
                ),
            )
        return found

    def point(self, configuration: Sequence[int]) -> int:
        """Return the set of one configuration."""
        return self.box({one: (state,) for one, state in enumerate(configuration)})

    def has(self, found: int, configuration: Sequence[int]) -> bool:
        """Return whether a configuration is in a set."""
        by_level = [0] * self.height
        for one, state in enumerate(configuration):
            by_level[self.levels[one]] = state
        for level in reversed(range(self.height)):
            if not found:
                return False
            found = self.children[found][by_level[level]]
        return found == 1

    def union(self, one: int, other: int, level: int) -> int:
        """Return what is in one of two sets of a level."""
        if one == other or not other:
            return one
        if not one:
            return other
        key = (one, other) if one < other else (other, one)
        known = self._unions[(one + other) % SHELVES]
        found = known.get(key)
        if found is None:
            self.spend()
            union, below = self.union, level - 1
            found = known[key] = self.node(
                level,
                tuple(
                    [
                        a if a == b or not b else (b if not a else union(a, b, below))
                        for a, b in zip(self.children[one], self.children[other], strict=True)
                    ]
                ),
            )
        return found

    def without(self, one: int, other: int, level: int) -> int:
        """Return what is in the first set and not in the second."""
        if one == other or not one:
            return 0
        if not other:
            return one
        key = (one, ~other)
        known = self._cuts[(one + other) % SHELVES]
        found = known.get(key)
        if found is None:
            self.spend()
            found = known[key] = self.node(
                level,
                tuple(
                    [
                        a if not b else self.without(a, b, level - 1)
                        for a, b in zip(self.children[one], self.children[other], strict=True)
                    ]
                ),
            )
        return found

    def both(self, one: int, other: int, level: int) -> int:
        """Return what is in both of two sets."""
        if one == other:
            return one
        if not one or not other:
            return 0
        key = (one, other) if one < other else (other, one)
        known = self._cuts[(one + other) % SHELVES]
        found = known.get(key)
        if found is None:
            self.spend()
            found = known[key] = self.node(
                level,
                tuple(
                    [
                        self.both(a, b, level - 1) if a and b else 0
                        for a, b in zip(self.children[one], self.children[other], strict=True)
                    ]
                ),
            )
        return found

    def boxes(self, found: int, most: int) -> list[JointBox]:
        """Return boxes whose union is ``found``. TooLarge if more than ``most`` are needed."""
        one_of = [0] * self.height
        for one, level in enumerate(self.levels):
            one_of[level] = one
        boxes: list[JointBox] = []

        def below(node: int, level: int, box: JointBox) -> None:
            """Add the boxes of a node. ``box`` has the states of the SBs above this level."""
            self.spend()
            if level < 0:
                boxes.append(box)
                if len(boxes) > most:
                    raise TooLarge(f"{most:,} parts of a condition")
                return
            ways: dict[int, set[int]] = {}
            for state, child in enumerate(self.children[node]):
                if child:
                    ways.setdefault(child, set()).add(state)
            for child, states in ways.items():
                free = len(states) == self.sizes[level]
                more = box if free else {**box, one_of[level]: frozenset(states)}
                below(child, level - 1, more)

        if found:
            below(found, self.height - 1, {})
        return boxes

    def members(self, found: int, most: int) -> Iterator[tuple[int, ...]]:
        """Yield at most ``most`` configurations of a set. Equal sets give the same order."""
        one_of = {level: one for one, level in enumerate(self.levels)}
        states = [0] * self.height

        def below(node: int, level: int) -> Iterator[tuple[int, ...]]:
            """Yield the configurations of a node, without the SBs above its level."""
            if level < 0:
                yield tuple(states)
                return
            for state, child in enumerate(self.children[node]):
                if child:
                    states[one_of[level]] = state
                    yield from below(child, level - 1)

        return islice(below(found, self.height - 1) if found else (), most)

    def count(self, found: int) -> int:
        """Return the number of configurations in a set."""
        number = self._counts.get(found)
        if number is None:
            self.spend()
            number = self._counts[found] = sum(map(self.count, self.children[found]))
        return number

    def image(self, found: int, relation: Relation) -> int:
        """Return where one step of a relation leads from a set of configurations."""
        return self._image(found, relation, self.height - 1, {}) if found else 0

    def _image(self, found: int, relation: Relation, level: int, seen: dict[int, int]) -> int:
        kept = seen.get(found)
        if kept is not None:
            return kept
        self.spend()
        rows, last, below = relation.rows[level], relation.bottom >= level, level - 1
        children = self.children[found]
        if rows is None:
            further = [self._image(one, relation, below, seen) if one else 0 for one in children]
        else:
            further = [0] * len(children)
            for state, target in rows:
                one = children[state]
                if one:
                    one = one if last else self._image(one, relation, below, seen)
                    further[target] = self.union(further[target], one, below)
        kept = seen[found] = self.node(level, tuple(further))
        return kept
