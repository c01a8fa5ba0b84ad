"""The cases of a rule: what its operations change, in the order in which the first one wins."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from smsl_studio.generate.examples.atoms import Atoms, Literal
from smsl_studio.generate.examples.cover import Formula, condition_of
from smsl_studio.generate.examples.edge_groups import MOST_GROUPS, Assignment, EdgeGroup, EdgeGroups
from smsl_studio.generate.examples.family import Family
from smsl_studio.generate.examples.table import ExampleTable
from smsl_studio.stop import heed

_DEAREST = 1e6
_MOST_ORDERED = 12


@dataclass(frozen=True)
class LearntCase:
    """One case: its condition, and the value it gives to each fact, as the rule writes them."""

    when: Formula
    change: tuple[Assignment, ...]


@dataclass(frozen=True)
class LearntRule:
    """The rule of a family. ``atoms`` writes its conditions."""

    family: Family
    cases: tuple[LearntCase, ...]
    atoms: Atoms

    @property
    def cost(self) -> float:
        """How much there is to read."""
        return sum(case.when.cost + len(case.change) + 1 for case in self.cases)


class CaseSearch:
    """Finds the cases of one family."""

    def __init__(
        self, table: ExampleTable, family: Family, atoms: Atoms, *, left_out: bool
    ) -> None:
        self._table, self._family, self._atoms = table, family, atoms
        self._left_out = left_out
        self._states = table.states
        self._numbers = {values: at for at, values in enumerate(self._states)}
        self._edges = 0
        for at, operation in enumerate(family.operations):
            for source in table.edges.get(operation, {}):
                self._edges |= 1 << (at * len(self._states) + self._numbers[source])

    def rule(self, most_cases: int = MOST_GROUPS, most: float = _DEAREST) -> LearntRule | None:
        """Return the rule, None if it would have more cases, or cost more, than it may."""
        found = EdgeGroups(self._table, self._family, self._atoms)
        ways = [groups for groups in (found.common(), found.merged()) if groups is not None]
        ways = [groups for groups in sorted(ways, key=len) if len(groups) <= most_cases]
        if len(ways) == 2 and {one.mask for one in ways[0]} == {one.mask for one in ways[1]}:
            ways.pop()
        literals = self._atoms.literals() if ways else []
        for groups in ways:
            rule = self._rule(groups, literals, most)
            if rule is not None:
                return rule
        return None

    def _rule(
        self, groups: Sequence[EdgeGroup], literals: Sequence[Literal], most: float
    ) -> LearntRule | None:
        changes = [self._change(group) for group in groups]
        if any(change is None for change in changes):
            return None
        plans = [
            _Plan(group.mask, change, *self._effect(change))
            for group, change in zip(groups, changes, strict=True)
            if change is not None
        ]
        cases = self._ordered(plans, literals, most)
        return None if cases is None else LearntRule(self._family, tuple(cases), self._atoms)

    def _change(self, group: EdgeGroup) -> tuple[Assignment, ...] | None:
        """Return the shortest change that makes all edges of a group."""
        facts = self._atoms.terms.facts
        chosen: list[Assignment] = []
        open_edges = [(at, set(changed)) for at, changed in group.changed.items()]
        taken: list[set[int]] = [set() for _ in self._family.operations]
        while any(changed for _, changed in open_edges):
            heed()
            best, most = None, 0
            for one in sorted(group.sets, key=lambda pair: (pair[0], "{" not in pair[1], pair[1])):
                digits = facts[one[0]]
                if any(digit in own for digit, own in zip(digits, taken, strict=True)):
                    continue
                gain = sum(digits[at] in changed for at, changed in open_edges)
                if gain > most:
                    best, most = one, gain
            if best is None:
                return None
            chosen.append(best)
            for own, digit in zip(taken, facts[best[0]], strict=True):
                own.add(digit)
            for at, changed in open_edges:
                changed.discard(facts[best[0]][at])
        order = list(facts)
        return tuple(sorted(chosen, key=lambda one: order.index(one[0])))

    def _effect(self, change: Sequence[Assignment]) -> tuple[int, int]:
        """Return the examples that have an edge and in which a change leads to its target, and
        those that have none and in which it leads to no state."""
        right = outside = 0
        terms = self._atoms.terms
        for at, operation in enumerate(self._family.operations):
            own = self._table.edges.get(operation, {})
            sets = [(terms.facts[fact][at], terms.values[value][at]) for fact, value in change]
            base = at * len(self._states)
            for number, source in enumerate(self._states):
                heed()
                target = own.get(source)
                if target is None and not self._left_out:
                    continue
                after = list(source)
                for digit, value in sets:
                    after[digit] = value
                if target is None:
                    if tuple(after) not in self._numbers:
                        outside |= 1 << (base + number)
                elif tuple(after) == target:
                    right |= 1 << (base + number)
        return right, outside

    def _ordered(
        self, plans: list[_Plan], literals: Sequence[Literal], most: float
    ) -> list[LearntCase] | None:
        """Return the cases in an order that makes their conditions short."""
        cases: list[LearntCase] = []
        rest = list(plans)
        done = 0
        while rest:
            best: tuple[float, _Plan, Formula] | None = None
            tried = rest if len(rest) <= _MOST_ORDERED else rest[-1:]
            for plan in tried:
                heed()
                formula = self._condition(plan, rest, done, literals)
                if formula is not None and (best is None or formula.cost < best[0]):
                    best = formula.cost, plan, formula
            if best is None:
                return None
            _, plan, formula = best
            most -= formula.cost + len(plan.change) + 1
            if most < 0:
                return None
            cases.append(LearntCase(formula, plan.change))
            rest.remove(plan)
            done |= plan.mask
            for one in rest:
                # What an earlier case makes no later one must make.
                one.mask &= ~done
            rest = [one for one in rest if one.mask]
        return cases

    def _condition(
        self, plan: _Plan, rest: Sequence[_Plan], done: int, literals: Sequence[Literal]
    ) -> Formula | None:
        wanted = plan.mask & ~done
        other = self._atoms.full & ~self._edges & ~plan.outside
        for one in rest:
            if one is not plan:
                other |= one.mask & ~plan.right
        other &= ~done
        return condition_of(self._atoms, literals, wanted, other)


@dataclass
class _Plan:
    """A case before its condition. ``right`` and ``outside`` are as ``_effect`` has them."""

    mask: int
    change: tuple[Assignment, ...]
    right: int
    outside: int
