"""The shortest run to some configurations: of all with the fewest steps, the one whose addresses
come first, compared step by step.

The answer is the same on every machine, and whatever was left out of the search: operations of
quiet SBs count too.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from itertools import pairwise
from typing import NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import PlanningError
from smsl_studio.inspection.proof.exploration import NOWHERE, Exploration
from smsl_studio.inspection.proof.space import Key, Test
from smsl_studio.inspection.proof.verdict import Counterexample
from smsl_studio.stop import heed

Node = tuple[int, int]
"""The number of a configuration, and what is remembered of the way to it."""

May = Callable[[Key, int], bool]
Mark = Callable[[Key, int], int]


class _Walker(NamedTuple):
    """Where a walk began, where it is, and the node of that."""

    start: Mapping[str, str]
    here: Mapping[str, str]
    node: Node


class WaySearch:
    """A search through the explored configurations that remembers a little of its way.

    ``may`` says whether a configuration may be visited. ``mark`` gives what is remembered at a
    configuration, from what was remembered before it (0 before a start).
    """

    def __init__(
        self, found: Exploration, may: May | None = None, mark: Mark | None = None
    ) -> None:
        self._found = found
        self._may = may or (lambda key, was: True)
        self._mark = mark or (lambda key, was: 0)
        self._layers: list[dict[Node, Node]] = []
        """The nodes of each layer, sorted by the addresses of the runs to them. Each node has the
        node before it on its run. A start has itself."""

    def layers(self) -> Iterator[Collection[Node]]:
        """Yield the nodes that can be visited, those with the fewest steps first."""
        starts = (self._visit(number, 0) for number in self._found.starts)
        layer = {node: node for node in starts if node is not None}
        seen = set(layer)
        while layer:
            self._layers.append(layer)
            yield layer
            further: dict[Node, Node] = {}
            for here in layer:
                heed()
                for target in self._found.onward(here[0]):
                    there = self._visit(target, here[1])
                    if there is not None and there not in seen:
                        seen.add(there)
                        further[there] = here
            layer = further

    def nearest(self, hit: Callable[[Node], bool]) -> set[Node]:
        """Return the nearest nodes that are hit. None are hit if the search comes to its end."""
        for layer in self.layers():
            hits = {node for node in layer if hit(node)}
            if hits:
                return hits
        return set()

    def run(self, hits: Collection[Node]) -> Counterexample:
        """Return the shortest run to one of the nodes, which are in the last layer visited."""
        if self._found.is_plain:
            return self._first_found(hits)
        path, walkers = self._walk(set(hits))
        space, one = self._found.space, walkers[0]
        return Counterexample(space.in_order(one.start), tuple(path), space.in_order(one.here))

    def run_during(self, met: Collection[tuple[int, int]], test: Test) -> Counterexample:
        """Return the shortest run in the last step of which something passed meets a condition.

        ``met`` are configurations of the last layer visited, with the operations of such steps.
        """
        found, space = self._found, self._found.space
        path, walkers = self._walk({(node, 0) for node, _ in met})
        labels: dict[int, list[Address]] = {}
        for node, label in met:
            labels.setdefault(node, []).append(found.name(label))
        walker, last = min(
            ((walker, one) for walker in walkers for one in labels.get(walker.node[0], ())),
            key=lambda pair: str(pair[1]),
        )
        step = space.joint_step(walker.here, last)
        assert step is not None
        here = dict(walker.here)
        for action, following in zip(step.actions, step.actions[1:], strict=False):
            here.update(action.moved)
            if test(space.key(here)):
                during = following.edge.address
                break
        start = space.in_order(walker.start)
        return Counterexample(start, (*path, last), space.in_order(here), during)

    def _visit(self, number: int, was: int) -> Node | None:
        key = self._found.keys[number]
        mark = self._mark(key, was)
        return (number, mark) if self._may(key, mark) else None

    def _first_found(self, hits: Collection[Node]) -> Counterexample:
        """Return the run to the first of the nodes.

        The search leaves nothing out, so every layer is sorted by the addresses of the runs to its
        nodes.
        """
        found, wanted = self._found, set(hits)
        nodes = [next(node for node in self._layers[-1] if node in wanted)]
        for layer in reversed(self._layers[1:]):
            nodes.append(layer[nodes[-1]])
        nodes.reverse()
        path = []
        for here, there in pairwise(nodes):
            heed()
            steps = found.steps(here[0])
            label = next(one for one, to in steps if self._visit(to, here[1]) == there)
            path.append(found.name(label))
        return found.run(nodes[0][0], path, nodes[-1][0])

    def _walk(self, hits: set[Node]) -> tuple[list[Address], list[_Walker]]:
        """Return the path to the nodes, and all configurations in which it may end."""
        found = self._found
        ways = [hits]
        for layer in reversed(self._layers[:-1]):
            heed()
            ways.append({node for node in layer if self._onward(node, ways[-1])})
        ways.reverse()
        walkers = []
        for number in found.starts:
            node = self._visit(number, 0)
            if node is not None and node in ways[0]:
                start = found.space.whole(found.keys[number])
                walkers.append(_Walker(start, start, node))
        path = []
        for goals in ways[1:]:
            walkers, address = self._stride(walkers, goals)
            path.append(address)
        return path, walkers

    def _onward(self, node: Node, goals: Collection[Node]) -> bool:
        onward = self._found.onward(node[0])
        return any(self._visit(target, node[1]) in goals for target in onward)

    def _stride(
        self, walkers: list[_Walker], goals: Collection[Node]
    ) -> tuple[list[_Walker], Address]:
        """Let all walkers take the first step by its address that leads to one of the goals."""
        found = self._found
        best: list[tuple[_Walker, Address]] = []
        for walker in walkers:
            heed()
            number, mark = walker.node
            for label, target in found.steps(number):
                if self._visit(target, mark) in goals:
                    best = _least(best, walker, found.name(label))
                    break
        for walker in walkers:
            for edge in found.space.crossings(walker.here):
                if str(edge) <= str(best[0][1]) and self._leads(walker, edge.address, goals):
                    best = _least(best, walker, edge.address)
        further = [self._gone(walker, address) for walker, address in best]
        return [one for one in further if one is not None], best[0][1]

    def _leads(self, walker: _Walker, address: Address, goals: Collection[Node]) -> bool:
        try:
            gone = self._gone(walker, address)
        except PlanningError:
            return False
        return gone is not None and gone.node in goals

    def _gone(self, walker: _Walker, address: Address) -> _Walker | None:
        """Return a walker after a step, None if it cannot take it."""
        found = self._found
        step = found.space.joint_step(walker.here, address)
        if step is None:
            return None
        here = {**walker.here, **step.after}
        number = found.number(found.space.key(here))
        node = None if number == NOWHERE else self._visit(number, walker.node[1])
        return None if node is None else _Walker(walker.start, here, node)


def _least(
    best: list[tuple[_Walker, Address]], walker: _Walker, address: Address
) -> list[tuple[_Walker, Address]]:
    """Return the walkers with the least address, one more tried."""
    if not best or str(address) < str(best[0][1]):
        return [(walker, address)]
    return [*best, (walker, address)] if address == best[0][1] else best
