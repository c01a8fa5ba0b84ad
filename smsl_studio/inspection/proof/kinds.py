"""The kinds of properties: how each is answered from the explored configurations."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
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


def before(found: Exploration, first: Meaning, second: Meaning) -> Answer:
    """Answer ``before [F, G]``: a way to G on which F never holds shows that it fails."""
    held = found.meeting(first)
    way = way_around(found, found.starts, held, found.meeting(second))
    if not way:
        return _no_hit(found)
    if found.is_plain:
        return Answer(FAILS, found.along(way))
    holds, reached = found.space.test(first), found.space.test(second)
    search = WaySearch(found, lambda key, _: not holds(key))
    return Answer(FAILS, search.run(search.nearest(lambda node: reached(found.keys[node[0]]))))


def after(found: Exploration, first: Meaning, second: Meaning, goal: Test) -> Answer:
    """Answer ``after [F, G]``: a way to a goal that has passed F and since then no G shows that it
    fails."""
    begins, ends = found.meeting(first), found.meeting(second)
    goals = "".join("1" if goal(key) else "0" for key in found.keys)
    arms = (at for at, mark in enumerate(begins) if mark == "1")
    if not way_around(found, arms, ends, goals):
        return _no_hit(found)
    holds, left = found.space.test(first), found.space.test(second)

    def armed(key: Key, was: int) -> int:
        """Return 1 if F has held, and since then no G, else 0."""
        return int(not left(key) and (bool(was) or holds(key)))

    search = WaySearch(found, mark=armed)
    hits = search.nearest(lambda node: bool(node[1]) and goal(found.keys[node[0]]))
    return Answer(FAILS, search.run(hits))


def way_back(found: Exploration, first: Meaning, second: Meaning, within: int | None) -> Answer:
    """Answer ``way_back``: from each configuration with F one with G can be reached."""
    far = steps_to(found, second)
    if found.bound:
        return Answer(UNKNOWN)  # the way back may lead through what was not looked at
    lost = {
        number
        for number, mark in enumerate(found.meeting(first))
        if mark == "1" and (number not in far or (within is not None and far[number] > within))
    }
    if not lost:
        return Answer(HOLDS)
    if found.is_plain:
        return Answer(FAILS, found.way(min(lost)))
    way = WaySearch(found)
    return Answer(FAILS, way.run(way.nearest(lambda node: node[0] in lost)))


def _no_hit(found: Exploration) -> Answer:
    return Answer(UNKNOWN if found.bound else HOLDS)


def steps_to(found: Exploration, meaning: Meaning) -> dict[int, int]:
    """Return for each configuration the number of steps to one that meets a condition."""
    back = found.backward()
    far = {node: 0 for node, mark in enumerate(found.meeting(meaning)) if mark == "1"}
    waiting = deque(far)
    while waiting:
        heed()
        node = waiting.popleft()
        for one in back[node]:
            if one not in far:
                far[one] = far[node] + 1
                waiting.append(one)
    return far


def way_around(found: Exploration, starts: Iterable[int], shut: str, wanted: str) -> list[int]:
    """Return the first of the shortest ways from one of some configurations to a wanted one.

    No configuration on it is shut. Without such a way the list is empty. ``shut`` and ``wanted``
    have "1" for each such configuration.
    """
    origin = {node: node for node in starts if shut[node] == "0"}
    waiting = list(origin)
    for node in waiting:
        heed()
        if wanted[node] == "1":
            way = [node]
            while origin[way[-1]] != way[-1]:
                way.append(origin[way[-1]])
            return way[::-1]
        for target in found.onward(node):
            if target not in origin and shut[target] == "0":
                origin[target] = node
                waiting.append(target)
    return []
