"""Whether a route can be found without a walk over joint configurations, and the ranks for it.

The least rank of a route from any joint configuration is then a sum over the SBs (see ``shares``).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Configuration, Hierarchy, disagreements
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.dispatch.route.ranks import Rank, cost_of, most_exact
from smsl_studio.dispatch.route.shares import SLICE, RouteShare, as_root, as_sub
from smsl_studio.stop import heed

Key = tuple[str, ...]


def is_tree(hierarchy: Hierarchy, goal: Address, movers: Collection[str]) -> bool:
    """Return whether a decomposition has at least lower bounds of the ranks of routes to ``goal``.

    - ``goal`` is a state of the only root.
    - Each sub-SB has one base, on one digit. So nobody else waits for its facts.
    - No edge loads its sub-SBs, because ``load`` brings facts about without their operations.

    Whatever closes an edge or a configuration, such as ``requires``, can only make routes dearer.
    """
    if hierarchy.bases[goal.branch] or hierarchy.roots_of(goal.branch) != (goal.branch,):
        return False
    for name in movers:
        branch = hierarchy.blueprint[name]
        last = goal.state if name == goal.branch else branch.activating
        if last not in branch.table:
            return False
        if name != goal.branch and (
            len(hierarchy.bases[name]) != 1
            or branch.initial not in branch.table
            or branch.initial == branch.activating
        ):
            return False
        if any(note.subs == "load" for note in branch.notes.operations.values()):
            return False
    return set(movers) == set(hierarchy.tree(goal.branch))


def ends_on(hierarchy: Hierarchy, goal: Address, movers: Collection[str]) -> bool:
    """Return whether all sub-SBs of the root are on at the goal, and those of every sub-SB in its
    ACTIVATING state. So each fall is followed by a rise, and both are charged at once.
    """
    for name in movers:
        branch = hierarchy.blueprint[name]
        last = goal.state if name == goal.branch else branch.activating
        if not all(branch.is_on(last, digit) for digit, _ in hierarchy.subs[name]):
            return False
    return True


def is_bounded(
    stepper: Stepper, start: Configuration, goal: Address, movers: Collection[str]
) -> bool:
    """Return whether the ranks of routes to ``goal`` from ``start`` are at least those of one.

    - The SBs are such a tree (see ``is_tree``).
    - The configuration agrees: a sub-SB whose digit is on is in ACTIVATING, with all below it.
    - Costs have at most nine decimal places, so their sums are equal if they are equal in truth.
    """
    hierarchy = stepper.hierarchy
    return (
        is_tree(hierarchy, goal, movers)
        and not disagreements(hierarchy, start)
        and most_exact(_costs(stepper, movers)) > 0
    )


def is_decomposed(
    stepper: Stepper, start: Configuration, goal: Address, movers: Collection[str]
) -> bool:
    """Return whether the ranks of routes to ``goal`` are exactly those of a decomposition.

    - They are bounded by one (see ``is_bounded``), and all sub-SBs are on in the end.
    - No operation ``requires`` a fact, so nothing depends on where another SB stands.
    - No SB has failure states and the blueprint no hazards, so no configuration is closed.
    """
    blueprint = stepper.hierarchy.blueprint
    return (
        is_bounded(stepper, start, goal, movers)
        and ends_on(stepper.hierarchy, goal, movers)
        and not blueprint.hazards
        and not any(failing_states(blueprint[name]) for name in movers)
        and not any(
            note.requires for name in movers for note in blueprint[name].notes.operations.values()
        )
    )


def _costs(stepper: Stepper, movers: Collection[str]) -> Iterator[float]:
    """Yield the costs of the movers' edges that are not 1."""
    for name in movers:
        for note in stepper.hierarchy.blueprint[name].notes.operations.values():
            if note.cost is not None:
                yield note.cost
    yield from stepper.terms.costs.values()


def only_goal(
    start: Configuration, wanted: Sequence[Address], movers: Collection[str]
) -> Address | None:
    """Return the one goal among the SBs that move, None if there is another number of them, or if
    a goal elsewhere does not hold.
    """
    found = [one for one in wanted if one.branch in movers]
    elsewhere = [one for one in wanted if one.branch not in movers]
    if len(found) != 1 or any(start[one.branch] != one.state for one in elsewhere):
        return None
    return found[0]


class Decomposition:
    """The least rank of a route to ``goal`` from each joint configuration of a tree.

    The work is done when it is first asked for. It heeds the listener (see ``stop``), and goes on
    where it was called off. With ``bounds`` the ranks are only lower bounds, for trees that are
    not ``is_decomposed``.
    """

    def __init__(
        self, stepper: Stepper, goal: Address, movers: Sequence[str], bounds: bool = False
    ) -> None:
        self._stepper, self._goal, self._movers, self._bounds = stepper, goal, movers, bounds
        self._root: RouteShare | None = None
        self._work = self._build()
        self.most = most_exact(_costs(stepper, movers))
        """The cost up to which a search compares sums of costs as ranks do."""

    def rank(self, node: Key) -> Rank:
        """Return the least rank of a route from a joint configuration, ``inf`` if there is none."""
        while self._root is None:
            heed()
            next(self._work)
        return self._root.freely(node)

    def _build(self) -> Iterator[None]:
        """Work out the shares, sub-SBs first. It yields where the work may be called off."""
        hierarchy, count = self._stepper.hierarchy, 0
        at = {name: index for index, name in enumerate(hierarchy.order)}
        shares: dict[str, RouteShare] = {}
        for name in reversed(self._movers):
            branch = hierarchy.blueprint[name]
            subs = {digit: shares[sub] for digit, sub in hierarchy.subs[name]}
            is_root = name == self._goal.branch
            goal = self._goal.state if is_root else branch.activating
            loose = frozenset(digit for digit in subs if not branch.is_on(goal, digit))
            off: dict[str, tuple[RouteShare, ...]] = {}
            edges: dict[str, Sequence[Edge]] = {}
            for state in branch.table:
                off[state] = tuple(
                    sub
                    for digit, sub in subs.items()
                    if digit not in loose and not branch.is_on(state, digit)
                )
                out = self._stepper.edges.out(name, state)
                edges[state] = [edge for edge in out if not self._stepper.closed(edge)]
                count += 1 + len(out)
                if count > SLICE:
                    count = 0
                    yield
            share = shares[name] = RouteShare(
                name, at[name], goal, branch.initial, subs, loose, off
            )
            yield from (as_root if is_root else as_sub)(share, edges, self._bounds)
        self._root = shares[self._goal.branch]
        yield


class Decompositions:
    """The decompositions of one stepper, each made when it is first asked for and then kept."""

    def __init__(self, stepper: Stepper) -> None:
        self._stepper = stepper
        self._kept: dict[tuple[Address, bool], Decomposition] = {}

    def ranks(
        self, start: Configuration, wanted: Sequence[Address], movers: Sequence[str]
    ) -> Decomposition | None:
        """Return the ranks of the routes to the one goal that is wanted, or bounds of them. None if
        there are none.
        """
        goal = only_goal(start, wanted, movers)
        if goal is None or not is_bounded(self._stepper, start, goal, movers):
            return None
        exact = is_decomposed(self._stepper, start, goal, movers)
        return self._of(goal, movers, bounds=not exact)

    def bound(
        self, start: Configuration, wanted: Sequence[Address], movers: Sequence[str]
    ) -> Callable[[Key], float] | None:
        """Return a lower bound of the cost to all that is wanted. None if there is none, or if that
        of single SBs may be higher.
        """
        for goal in wanted:
            if not ends_on(self._stepper.hierarchy, goal, movers):
                continue
            if is_bounded(self._stepper, start, goal, movers):
                ranks = self._of(goal, movers, bounds=True)
                return lambda node: cost_of(ranks.rank(node))
        return None

    def _of(self, goal: Address, movers: Sequence[str], bounds: bool) -> Decomposition:
        found = self._kept.get((goal, bounds))
        if found is None:
            found = self._kept[goal, bounds] = Decomposition(self._stepper, goal, movers, bounds)
        return found
