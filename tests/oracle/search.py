"""The cheapest sequence of joint steps, found by brute force (clause 12)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from heapq import heappop, heappush
from itertools import count

from tests.oracle.standing import Configuration


@dataclass(frozen=True)
class Carriage:
    """One edge carried out with all that moves below it and all that goes along above it.

    ``starts`` are the edges in the order in which they begin, those that go along (``along``) right
    behind the crossing that takes them. ``begins`` are the edges whose functions run, in order.
    ``commits`` come before the edge itself is committed, ``group`` is what is committed together
    with it, ``tail`` what is committed after it. ``after`` is the configuration at the end.
    """

    edge: str
    starts: tuple[str, ...]
    along: tuple[str, ...]
    begins: tuple[str, ...]
    commits: tuple[frozenset[str], ...]
    group: frozenset[str]
    tail: tuple[frozenset[str], ...]
    after: Configuration
    cost: float

    @property
    def all_commits(self) -> tuple[frozenset[str], ...]:
        return (*self.commits, self.group, *self.tail)


def cheapest(
    here: Configuration,
    arrived: Callable[[Configuration], bool],
    steps: Callable[[Configuration], Iterator[Carriage]],
    routed: frozenset[str],
) -> tuple[Carriage, ...] | None:
    """The cheapest row of steps. Ties: the number of edges of the routed SBs, then the addresses
    of these, one by one."""
    number = count()
    queue: list[tuple[float, int, tuple[str, ...], int, Configuration, tuple[Carriage, ...]]] = []
    heappush(queue, (0.0, 0, (), next(number), here, ()))
    seen: set[tuple[str, ...]] = set()
    while queue:
        cost, length, names, _, at, way = heappop(queue)
        key = tuple(at.values())
        if key in seen:
            continue
        seen.add(key)
        if arrived(at):
            return way
        for step in steps(at):
            if tuple(step.after.values()) not in seen:
                own = tuple(edge for edge in step.starts if edge.split("/", 1)[0] in routed)
                further = round(cost + step.cost, 9)
                label = (further, length + len(own), (*names, *own), next(number))
                heappush(queue, (*label, step.after, (*way, step)))
    return None
