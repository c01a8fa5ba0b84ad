"""From examples to the rule set with the fewest cases that makes exactly these edges."""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.errors import PlanningError
from smsl_studio.generate.examples.atoms import Atoms, terms_of
from smsl_studio.generate.examples.cases import CaseSearch, LearntRule
from smsl_studio.generate.examples.cover import condition_of, formula_text
from smsl_studio.generate.examples.fact_names import fact_names
from smsl_studio.generate.examples.family import Family, families, single, without
from smsl_studio.generate.examples.table import ExampleTable, Values
from smsl_studio.stop import heed

_MOST_LEFT_OUT = 12


@dataclass(frozen=True)
class LearntRules:
    """Rules that make exactly the edges of a table. ``never`` has conditions as text."""

    table: ExampleTable
    names: tuple[str, ...]
    rules: tuple[LearntRule, ...]
    never: tuple[str, ...]

    @property
    def cases(self) -> int:
        """The number of cases."""
        return sum(len(rule.cases) for rule in self.rules)

    @property
    def cost(self) -> float:
        """How much there is to read."""
        return sum(rule.cost for rule in self.rules) + sum(len(one) / 12 for one in self.never)


def learnt_rules(table: ExampleTable) -> LearntRules:
    """Return the rules of a table. PlanningError if there are none."""
    found = [RuleSearch(table, left_out=True).rules()]
    if found[0].never:
        found.append(RuleSearch(table, left_out=False).rules())
    return min(found, key=lambda one: (one.cases, one.cost))


class RuleSearch:
    """Finds families and their rules. With ``left_out`` they may use 'never', too."""

    def __init__(self, table: ExampleTable, *, left_out: bool) -> None:
        self._table, self._left_out = table, left_out
        self._names = fact_names(table)
        self._operations = [name for name, own in table.edges.items() if own]

    def rules(self) -> LearntRules:
        """Return the rules with the fewest cases that were found."""
        alone = {name: self._rule(single(name)) for name in self._operations}
        best: dict[str, LearntRule] = {}
        for name, rule in alone.items():
            if rule is None:
                raise PlanningError(
                    f"no rule was found for {name}", advice="It has too many different effects."
                )
            best[name] = rule
        joined = self._joined_rules(best)
        chosen = self._fewest(joined, best)
        order = {name: at for at, name in enumerate(self._operations)}
        last = len(order)
        chosen.sort(key=lambda one: min(order.get(n, last) for n in one.family.operations))
        return LearntRules(self._table, self._names, tuple(chosen), self._never(chosen))

    def _joined_rules(self, best: dict[str, LearntRule]) -> list[LearntRule]:
        """Return the rules of families that have fewer cases than the rules of their operations."""
        found: list[LearntRule] = []
        for family in families(self._operations):
            heed()
            covered = any(
                len(rule.cases) == 1 and set(family.operations) <= set(rule.family.operations)
                for rule in found
            )
            rule = None if covered else self._joined(family, best)
            if rule is not None:
                found.append(rule)
        return found

    def _fewest(self, joined: list[LearntRule], best: dict[str, LearntRule]) -> list[LearntRule]:
        """Return rules for all operations, each in one, with few cases: from the largest families
        down, or from those that save the most for each case they have."""
        orders = (
            joined,
            sorted(joined, key=lambda one: -self._gain(one, best)),
            sorted(joined, key=lambda one: -self._gain(one, best) / len(one.cases)),
        )
        plans = []
        for order in orders:
            taken: set[str] = set()
            chosen: list[LearntRule] = []
            for rule in order:
                if not taken.intersection(rule.family.operations):
                    chosen.append(rule)
                    taken.update(rule.family.operations)
            plans.append(chosen + [rule for name, rule in best.items() if name not in taken])
        return min(plans, key=lambda plan: (sum(len(one.cases) for one in plan), len(plan)))

    def _joined(self, family: Family, best: dict[str, LearntRule]) -> LearntRule | None:
        """Return the rule of a family, or of most of it, if it has fewer cases than its parts."""
        rule = self._gaining(family, best)
        if rule is not None:
            return rule
        found: list[tuple[int, LearntRule]] = []
        for name, values in family.choices.items():
            if not 2 < len(values) <= _MOST_LEFT_OUT:
                continue
            for value in values:
                fewer = without(family, name, value)
                own = None if fewer is None else self._gaining(fewer, best)
                if own is not None:
                    found.append((self._gain(own, best), own))
        return max(found, key=lambda one: one[0])[1] if found else None

    def _gaining(self, family: Family, best: dict[str, LearntRule]) -> LearntRule | None:
        parts = [best[name] for name in family.operations if name in best]
        cases = sum(len(one.cases) for one in parts)
        return self._rule(family, cases - 1, sum(one.cost for one in parts) + 1)

    def _gain(self, rule: LearntRule, best: dict[str, LearntRule]) -> int:
        parts = [best[name] for name in rule.family.operations if name in best]
        return sum(len(one.cases) for one in parts) - len(rule.cases)

    def _rule(self, family: Family, cases: int = 90, cost: float = 1e6) -> LearntRule | None:
        terms = terms_of(family, self._names, self._table.alphabets)
        atoms = Atoms(terms, self._table.states)
        return CaseSearch(self._table, family, atoms, left_out=self._left_out).rule(cases, cost)

    def _never(self, rules: list[LearntRule]) -> tuple[str, ...]:
        """Return conditions of the values, no state, to which the rules would lead."""
        if not self._left_out:
            return ()
        outside = list(dict.fromkeys(_outside(self._table, rules)))
        if not outside:
            return ()
        states = [*self._table.states, *outside]
        atoms = Atoms(terms_of(single("never"), self._names, self._table.alphabets), states)
        inside = (1 << len(self._table.states)) - 1
        formula = condition_of(atoms, atoms.literals(), atoms.full & ~inside, inside)
        if formula is None:
            raise PlanningError("what is left out cannot be said as a condition")
        if formula.every or not formula.some:
            return (formula_text(formula, atoms),)
        return tuple(" and ".join(one.text for one in clause.literals) for clause in formula.some)


def _outside(table: ExampleTable, rules: list[LearntRule]) -> list[Values]:
    """Return the values that no state has and to which a rule leads from a state."""
    known = set(table.names)
    found: list[Values] = []
    for rule in rules:
        terms, size = rule.atoms.terms, len(table.states)
        free = rule.atoms.full
        for case in rule.cases:
            holds = free
            for clause in case.when.every:
                holds &= ~clause.mask if clause.excluded else clause.mask
            if case.when.some:
                some = 0
                for clause in case.when.some:
                    some |= clause.mask
                holds &= some
            free &= ~holds
            while holds:
                heed()
                bit = holds & -holds
                holds ^= bit
                at, number = divmod(bit.bit_length() - 1, size)
                after = list(table.states[number])
                for fact, value in case.change:
                    after[terms.facts[fact][at]] = terms.values[value][at]
                if tuple(after) not in known:
                    found.append(tuple(after))
    return found


def operation_cost(table: ExampleTable, operation: str) -> float:
    """Return how much there is to read in the rule of one operation alone, and 4 for each case."""
    names = fact_names(table)
    family = single(operation)
    atoms = Atoms(terms_of(family, names, table.alphabets), table.states)
    rule = CaseSearch(table, family, atoms, left_out=False).rule()
    return 10_000 if rule is None else rule.cost + 4 * len(rule.cases)
