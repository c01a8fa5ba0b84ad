"""The product steps of a blueprint: from its edges to steps of sets of configurations.

Edges with equal effects are one group. A group whose sub-SBs are tame is written at once. Any other
is worked out from configuration to configuration by the stepper, over the SBs that its steps can
depend on alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

from smsl_studio.blueprint.allowance import Allowance
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.edges import Edge, EdgeKind
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from smsl_studio.errors import PlanningError
from smsl_studio.graph.joint.products import (
    AskedMoves,
    JointMoves,
    JointProducts,
    Pairs,
    StateNumbers,
    TooLarge,
    joined,
)
from smsl_studio.graph.joint.tame import TameSubs
from smsl_studio.stop import heed

MOST_BOXES = 20_000
"""The largest number of joint steps that are worked out one by one."""

ANY_EDGE = Terms(failing=None)
"""The terms that leave no edge out."""

MOST_PAIRS = 4_000_000
"""The largest number of pairs of one SB, for what is passed on the way."""


@dataclass
class _Group:
    """Edges of one SB with equal effects on other SBs."""

    branch: str
    falls: tuple[int, ...]
    rises: tuple[int, ...]
    crossing: int
    function: bool
    load: bool
    requires: tuple[tuple[str, int, str], ...]
    edges: list[Edge] = field(default_factory=list)

    @property
    def driven(self) -> tuple[tuple[int, bool], ...]:
        """The digits whose sub-SBs move, in their order, and whether each rises."""
        return (*((one, False) for one in self.falls), *((one, True) for one in self.rises))


class ProductSteps:
    """Writes the steps of a blueprint as products. Any operation may succeed.

    ``terms`` can exclude operations, for example those that lead into a failure.
    """

    def __init__(
        self, hierarchy: Hierarchy, terms: Terms = ANY_EDGE, most: int = MOST_BOXES
    ) -> None:
        self.numbers = StateNumbers(hierarchy)
        self._hierarchy, self._blueprint = hierarchy, hierarchy.blueprint
        self._terms, self._stepper = terms, Stepper(hierarchy, terms)
        self._tame = TameSubs(self._stepper, self.numbers)
        self._left = most
        self._most = most
        self._rough: list[_Group] = []

    def products(self) -> JointProducts:
        """Return all steps, and what they pass. TooLarge if they are too many."""
        found = JointProducts()
        for name in self._hierarchy.order:
            for group in self._groups(name):
                heed()
                rough = len(found.rough)
                if not self._written(group, found):
                    self._worked_out(group, found)
                if len(found.rough) > rough:
                    self._rough.append(group)
        steps = [one for one in joined(found.steps) if not _stands(one)]
        return JointProducts(steps, found.asked, joined(found.passed), joined(found.rough))

    def exactly_passed(self) -> list[JointMoves]:
        """Return what the steps pass that have rough products. TooLarge if that are too many."""
        found = JointProducts()
        for group in self._rough:
            self._worked_out(group, found)
        return joined(found.passed)

    def _groups(self, name: str) -> Iterable[_Group]:
        groups: dict[object, _Group] = {}
        for state in self._blueprint[name].table:
            heed()
            for edge in self._stepper.edges.out(name, state):
                if any(digit < 0 for _, digit, _ in edge.requires):
                    continue  # it requires what is no fact
                if self._stepper.closed(edge):
                    continue
                key = (edge.falls, edge.rises, edge.crossing, edge.function, edge.load,
                       edge.requires)  # fmt: skip
                if key not in groups:
                    groups[key] = _Group(name, *key)
                groups[key].edges.append(edge)
        return groups.values()

    # written at once ------------------------------------------------------------------------------

    def _written(self, group: _Group, found: JointProducts) -> bool:
        """Write the products of a group, False if configurations must be looked at."""
        subs = dict(self._hierarchy.subs[group.branch])
        driven = [(subs[digit], rise) for digit, rise in group.driven]
        if group.load or not all(sub in self._tame for sub, _ in driven):
            return False
        if len({sub for sub, _ in driven}) < len(driven):
            return False
        ways = self._along(group.branch, group.crossing) if group.crossing else [{}]
        if ways is None:
            return False
        own = {self.numbers.at[group.branch]: self._pairs(group.edges)}
        parts = [self._tame.moves(sub, rise) for sub, rise in driven]
        for way in ways:
            moves: dict[int, Pairs] = {**own, **way}
            for part in parts:
                moves.update(part)
            moves = self._requiring(moves, group)
            if all(moves.values()):
                found.steps.append(moves)
                passed, rough = len(found.passed), len(found.rough)
                self._pass(moves, group, driven, found)
                more = found.passed[passed:], found.rough[rough:]
                found.asked.append(AskedMoves(group.edges, moves, *more))
        return True

    def _pairs(self, edges: Iterable[Edge]) -> Pairs:
        number: Mapping[str, int] = {}
        found = set()
        for edge in edges:
            heed()
            number = number or self.numbers.number[self.numbers.at[edge.branch]]
            found.add((number[edge.source], number[edge.target]))
        return frozenset(found)

    def _requiring(self, moves: Mapping[int, Pairs], group: _Group) -> dict[int, Pairs]:
        """Return a product with the guards of what its edges require."""
        found = dict(moves)
        for name, digit, value in group.requires:
            at, branch = self.numbers.at[name], self._blueprint[name]
            good = {
                number
                for number, state in enumerate(self.numbers.states[at])
                if branch.facts(state)[digit] == value
            }
            pairs = found.get(at)
            if pairs is None:
                found[at] = frozenset((one, one) for one in good)
            else:
                found[at] = frozenset(pair for pair in pairs if pair[0] in good)
        return found

    def _along(self, sub: str, crossing: int) -> list[dict[int, Pairs]] | None:
        """Return what the bases of a sub-SB do when it crosses, as products that exclude each
        other. None if that depends on more than the state of single bases.
        """
        bases = self._hierarchy.bases[sub]
        if len({base for base, _ in bases}) < len(bases):
            return None
        found: list[dict[int, Pairs]] = [{}]
        for base, digit in bases:
            ways = self._base_ways(base, digit, crossing)
            if ways is None or (len(bases) > 1 and any(len(way) != 1 for way in ways)):
                return None
            found = [{**one, **way} for one in found for way in ways]
        return found

    def _base_ways(self, base: str, digit: int, crossing: int) -> list[dict[int, Pairs]] | None:
        taken: dict[int, list[Edge]] = {-1: [], 0: [], 1: []}
        for state in self._blueprint[base].table:
            heed()
            singles = self._singles(base, state, digit, crossing)
            if any(edge.requires for edge in singles):
                return None
            if singles:
                first = singles[0]
                if first.crossing and len(singles) > 1:
                    return None
                taken[first.crossing].append(first)
        at = self.numbers.at[base]
        found: list[dict[int, Pairs]] = []
        for further, edges in taken.items():
            if not edges:
                continue
            ways = self._along(base, further) if further else [{}]
            if ways is None:
                return None
            found += [{at: self._pairs(edges), **way} for way in ways]
        return found

    def _singles(self, base: str, state: str, digit: int, crossing: int) -> list[Edge]:
        """Return the edges that a base may take along, the cheapest first (clause 10)."""
        kind = EdgeKind.RISE if crossing > 0 else EdgeKind.FALL
        found = (
            edge
            for edge in self._stepper.edges.out(base, state)
            if edge.kind is kind and digit in (*edge.rises, *edge.falls) and not edge.load
        )
        fit = (edge for edge in found if not self._stepper.closed(edge))
        return sorted(fit, key=lambda edge: (edge.price, edge.name))

    def _pass(
        self,
        moves: Mapping[int, Pairs],
        group: _Group,
        driven: list[tuple[str, bool]],
        found: JointProducts,
    ) -> None:
        """Add what the steps of a product pass: their sub-SBs move one after the other."""
        now = {one: frozenset((a, a) for a, _ in pairs) for one, pairs in moves.items()}
        for number, (sub, rise) in enumerate(driven):
            inside, tree = self._tame.inside(sub, rise), self._hierarchy.tree(sub)
            exact = self._tame.is_flat(sub)
            places = {self.numbers.at[name] for name in tree}
            starts = {one: {a for a, _ in moves[one]} for one in places}
            between = {
                one: frozenset(pair for pair in pairs if pair[0] in starts[one])
                for one, pairs in inside.items()
            }
            last = number == len(driven) - 1
            if last and not rise and not group.function:
                # The base edge commits with the crossing, which comes first in a fall (clause 6).
                # Below a sub-SB with sub-SBs it may come later.
                for one in moves.keys() - places:
                    now[one] = moves[one] if exact else now[one] | moves[one]
            if sum(map(len, between.values())) > MOST_PAIRS:
                raise TooLarge(f"{MOST_PAIRS:,} pairs of states that are passed")
            if all(between.values()):
                (found.passed if exact else found.rough).append({**now, **between})
            now.update((one, moves[one]) for one in places)
            if group.function or not last:
                found.passed.append(dict(now))

    # worked out -----------------------------------------------------------------------------------

    def _worked_out(self, group: _Group, found: JointProducts) -> None:
        """Add the products of a group from configuration to configuration."""
        names = self._depends(group)
        branches = {name: self._blueprint[name] for name in self._blueprint.branches
                    if name in names}  # fmt: skip
        part = Hierarchy(replace(self._blueprint, branches=MappingProxyType(branches)))
        stepper = Stepper(part, self._terms)
        at = self.numbers.at[group.branch]
        for edges in self._alike(group, names):
            asked, pairs = edges[0], self._pairs(edges)
            steps: list[JointMoves] = []
            passed: list[JointMoves] = []
            for here in _configurations(part, group.branch, asked.source):
                heed()
                self._left -= 1
                if self._left < 0:
                    raise TooLarge(f"{self._most:,} configurations of single operations")
                for after in self._carried(stepper, here, asked, passed):
                    steps.append(after)
            fresh = joined({**one, at: pairs} for one in steps)
            found.steps += fresh
            still = frozenset((source, source) for source, _ in pairs)
            began = frozenset({(self.numbers.number[at][asked.source],) * 2})
            on_the_way = joined({**one, at: still if one[at] == began else pairs} for one in passed)
            found.passed += on_the_way
            found.asked += [AskedMoves(edges, one, on_the_way) for one in fresh]

    def _alike(self, group: _Group, names: set[str]) -> Iterable[list[Edge]]:
        """Return the edges of a group in classes. Those of a class do the same with all SBs of
        ``names``, as far as their own SB does not count.
        """
        branch = self._blueprint[group.branch]
        digits = [digit for digit, sub in self._hierarchy.subs[group.branch] if sub in names]
        moving = names - {group.branch}
        seen = any(group.branch in self._stepper.edges.required_by(name) for name in moving)
        classes: dict[object, list[Edge]] = {}
        for edge in group.edges:
            on = tuple(branch.is_on(edge.source, digit) for digit in digits)
            own = (edge.source, edge.target) if seen or group.requires or group.load else None
            stands = edge.source == edge.target
            classes.setdefault((on, own, stands), []).append(edge)
        return classes.values()

    def _carried(
        self, stepper: Stepper, here: Mapping[str, str], asked: Edge, passed: list[JointMoves]
    ) -> Iterator[JointMoves]:
        """Yield the step of an edge from a configuration, if there is one; add what it passes."""
        edge = stepper.edges.get(asked.address)
        stepper.allowance = Allowance(stepper.hierarchy)
        try:
            step = None if edge is None else stepper.written(here, edge)
        except PlanningError as error:
            raise TooLarge(error.sentence) from error
        if isinstance(step, JointStep):
            yield self._single(here, {**here, **step.after})
            now = dict(here)
            for action in step.actions[:-1]:
                now.update(action.moved)
                passed.append(self._single(here, now))

    def _single(self, here: Mapping[str, str], there: Mapping[str, str]) -> dict[int, Pairs]:
        found = {}
        for name, state in here.items():
            at = self.numbers.at[name]
            number = self.numbers.number[at]
            found[at] = frozenset({(number[state], number[there[name]])})
        return found

    def _depends(self, group: _Group) -> set[str]:
        """Return all SBs that the steps of a group can depend on."""
        subs = dict(self._hierarchy.subs[group.branch])
        moving = {group.branch}
        for digit, _ in group.driven:
            moving.update(self._hierarchy.tree(subs[digit]))
        waiting = list(moving)
        while waiting:
            name = waiting.pop()
            if name == group.branch and not group.crossing:
                continue
            for base, _ in self._hierarchy.bases[name]:
                if base not in moving:
                    moving.add(base)
                    waiting.append(base)
        return moving.union(*(self._stepper.edges.required_by(name) for name in moving))


def _stands(moves: JointMoves) -> bool:
    return all(a == b for pairs in moves.values() for a, b in pairs)


def _configurations(hierarchy: Hierarchy, asked: str, source: str) -> Iterator[dict[str, str]]:
    """Yield all configurations that keep the invariant, with one SB in one state."""
    order, blueprint = hierarchy.order, hierarchy.blueprint
    here: dict[str, str] = {}

    def further(at: int) -> Iterator[dict[str, str]]:
        """Yield the configurations that go on from the states of the first SBs."""
        if at == len(order):
            yield dict(here)
            return
        name = order[at]
        branch = blueprint[name]
        votes = {blueprint[base].is_on(here[base], d) for base, d in hierarchy.bases[name]}
        for state in (source,) if name == asked else branch.table:
            if all(vote == (state == branch.activating) for vote in votes):
                here[name] = state
                yield from further(at + 1)
                del here[name]

    return further(0)
