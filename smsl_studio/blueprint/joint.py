"""The joint step: everything that carrying out one edge does, and the edges that commit together.

A joint step is a sequence of actions. Each action runs one library function. An edge is *done* when
its last part is done. It *commits* together with the edges that must become true with it (clause
6).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.edges import Edge


@dataclass(frozen=True)
class JointAction:
    """One library function and its effects.

    ``begins`` are the edges that start with it, bases first. ``moved`` has the new state of every
    SB that has moved when it is done, committed or not. ``done`` are the edges that are true then,
    sub-SBs first. ``commits`` are those that commit, and ``committed`` has the new states of their
    SBs. ``transit`` are the base digits in transit while it runs, and ``after`` those that are
    still in transit afterwards.
    """

    edge: Edge
    begins: tuple[Edge, ...]
    moved: Mapping[str, str]
    done: tuple[Edge, ...]
    commits: tuple[Edge, ...]
    committed: Mapping[str, str]
    transit: frozenset[FactKey]
    after: frozenset[FactKey]
    targets: tuple[tuple[str, str], ...] = field(init=False, repr=False, compare=False)
    """The state in which each moved or committed SB must be afterwards."""
    texts: tuple[str, ...] = field(init=False, repr=False, compare=False)
    """The addresses of the edges that commit."""

    def __post_init__(self) -> None:
        targets = tuple({**self.moved, **self.committed}.items())
        object.__setattr__(self, "targets", targets)
        object.__setattr__(self, "texts", tuple([edge.text for edge in self.commits]))


@dataclass(frozen=True)
class JointStep:
    """The effects of carrying out ``asked``. ``edges`` are in the order in which they start."""

    asked: Edge
    edges: tuple[Edge, ...]
    actions: tuple[JointAction, ...]
    cost: float
    after: Mapping[str, str]
    """The new state of every SB that has moved at the end."""
    leaves: tuple[tuple[str, str], ...] = field(init=False, repr=False, compare=False)
    """Each SB of its edges, with the state that the first of them leaves."""

    def __post_init__(self) -> None:
        leaves: dict[str, str] = {}
        for edge in self.edges:
            leaves.setdefault(edge.branch, edge.source)
        object.__setattr__(self, "leaves", tuple(leaves.items()))

    def names(self, branch: str) -> tuple[str, ...]:
        """Return the names of the edges of one SB in this step."""
        return tuple(edge.name for edge in self.edges if edge.branch == branch)


@dataclass(eq=False)
class Carried:
    """One edge of a joint step that is being written, with its first action and the one that ends
    it.

    ``places`` has the new states of the SBs that it moves. ``order`` counts the edges that are
    done. ``transit`` are the base digits in transit from its start to its commit.
    """

    edge: Edge
    first: int
    transit: tuple[FactKey, ...] = ()
    done: int = -1
    order: int = -1
    places: Mapping[str, str] = field(default_factory=dict)


class StepDraft:
    """A joint step while it is written. ``configuration`` has the states so far.

    ``links`` are pairs (crossing, base edge) that commit together. A ``light`` draft finds only the
    cost and the end. In it the route of a sub-SB without sub-SBs is one entry (``stride``), and it
    gives no joint step.
    """

    def __init__(self, configuration: Mapping[str, str], light: bool = False) -> None:
        self.light = light
        self.counts: dict[str, int] = {}
        self.configuration = dict(configuration)
        self.carried: list[Carried] = []
        self.functions: list[Edge] = []
        self.links: list[tuple[Carried, Carried]] = []
        self.cost = 0.0
        self._finished = 0

    @property
    def asked(self) -> Edge | None:
        """The edge that the draft began with."""
        return self.carried[0].edge if self.carried else None

    def begin(self, edge: Edge, transit: tuple[FactKey, ...] = ()) -> Carried:
        """Let an edge start with the next function that runs."""
        carried = Carried(edge, len(self.functions), transit)
        self.carried.append(carried)
        self.cost += edge.cost
        self.counts[edge.branch] = self.counts.get(edge.branch, 0) + 1
        return carried

    def stride(self, branch: str, goal: str, cost: float, count: int) -> None:
        """Move a sub-SB without sub-SBs to ``goal`` by a route of ``count`` edges."""
        self.configuration[branch] = goal
        self.cost += cost
        self.counts[branch] = self.counts.get(branch, 0) + count

    def add(self, other: StepDraft, names: Iterable[str]) -> None:
        """Add everything that another light draft did to the SBs ``names``."""
        self.configuration.update((name, other.configuration[name]) for name in names)
        self.cost += other.cost
        for branch, count in other.counts.items():
            self.counts[branch] = self.counts.get(branch, 0) + count

    def run(self, edge: Edge) -> int:
        """Let the edge's own function run, and return the index of this action."""
        self.functions.append(edge)
        return len(self.functions) - 1

    def finish(self, carried: Carried, done: int, places: Mapping[str, str]) -> None:
        """Let the edge be true after action ``done``, with its SBs in ``places``."""
        carried.order = self._finished
        self._finished += 1
        carried.done, carried.places = done, places
        self.configuration.update(places)

    def joint_step(self) -> JointStep:
        """Return the finished joint step as a frozen value."""
        done = sorted(self.carried, key=lambda c: (c.done, c.order))
        commits = _commits(self.carried, done, self.links)
        actions = tuple(_actions(self.functions, self.carried, done, commits))
        after = {branch: state for c in done for branch, state in c.places.items()}
        edges = tuple(carried.edge for carried in self.carried)
        return JointStep(edges[0], edges, actions, round(self.cost, 9), after)


Commits = Mapping[int, int]
"""For each ``Carried``, by its identity, the action after which its edge commits."""


def _commits(
    carried: list[Carried], done: list[Carried], links: list[tuple[Carried, Carried]]
) -> Commits:
    """Return after which action each edge commits (clause 6). A crossing commits with the edges of
    its bases. Every edge that follows in one of their SBs while they are pending commits with them
    too.
    """
    number = {id(c): index for index, c in enumerate(carried)}
    into = list(range(len(carried)))
    ends = [c.done for c in carried]

    def group(one: Carried) -> int:
        """Return the number of the first edge of the group that commits together with this one."""
        at = number[id(one)]
        while into[at] != at:
            into[at] = into[into[at]]
            at = into[at]
        return at

    def join(one: Carried, other: Carried) -> None:
        """Let two edges commit together, at the later of their two ends."""
        first, second = sorted((group(one), group(other)))
        ends[first] = max(ends[first], ends[second])
        into[second] = first

    for crossing, base in links:
        join(crossing, base)
    latest: dict[str, Carried] = {}
    for one in done:
        for branch in one.places:
            former = latest.get(branch)
            if former is not None and ends[group(former)] > one.done:
                join(former, one)
            latest[branch] = one
    return {id(c): ends[group(c)] for c in carried}


def _actions(
    functions: list[Edge], carried: list[Carried], done: list[Carried], commits: Commits
) -> Iterator[JointAction]:
    begun = _by(carried, lambda c: c.first)
    ended = _by(done, lambda c: c.done)
    committed = _by(done, lambda c: commits[id(c)])
    open_ones: Counter[FactKey] = Counter()
    for index, function in enumerate(functions):
        now, committing = ended.get(index, []), committed.get(index, [])
        for c in begun.get(index, []):
            if commits[id(c)] >= index:
                open_ones.update(c.transit)
        transit = frozenset(open_ones)
        for c in committing:
            for fact in c.transit if c.first <= index else ():
                open_ones[fact] -= 1
                if not open_ones[fact]:
                    del open_ones[fact]
        yield JointAction(
            edge=function,
            begins=tuple(c.edge for c in begun.get(index, [])),
            moved={branch: state for c in now for branch, state in c.places.items()},
            done=tuple(c.edge for c in now),
            commits=tuple(c.edge for c in committing),
            committed={branch: state for c in committing for branch, state in c.places.items()},
            transit=transit,
            after=frozenset(open_ones),
        )


def _by(all_of: list[Carried], index: Callable[[Carried], int]) -> dict[int, list[Carried]]:
    """Return the edges by the number of an action, in the given order."""
    found: dict[int, list[Carried]] = {}
    for one in all_of:
        found.setdefault(index(one), []).append(one)
    return found
