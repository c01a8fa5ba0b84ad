"""Edges of a table that are mistakes: without them the table is regular.

Two things tell them: a way back that is missing where all edges like it have one (``reversals``),
and a fact on which nothing depends but one edge (``independence``). Mistakes are few. A table in
which many edges look like mistakes is taken as it is.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from dataclasses import dataclass

from smsl_studio.errors import PlanningError
from smsl_studio.generate.examples.independence import independent
from smsl_studio.generate.examples.reversals import Reversals, backward
from smsl_studio.generate.examples.rule_search import learnt_rules, operation_cost
from smsl_studio.generate.examples.table import Example, ExampleTable, Values
from smsl_studio.stop import heed

_SHARE = 0.04
_FEWEST = 2
_REGULAR = 0.75
_STILL = 0.34
"""An edge that changes nothing is odd if so few edges of its operation do that."""
_GAIN = 1.0
_LESS = 0.25
"""The rules must be shorter by so much, for each edge, if an edge is left out."""
_DOUBT, _MARGIN, _SHARES = 12.0, 10.0, 2.5
"""A way back that is not known from edges like it, and an edge that is left out, must make the
rules that much shorter; one that is left out also by these shares of its operation's rule."""
_COMPARED, _SMALL, _FEW, _SEVERAL = 3, 100, 5, 3
"""So many repairs are compared by all their rules, in tables with at most so many edges. In larger
ones the rules of one operation tell enough, and all of them take seconds."""
Done = tuple[tuple[int, str, str], ...]
"""What an edge does: the digits that it changes, with their values before and after."""


def most_mistakes(table: ExampleTable) -> int:
    """Return how many edges may be mistakes."""
    return max(2 * _FEWEST, int(_SHARE * table.count))


def repaired(table: ExampleTable) -> ExampleTable:
    """Return the table without its mistakes: with the edges as they should be."""
    reversal = _ReversalRepair(table)
    return reversal.repaired() if reversal.regular else independent(table)


@dataclass(frozen=True)
class _Repair:
    """One edge and where it should lead (None: nowhere)."""

    operation: str
    source: Values
    target: Values | None


class _ReversalRepair:
    def __init__(self, table: ExampleTable) -> None:
        self._table = table
        self._reversals = Reversals(table)
        self._effects = {self._reversals.effect(edge) for edge in table.all_edges()}
        self._moving = sum(edge.source != edge.target for edge in table.all_edges())
        self._open = self._mismatches(table)
        undone = self._moving - len({edge for edge, _ in self._open})
        back = backward(table)
        paired = sum(
            edge.source != edge.target and (edge.target, edge.source) in back
            for edge in table.all_edges()
        )
        self.regular = (
            bool(self._moving)
            and len(self._open) <= most_mistakes(table)
            and min(undone, paired) >= _REGULAR * self._moving
            and self._moving - paired <= max(_FEWEST, int(_SHARE * table.count))
        )

    def repaired(self) -> ExampleTable:
        """Return the table with every way back. It is the same if that would change too much."""
        if not self.regular:
            return self._table
        table = self._renamed(self._renamed(self._table, exact=False), exact=True)
        left = self._mismatches(table)
        for _ in range(most_mistakes(table)):
            if not left:
                break
            best = self._best(table, left)
            if best is None:
                return self._without_odd(table)
            table, left = best
        return self._without_odd(table)

    def _renamed(self, table: ExampleTable, exact: bool) -> ExampleTable:
        """Return the table with other names for edges that do what no other edge of their operation
        does, if one operation that is not there does just this. If ``exact``, what it does
        includes the values before.

        Such an edge has a way back, and no other leads where it does. The rules must be shorter
        then, if the edge does not change what no other of its operation changes, and no edge may
        lose its way back. If one other does lead there, which is nowhere else
        so, the edge is left out.
        """
        back = backward(table)
        does = {edge: _done(edge, exact) for edge in table.all_edges()}
        done = Counter((edge.operation, change) for edge, change in does.items())
        doing: dict[Done, list[str]] = defaultdict(list)
        for (operation, change), count in done.items():
            if count > exact:
                doing[change].append(operation)
        doubled = sum(len(ways) > 1 for ways in back.values())
        alone = [edge for edge, change in does.items() if done[edge.operation, change] == 1]
        if len(alone) > most_mistakes(table):
            return table
        for edge in alone:
            heed()
            usual = doing[does[edge]]
            beside = [one for one in back[edge.source, edge.target] if one != edge.operation]
            if beside:
                if doubled == 1 and any(one in usual for one in beside):
                    table = table.with_edge(edge.operation, edge.source, None)
                continue
            names = [one for one in usual if edge.source not in table.edges[one]]
            if len(names) != 1 or (edge.target, edge.source) not in back:
                continue
            after = table.with_edge(edge.operation, edge.source, None)
            after = after.with_edge(names[0], edge.source, edge.target)
            if len(self._mismatches(after)) > len(self._mismatches(table)):
                continue
            if (
                _is_strange(table, edge)
                or self._gain(table, after, edge.operation, names[0]) > _GAIN
            ):
                table = after
        return table

    def _gain(self, before: ExampleTable, after: ExampleTable, *operations: str) -> float:
        """Return how much shorter the rules of some operations are."""
        try:
            return sum(
                operation_cost(before, one)
                - (operation_cost(after, one) if after.edges.get(one) else 0)
                for one in operations
            )
        except PlanningError:
            return 0.0

    def _best(
        self, table: ExampleTable, left: list[tuple[Example, str]]
    ) -> tuple[ExampleTable, list[tuple[Example, str]]] | None:
        """Return the table after the repair that leaves the fewest edges without a way back."""
        options: dict[_Repair, float] = {}
        for edge, way in left:
            guessed = {way} if way else self._reversals.guessed(edge)
            for name in [way] if way else self._ways(table, edge):
                doubt = 0.0 if name in guessed else _DOUBT
                options[_Repair(name, edge.target, edge.source)] = doubt
            options[_Repair(edge.operation, edge.source, None)] = _MARGIN
        found = []
        for one, doubt in options.items():
            heed()
            after = table.with_edge(one.operation, one.source, one.target)
            found.append((len(self._mismatches(after)), doubt, one, after))
        fewest = min(count for count, *_ in found)
        if fewest >= len(left):
            return None
        equal = [one for one in found if one[0] == fewest]
        if len(equal) > 1:
            equal.sort(key=lambda one: self._cost(one[2], one[3], table) + one[1])
            if table.count <= _SMALL:
                equal = sorted(
                    equal[:_COMPARED],
                    key=lambda one: _length(one[3]) * (1 + _LESS * (one[2].target is None)),
                )
        after = equal[0][3]
        return after, self._mismatches(after)

    def _cost(self, repair: _Repair, after: ExampleTable, before: ExampleTable) -> float:
        """Return how much longer the rule of an operation is after a repair."""
        own = after.edges[repair.operation]
        if not own:
            return 99
        cost = operation_cost(after, repair.operation)
        # Where each edge needs a case of its own, rules are always shorter without one.
        share = _SHARES * cost / len(own) if repair.target is None else 0
        return cost + share - operation_cost(before, repair.operation)

    def _mismatches(self, table: ExampleTable) -> list[tuple[Example, str]]:
        """Return the edges without an expected way back, and what should lead back."""
        back = backward(table)
        found = []
        for edge in table.all_edges():
            if edge.source == edge.target:
                continue
            heed()
            ways = back.get((edge.target, edge.source), ())
            expected = sorted(self._reversals.expected(edge, back))
            found += [(edge, one) for one in expected if one not in ways]
            if not expected and not ways:
                found.append((edge, ""))
        return found

    def _ways(self, table: ExampleTable, edge: Example) -> list[str]:
        """Return what could lead back: what leads from there to where nothing leads back from, and
        what is not there and gives elsewhere the values that are wanted."""
        back = backward(table)
        here, wanted = edge.target, edge.source
        change = [(digit, value) for digit, value in enumerate(wanted) if here[digit] != value]
        guessed = self._reversals.guessed(edge)
        found = []
        for operation, own in table.edges.items():
            heed()
            target = own.get(here)
            if target is not None:
                if target == here or (target, here) not in back:
                    found.append(operation)
            elif (
                operation in guessed
                or self._reversals.effect(Example(operation, here, wanted)) in self._effects
                or any(
                    all(source[d] != value and after[d] == value for d, value in change)
                    for source, after in own.items()
                )
            ):
                found.append(operation)
        return found

    def _without_odd(self, table: ExampleTable) -> ExampleTable:
        """Leave out edges that undo nothing as expected, if their rules are shorter then.

        A single edge that changes nothing, where all others change something, is odd by itself.
        """
        unchanging = [edge for edge in table.all_edges() if edge.source == edge.target]
        if len(unchanging) == 1:
            table = table.with_edge(unchanging[0].operation, unchanging[0].source, None)
        back, reversals = backward(table), Reversals(table)
        odd = []
        for edge in table.all_edges():
            own = table.edges[edge.operation]
            if len(own) < 3:
                continue
            if edge.source == edge.target:
                still = sum(source == target for source, target in own.items())
                if still <= _STILL * len(own):
                    odd.append(edge)
                continue
            ways = back.get((edge.target, edge.source), ())
            others = [Example(way, edge.target, edge.source) for way in ways]
            if not any(edge.operation in reversals.expected(one, back) for one in others):
                odd.append(edge)
        if len(odd) > most_mistakes(table):
            return table
        for edge in odd:
            after = table.with_edge(edge.operation, edge.source, None)
            try:
                gain = operation_cost(table, edge.operation) - operation_cost(after, edge.operation)
            except PlanningError:
                continue
            if gain > _GAIN:
                table = after
        return table


def _length(table: ExampleTable) -> float:
    """Return how long the rules of a whole table are for each of its edges. Where many edges need a
    case of their own, rules tell nothing about a single one, and every table is as long."""
    try:
        rules = learnt_rules(table)
    except PlanningError:
        return float(table.count)
    if _FEW * rules.cases > table.count:
        return 1.0
    return (rules.cost + 4 * rules.cases) / (100 * table.count)


def _done(edge: Example, exact: bool) -> Done:
    return tuple(
        (digit, edge.source[digit] if exact else "", value)
        for digit, value in enumerate(edge.target)
        if edge.source[digit] != value
    )


def _is_strange(table: ExampleTable, edge: Example) -> bool:
    """Return whether an edge changes other facts than the many other edges of its operation."""
    own = [
        {digit for digit, _, _ in _done(Example(edge.operation, source, target), False)}
        for source, target in table.edges[edge.operation].items()
        if source != edge.source
    ]
    changed = {digit for digit, _, _ in _done(edge, False)}
    return len(own) > _SEVERAL and all(changed.isdisjoint(one) for one in own)
