"""A fact on which no operation depends: where one edge alone depends on it, that edge is a mistake.

In the paper's registration the tool pose changes nothing about the landmarks. So an operation of
the landmarks that is there with the pose and not without it was forgotten.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from smsl_studio.generate.examples.reversals import backward
from smsl_studio.generate.examples.rule_search import operation_cost
from smsl_studio.generate.examples.table import ExampleTable, Values
from smsl_studio.stop import heed

_FEWEST_AGREEING = 8
_MOST_DEVIATING = 2
_PAIRED, _ALIKE = 1.5, 3.0


class _Deviation(NamedTuple):
    """States that differ in one fact only, in which an operation does not do the same."""

    digit: int
    operation: str
    states: tuple[Values, ...]
    own: bool = False


def independent(table: ExampleTable) -> ExampleTable:
    """Return the table in which the facts that seem independent are."""
    found: list[_Deviation] = []
    facts: list[int] = []
    for digit in range(len(table.start)):
        agreeing, deviating = _compared(table, digit)
        if agreeing >= _FEWEST_AGREEING and len(deviating) <= _MOST_DEVIATING:
            facts.append(digit)
            found += deviating
    for one in found:
        table = _agreed(table, one, facts)
    return table


def _compared(table: ExampleTable, digit: int) -> tuple[int, list[_Deviation]]:
    """Return in how many groups of states the operations do the same, and in which they do not.

    An operation of the fact itself should do the same whatever the other facts are, any other
    operation whatever this fact is.
    """
    agreeing = 0
    deviating: list[_Deviation] = []
    groups = _groups(table, lambda values: values[:digit] + values[digit + 1 :])
    own_groups = _groups(table, lambda values: (values[digit],))
    for operation, own in table.edges.items():
        heed()
        present = [states for states in groups if any(one in own for one in states)]
        if not present:
            continue
        different = [
            states for states in present if len({_effect(own, one, digit) for one in states}) > 1
        ]
        if len(different) > 1 and 2 * len(different) >= len(present):
            present = [states for states in own_groups if any(one in own for one in states)]
            different = [
                states
                for states in present
                if len({_effect_on(own, one, digit) for one in states}) > 1
            ]
            deviating += [_Deviation(digit, operation, one, own=True) for one in different]
            agreeing += sum(len(one) for one in present) - len(different)
        else:
            deviating += [_Deviation(digit, operation, one) for one in different]
            agreeing += len(present) - len(different)
    return agreeing, deviating


def _groups(table: ExampleTable, same: Callable[[Values], Values]) -> list[tuple[Values, ...]]:
    """Return the states in groups of those that have something in common, if there are two."""
    found: dict[Values, list[Values]] = defaultdict(list)
    for values in table.states:
        found[same(values)].append(values)
    return [tuple(states) for states in found.values() if len(states) > 1]


def _effect_on(own: Mapping[Values, Values], source: Values, digit: int) -> Values | None:
    """Return the value that an operation gives to its own fact. Other facts should stay."""
    target = own.get(source)
    if target is None:
        return None
    stays = target[:digit] + target[digit + 1 :] == source[:digit] + source[digit + 1 :]
    return (target[digit],) if stays else (target[digit], *target)


def _effect(own: Mapping[Values, Values], source: Values, digit: int) -> Values | None:
    """Return the values to which an operation leads, those of the fact marked if it stays."""
    target = own.get(source)
    if target is None:
        return None
    kept = "" if target[digit] == source[digit] else target[digit]
    return (*target[:digit], kept, *target[digit + 1 :])


def _agreed(table: ExampleTable, deviation: _Deviation, facts: Sequence[int]) -> ExampleTable:
    """Return the table in which an operation does the same in all of these states."""
    if deviation.own:
        return _outvoted(table, deviation)
    digit, operation, states, _ = deviation
    own = table.edges[operation]
    partners = _partners(table, operation)
    effects = [_effect(own, one, digit) for one in states]
    before = sum(len(_compared(table, one)[1]) for one in facts)
    options = []
    for effect in dict.fromkeys(effects):
        after = table
        changed = sum(one != effect for one in effects)
        for state, now in zip(states, effects, strict=True):
            if now != effect:
                after = after.with_edge(operation, state, _applied(effect, state, digit))
        if not after.edges[operation]:
            continue
        if any(target not in table.names for target in after.edges[operation].values()):
            continue
        if sum(len(_compared(after, one)[1]) for one in facts) >= before:
            continue
        if len(own) == 1 and not _fits(after, operation, partners):
            continue
        options.append((changed, _cost(after, operation), effect is None, after))
    return min(options, key=lambda one: one[:3])[-1] if options else table


def _cost(table: ExampleTable, operation: str) -> float:
    """Return how much there is to say against a table: a long rule, edges without a way back, and
    two operations that do the same."""
    back = backward(table)
    paired = sum((edge.target, edge.source) in back for edge in table.all_edges())
    own = set(table.edges[operation].items())
    alike = max(
        (
            len(own & set(other.items())) / len(own | set(other.items()))
            for name, other in table.edges.items()
            if name != operation
        ),
        default=0.0,
    )
    return operation_cost(table, operation) - _PAIRED * paired + _ALIKE * alike


def _outvoted(table: ExampleTable, deviation: _Deviation) -> ExampleTable:
    """Return the table in which an operation does what it does in most of these states."""
    digit, operation, states, _ = deviation
    own = table.edges[operation]
    effects = [_effect_on(own, one, digit) for one in states]
    effect = max(dict.fromkeys(effects), key=effects.count)
    if (effect is not None and len(effect) > 1) or effects.count(effect) < 3:
        return table
    after = table
    for state, now in zip(states, effects, strict=True):
        if now != effect:
            target = None
            if effect is not None:
                target = (*state[:digit], effect[0], *state[digit + 1 :])
                if target not in table.names:
                    return table
            after = after.with_edge(operation, state, target)
    return after


def _applied(effect: Values | None, state: Values, digit: int) -> Values | None:
    if effect is None:
        return None
    return (*effect[:digit], effect[digit] or state[digit], *effect[digit + 1 :])


def _partners(table: ExampleTable, operation: str) -> set[str]:
    """Return the operations that undo an edge of an operation."""
    back = backward(table)
    return {
        way
        for source, target in table.edges[operation].items()
        if source != target
        for way in back.get((target, source), ())
    }


def _fits(table: ExampleTable, operation: str, partners: set[str]) -> bool:
    """Return whether all edges of an operation change nothing, or all are undone."""
    own = table.edges[operation]
    return all(source == target for source, target in own.items()) or (
        _undone(table, operation, partners) == len(own)
    )


def _undone(table: ExampleTable, operation: str, partners: set[str]) -> int:
    """Return how many edges of an operation its partners undo."""
    return sum(
        any(table.edges[way].get(target) == source for way in partners)
        for source, target in table.edges[operation].items()
    )
