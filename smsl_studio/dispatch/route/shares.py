"""What one SB contributes to the rest of a route, from each of its states: a decomposition.

Every sub-SB whose digit is on at the goal must be in ACTIVATING in the end, so each of its falls is
followed by one rise. The fall is charged for both, together with the ways between (a cycle), and a
rise costs nothing more. Only the first rise is another matter: it costs what it costs from where
the sub-SB stands. So each SB needs the shortest ways of its own graph alone, and the joint
configurations of its sub-SBs are not looked at. The other digits are *loose*: the ranks are only
bounds then.

There are two manners of moving. An SB is *driven* if an edge of its base takes it along: its own
edges drive its sub-SBs, which always fall to INITIAL. It is *free* if its own operations are asked
for before its base drives it: each is one move more, and its sub-SBs may also leave ACTIVATING by
an operation of their own, which takes along a fall of this SB.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from heapq import heapify, heappop, heappush
from math import inf

from smsl_studio.blueprint.edges import Edge, EdgeKind
from smsl_studio.dispatch.route.ranks import MOVE, NUMBER, Rank, rank_of

Key = Sequence[str]
Into = dict[str, list[tuple[str, Rank]]]
"""For each state the states before it, with the rank of the edge between."""

SLICE = 500
"""The number of edges after which the work may be called off."""


@dataclass(eq=False)
class RouteShare:
    """The ranks of one SB's ways to ``goal``, and of the cycles of a sub-SB.

    ``at`` is its place in a joint configuration, and ``subs`` has the shares of its sub-SBs by
    digit. ``free`` and ``driven`` have the rank from each state. A way from a configuration costs
    the same plus the first rises of the sub-SBs that are off.
    """

    name: str
    at: int
    goal: str
    initial: str
    subs: Mapping[int, RouteShare]
    loose: frozenset[int]
    """The digits that are off at the goal. Their ranks are only bounds: nothing but the operations
    that enter and leave ACTIVATING.
    """
    off: Mapping[str, tuple[RouteShare, ...]]
    """The shares of the sub-SBs that are off in each state, without loose digits."""
    free: Mapping[str, Rank] = field(default_factory=dict)
    driven: Mapping[str, Rank] = field(default_factory=dict)
    fall: Rank = inf
    """Its way from ACTIVATING to INITIAL if its base drives it."""
    after_free: Rank = inf
    """The next rise after such a fall, if its operations may be asked for before."""
    after_driven: Rank = inf
    """The same if its base drives it."""
    enter: Rank = inf
    """The least rank of an operation that enters ACTIVATING."""
    leave: Rank = inf
    """The same of one that leaves it."""
    cycle: Rank = inf
    """The least rank of leaving ACTIVATING by an operation that is asked for, and the next rise."""

    def loosely(self, edge: Edge) -> Rank:
        """Return what the rises and falls of loose digits cost at least on an edge."""
        if not self.loose:
            return 0
        rises = sum(self.subs[digit].enter for digit in edge.rises if digit in self.loose)
        return rises + sum(self.subs[digit].leave for digit in edge.falls if digit in self.loose)

    def firm(self, digits: Sequence[int]) -> Iterator[RouteShare]:
        """Yield the shares of some digits without the loose ones."""
        return (self.subs[digit] for digit in digits if digit not in self.loose)

    def freely(self, node: Key) -> Rank:
        """Return the rank of its way from a joint configuration."""
        state = node[self.at]
        found = self.free.get(state, inf)
        for share in self.off[state]:
            found += share.freely(node)
        return found


def as_root(
    share: RouteShare, edges: Mapping[str, Sequence[Edge]], any_single: bool
) -> Iterator[None]:
    """Work out the ranks of a root that is asked for its own operations. It yields now and then.

    ``edges`` has the usable edges out of each state. With ``any_single`` the ranks are lower
    bounds: any rise or fall of a single digit may be taken along, not only the first one.
    """
    into: Into = {}
    count = 0
    for state, out in edges.items():
        count += 1 + len(out)
        if count > SLICE:
            count = 0
            yield
        for edge, charge in _asked(share, out, any_single):
            if edge.target != state:
                rank = rank_of(edge.cost) + charge + NUMBER + MOVE
                into.setdefault(edge.target, []).append((state, rank))
    share.free = yield from _spread({share.goal: 0}, into)


def as_sub(
    share: RouteShare, edges: Mapping[str, Sequence[Edge]], any_single: bool
) -> Iterator[None]:
    """Work out the same for a sub-SB, whose goal is its ACTIVATING state."""
    driven: Into = {}
    free: Into = {}
    down: Into = {}
    count = 0
    for state, out in edges.items():
        count += 1 + len(out)
        if count > SLICE:
            count = 0
            yield
        for edge in out:
            own = rank_of(edge.cost) + share.loosely(edge)
            if edge.crossing > 0:
                share.enter = min(share.enter, rank_of(edge.cost))
            elif edge.crossing < 0:
                share.leave = min(share.leave, rank_of(edge.cost))
            if edge.crossing >= 0:
                rank = own + sum(sub.fall + sub.after_driven for sub in share.firm(edge.falls))
                driven.setdefault(edge.target, []).append((state, rank))
            if edge.crossing <= 0:
                rank = own + sum(sub.fall for sub in share.firm(edge.falls))
                rank += sum(sub.after_driven for sub in share.firm(edge.rises))
                down.setdefault(edge.target, []).append((state, rank))
        if not share.subs:
            continue
        for edge, charge in _asked(share, out, any_single):
            if not edge.crossing and edge.target != state:
                rank = rank_of(edge.cost) + charge + MOVE
                free.setdefault(edge.target, []).append((state, rank))
    share.driven = yield from _spread({share.goal: 0}, driven)
    share.free = (yield from _spread(share.driven, free)) if free else share.driven
    falls = yield from _spread({share.initial: 0}, down)
    share.fall = falls.get(share.goal, inf)
    low = share.off[share.initial]
    share.after_free = share.free.get(share.initial, inf) + sum(one.after_free for one in low)
    share.after_driven = share.driven.get(share.initial, inf) + sum(s.after_driven for s in low)
    share.cycle = min(
        (
            rank_of(edge.cost) + charge + share.free.get(edge.target, inf)
            for edge, charge in _asked(share, edges[share.goal], any_single)
            if edge.crossing < 0
        ),
        default=inf,
    )


def _asked(
    share: RouteShare, edges: Sequence[Edge], any_single: bool
) -> Iterator[tuple[Edge, Rank]]:
    """Yield the edges out of a state that may be asked for, each with the cycles of its falls.

    A sub-SB's own operation takes along the first fall of its digit by price and name.
    """
    singles: dict[int, Edge] = {}
    for edge in edges:
        if edge.kind is EdgeKind.FALL and not any_single:
            digit = edge.falls[0]
            first = singles.get(digit)
            if first is None or (edge.price, edge.name) < (first.price, first.name):
                singles[digit] = edge
    for edge in edges:
        charge = sum(sub.fall + sub.after_free for sub in share.firm(edge.falls))
        charge += share.loosely(edge)
        if edge.kind is EdgeKind.FALL and edge.falls[0] not in share.loose:
            digit = edge.falls[0]
            if any_single or singles[digit] is edge:
                charge = min(charge, share.subs[digit].cycle)
        yield edge, charge


def _spread(ends: Mapping[str, Rank], into: Into) -> Generator[None, None, dict[str, Rank]]:
    """Return the least rank to one of the ends from each state that has a way (Dijkstra)."""
    found = dict(ends)
    heap = [(rank, state) for state, rank in ends.items()]
    heapify(heap)
    count = 0
    while heap:
        rank, state = heappop(heap)
        if rank > found[state]:
            continue
        before = into.get(state, ())
        count += 1 + len(before)
        if count > SLICE:
            count = 0
            yield
        for source, more in before:
            further = rank + more
            if further < found.get(source, inf):
                found[source] = further
                heappush(heap, (further, source))
    return found
