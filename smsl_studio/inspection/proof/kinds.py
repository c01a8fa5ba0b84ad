"""The kinds of properties: how each is answered from the explored configurations."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from typing import NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.inspection.proof.exploration import NOWHERE, Exploration
from smsl_studio.inspection.proof.space import Key, Test
from smsl_studio.inspection.proof.verdict import FAILS, HOLDS, UNKNOWN, Counterexample
from smsl_studio.stop import heed


class Answer(NamedTuple):
    """A verdict without its name, and the run that shows it."""

    verdict: str
    run: Counterexample | None = None


def never(found: Exploration, test: Test, watched: int) -> Answer:
    """Answer ``never F``. ``watched`` is the number of F among the watched conditions.

    Of equally short runs one that ends in a committed configuration is shown.
    """
    node, met = found.first(test), found.met[watched]
    if met is not None and (node == NOWHERE or found.depth(met[0]) + 1 < found.depth(node)):
        before, label, passed = met
        path = (*found.path(before), found.name(label))
        return Answer(FAILS, _run(found, path, passed.key, passed.edge))
    if node != NOWHERE:
        return Answer(FAILS, _run(found, found.path(node), found.keys[node]))
    return _no_hit(found)


def reachable(found: Exploration, test: Test) -> Answer:
    """Answer ``reachable F``."""
    if found.first(test) != NOWHERE:
        return Answer(HOLDS)
    start = found.keys[0]
    return Answer(UNKNOWN) if found.bound else Answer(FAILS, _run(found, (), start))


def before(found: Exploration, first: Test, second: Test) -> Answer:
    """Answer ``before [F, G]``: a way to G on which F never holds shows that it fails."""
    way = _WaySearch(found, lambda key, _: not first(key))
    for node in way.nodes(0):
        if second(found.keys[node[0]]):
            return Answer(FAILS, _run(found, way.path(node), found.keys[node[0]]))
    return _no_hit(found)


def after(found: Exploration, first: Test, second: Test, goal: Test) -> Answer:
    """Answer ``after [F, G]``: a way to a goal that has passed F and since then no G shows that it
    fails."""

    def armed(key: Key, was: int) -> int:
        """Return 1 if F has held, and since then no G, else 0."""
        return int(not second(key) and (bool(was) or first(key)))

    way = _WaySearch(found, lambda key, was: True, armed)
    for node, state in way.nodes(armed(found.keys[0], 0)):
        if state and goal(found.keys[node]):
            return Answer(FAILS, _run(found, way.path((node, state)), found.keys[node]))
    return _no_hit(found)


def way_back(found: Exploration, first: Test, second: Test, within: int | None) -> Answer:
    """Answer ``way_back``: from each configuration with F one with G can be reached."""
    far = _steps_to(found, second)
    open_ones = False
    for node, key in enumerate(found.keys):
        if not first(key):
            continue
        steps = far.get(node)
        if steps is not None and (within is None or steps <= within):
            continue
        if found.bound:
            open_ones = True  # the way back may lead through what was not looked at
            continue
        return Answer(FAILS, _run(found, found.path(node), key))
    return Answer(UNKNOWN) if open_ones or found.bound else Answer(HOLDS)


def _no_hit(found: Exploration) -> Answer:
    return Answer(UNKNOWN if found.bound else HOLDS)


def _run(
    found: Exploration, path: tuple[Address, ...], end: Key, during: Address | None = None
) -> Counterexample:
    space = found.space
    start = space.configuration(found.keys[0])
    return Counterexample(start, path, space.configuration(end), during)


def _steps_to(found: Exploration, test: Test) -> dict[int, int]:
    """Return for each configuration the number of steps to one that meets a condition."""
    back: dict[int, list[int]] = {}
    for node in range(found.expanded):
        for target in found.onward(node):
            back.setdefault(target, []).append(node)
    far = {node: 0 for node, key in enumerate(found.keys) if test(key)}
    waiting = deque(far)
    while waiting:
        heed()
        node = waiting.popleft()
        for one in back.get(node, ()):
            if one not in far:
                far[one] = far[node] + 1
                waiting.append(one)
    return far


Node = tuple[int, int]
"""A configuration, and what is remembered of the way to it."""


_May = Callable[[Key, int], bool]
_Mark = Callable[[Key, int], int]


class _WaySearch:
    """A search through the explored configurations that remembers a little of its way.

    ``may`` says whether a configuration may be visited. ``mark`` gives what is remembered at a
    configuration, from what was remembered before it.
    """

    def __init__(self, found: Exploration, may: _May, mark: _Mark | None = None) -> None:
        self._found, self._may = found, may
        self._mark = mark or (lambda key, was: 0)
        self._origin: dict[Node, tuple[Node, int] | None] = {}

    def nodes(self, mark: int) -> Iterator[Node]:
        """Yield what can be visited from the start, the nearest first."""
        found = self._found
        start = (0, mark)
        if not self._may(found.keys[0], mark):
            return
        self._origin[start] = None
        waiting = deque([start])
        while waiting:
            heed()
            here = waiting.popleft()
            yield here
            for label, target in found.steps(here[0]):
                key = found.keys[target]
                there = target, self._mark(key, here[1])
                if there not in self._origin and self._may(key, there[1]):
                    self._origin[there] = here, label
                    waiting.append(there)

    def path(self, node: Node) -> tuple[Address, ...]:
        """Return the way to what was visited."""
        path = []
        origin = self._origin[node]
        while origin is not None:
            node, label = origin
            path.append(self._found.name(label))
            origin = self._origin[node]
        return tuple(reversed(path))
