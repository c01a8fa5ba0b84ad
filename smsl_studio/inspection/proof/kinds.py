"""The kinds of properties: how each is answered from the explored configurations."""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

from smsl_studio.blueprint.properties.meaning import Meaning
from smsl_studio.inspection.proof.exploration import NOWHERE, Exploration
from smsl_studio.inspection.proof.shortest import WaySearch
from smsl_studio.inspection.proof.space import Key, Test
from smsl_studio.inspection.proof.verdict import FAILS, HOLDS, UNKNOWN, Counterexample
from smsl_studio.stop import heed


class Answer(NamedTuple):
    """A verdict without its name, and the run that shows it."""

    verdict: str
    run: Counterexample | None = None


def never(found: Exploration, meaning: Meaning, watched: int) -> Answer:
    """Answer ``never F``. ``watched`` is the number of F among the watched conditions.

    Of equally short runs one that ends in a committed configuration is shown.
    """
    test = found.space.test(meaning)
    node, met = found.first(meaning), found.met[watched]
    if met and (node == NOWHERE or found.depth(met[0][0]) + 1 < found.depth(node)):
        way = WaySearch(found)
        wanted = {before for before, _ in met}
        way.nearest(lambda one: one[0] in wanted)
        return Answer(FAILS, way.run_during(met, test))
    if node != NOWHERE and found.is_plain:
        return Answer(FAILS, found.way(node))
    if node != NOWHERE:
        way = WaySearch(found)
        hits = way.nearest(lambda one: test(found.keys[one[0]]))
        return Answer(FAILS, way.run(hits))
    return _no_hit(found)


def reachable(found: Exploration, meaning: Meaning) -> Answer:
    """Answer ``reachable F``."""
    if found.first(meaning) != NOWHERE:
        return Answer(HOLDS)
    if found.bound:
        return Answer(UNKNOWN)
    start = found.space.in_order(found.space.whole(found.keys[0]))
    return Answer(FAILS, Counterexample(start, (), start))


def before(found: Exploration, first: Test, second: Test) -> Answer:
    """Answer ``before [F, G]``: a way to G on which F never holds shows that it fails."""
    way = WaySearch(found, lambda key, _: not first(key))
    hits = way.nearest(lambda node: second(found.keys[node[0]]))
    return Answer(FAILS, way.run(hits)) if hits else _no_hit(found)


def after(found: Exploration, first: Test, second: Test, goal: Test) -> Answer:
    """Answer ``after [F, G]``: a way to a goal that has passed F and since then no G shows that it
    fails."""

    def armed(key: Key, was: int) -> int:
        """Return 1 if F has held, and since then no G, else 0."""
        return int(not second(key) and (bool(was) or first(key)))

    way = WaySearch(found, mark=armed)
    hits = way.nearest(lambda node: bool(node[1]) and goal(found.keys[node[0]]))
    return Answer(FAILS, way.run(hits)) if hits else _no_hit(found)


def way_back(found: Exploration, first: Test, second: Test, within: int | None) -> Answer:
    """Answer ``way_back``: from each configuration with F one with G can be reached."""
    far = steps_to(found, second)

    def lost(number: int) -> bool:
        """Return whether a configuration with F has no way that is short enough."""
        steps = far.get(number)
        return (steps is None or (within is not None and steps > within)) and first(
            found.keys[number]
        )

    if found.bound:
        return Answer(UNKNOWN)  # the way back may lead through what was not looked at
    way = WaySearch(found)
    if not any(map(lost, range(len(found)))):
        return Answer(HOLDS)
    return Answer(FAILS, way.run(way.nearest(lambda node: lost(node[0]))))


def _no_hit(found: Exploration) -> Answer:
    return Answer(UNKNOWN if found.bound else HOLDS)


def steps_to(found: Exploration, test: Test) -> dict[int, int]:
    """Return for each configuration the number of steps to one that meets a condition."""
    back: list[list[int]] = [[] for _ in range(len(found))]
    for node in range(found.expanded):
        for target in found.onward(node):
            back[target].append(node)
    far = {node: 0 for node, key in enumerate(found.keys) if test(key)}
    waiting = deque(far)
    while waiting:
        heed()
        node = waiting.popleft()
        for one in back[node]:
            if one not in far:
                far[one] = far[node] + 1
                waiting.append(one)
    return far
