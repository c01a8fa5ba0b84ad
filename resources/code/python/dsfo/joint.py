"""The joint step: everything that carrying out one edge does, action by action (clauses 5 and 6).

An action runs one function. An edge is *done* when its last part is done. It *commits* together
with the edges that must become true with it; until then it is pending.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from .elements import Edge, FactKey


@dataclass(frozen=True)
class Action:
    """One function and its effects.

    ``begins`` are the edges that start with it, bases first. ``moved`` has the new state of every
    SB that has moved when it is done. ``commits`` are the edges that commit then, ``committed`` the
    new states of their SBs. ``transit`` are the base digits in transit while it runs, ``after``
    those that still are afterwards.
    """

    edge: Edge
    begins: tuple[Edge, ...]
    moved: Mapping[str, str]
    commits: tuple[Edge, ...]
    committed: Mapping[str, str]
    transit: frozenset[FactKey]
    after: frozenset[FactKey]


@dataclass(frozen=True)
class JointStep:
    """What carrying out ``asked`` does. ``edges`` are in the order in which they start."""

    asked: Edge
    edges: tuple[Edge, ...]
    actions: tuple[Action, ...]
    cost: float
    after: Mapping[str, str]
    """The new state of every SB that has moved at the end."""

    @cached_property
    def leaves(self) -> Mapping[str, str]:
        """Each SB of its edges, with the state that the first of them leaves."""
        found: dict[str, str] = {}
        for edge in self.edges:
            found.setdefault(edge.branch, edge.source)
        return found

    def names(self, branch: str) -> tuple[str, ...]:
        """Return the names of the edges of one SB."""
        return tuple(edge.name for edge in self.edges if edge.branch == branch)


@dataclass(eq=False)
class Carried:
    """One edge of a step that is being written: from its first action to the one that ends it."""

    edge: Edge
    first: int
    transit: tuple[FactKey, ...]
    done: int = -1
    order: int = -1
    places: Mapping[str, str] = field(default_factory=dict)


class Draft:
    """A joint step while it is written. ``links`` are pairs that commit together."""

    def __init__(self, configuration: Mapping[str, str]) -> None:
        self.configuration = dict(configuration)
        self.carried: list[Carried] = []
        self.functions: list[Edge] = []
        self.links: list[tuple[Carried, Carried]] = []
        self._finished = 0

    def begin(self, edge: Edge, transit: Iterable[FactKey] = ()) -> Carried:
        """Let an edge start with the next function that runs."""
        carried = Carried(edge, len(self.functions), tuple(transit))
        self.carried.append(carried)
        return carried

    def run(self, edge: Edge) -> int:
        """Let the edge's own function run, and return the number of this action."""
        self.functions.append(edge)
        return len(self.functions) - 1

    def finish(self, carried: Carried, done: int, places: Mapping[str, str]) -> None:
        """Let the edge be true after action ``done``, with its SBs in ``places``."""
        carried.order, self._finished = self._finished, self._finished + 1
        carried.done, carried.places = done, places
        self.configuration.update(places)

    @property
    def cost(self) -> float:
        """The cost of all its edges."""
        return round(sum(one.edge.cost for one in self.carried), 9)

    def step(self) -> JointStep:
        """Return the finished step."""
        done = sorted(self.carried, key=lambda one: (one.done, one.order))
        commits = _commits(self.carried, done, self.links)
        actions = tuple(_actions(self.functions, self.carried, done, commits))
        after = {branch: state for one in done for branch, state in one.places.items()}
        edges = tuple(one.edge for one in self.carried)
        return JointStep(edges[0], edges, actions, self.cost, after)


def _commits(
    carried: list[Carried], done: list[Carried], links: list[tuple[Carried, Carried]]
) -> Mapping[int, int]:
    """Return after which action each edge commits, by its identity.

    A crossing commits with the edges of its bases. Edges that follow in one of their SBs while they
    are pending commit with them, too.
    """
    group = {id(one): [one] for one in carried}
    ends = {id(one): one.done for one in carried}

    def join(one: Carried, other: Carried) -> None:
        """Let two edges commit together, at the later of their two ends."""
        mine, theirs = group[id(one)], group[id(other)]
        if mine is theirs:
            return
        last = max(ends[id(one)], ends[id(other)])
        mine += theirs
        for each in mine:
            group[id(each)], ends[id(each)] = mine, last

    for crossing, base in links:
        join(crossing, base)
    latest: dict[str, Carried] = {}
    for one in done:
        for branch in one.places:
            former = latest.get(branch)
            if former is not None and ends[id(former)] > one.done:
                join(former, one)
            latest[branch] = one
    return ends


def _actions(
    functions: list[Edge], carried: list[Carried], done: list[Carried], commits: Mapping[int, int]
) -> Iterator[Action]:
    moving: Counter[FactKey] = Counter()
    for index, function in enumerate(functions):
        begun = [one for one in carried if one.first == index]
        ended = [one for one in done if one.done == index]
        committed = [one for one in done if commits[id(one)] == index]
        for one in begun:
            if commits[id(one)] >= index:
                moving.update(one.transit)
        transit = frozenset(+moving)
        for one in committed:
            if one.first <= index:
                moving.subtract(one.transit)
        yield Action(
            edge=function,
            begins=tuple(one.edge for one in begun),
            moved={branch: state for one in ended for branch, state in one.places.items()},
            commits=tuple(one.edge for one in committed),
            committed={branch: state for one in committed for branch, state in one.places.items()},
            transit=transit,
            after=frozenset(+moving),
        )
