"""Conditions of rules: formulas about the facts of one state, and counts of facts with a value."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence

from smsl_studio.blueprint.properties.formula import (
    AllOf,
    AnyOf,
    FactTerm,
    Formula,
    Negation,
    StateTerm,
)
from smsl_studio.blueprint.properties.formula_text import read_formula
from smsl_studio.errors import FormulaError, did_you_mean, instead_of
from smsl_studio.generate.rule_counts import Count, without_counts

Values = tuple[str, ...]
Condition = Callable[[Values], bool]
Alphabets = Mapping[str, Sequence[str]]
"""The values of each fact, by its name, in the order of the facts."""

_SIGNS: Mapping[str, Callable[[int, int], bool]] = {
    "=": operator.eq, "!=": operator.ne, "<": operator.lt, "<=": operator.le, ">": operator.gt,
    ">=": operator.ge,
}  # fmt: skip


def condition(text: str, facts: Alphabets) -> Condition:
    """Return the function that decides a formula for the values of a state.

    A fact is named by its digit, its name, or its name in double quotes. ``count(FACT, FACT, ... =
    VALUE) OP N`` compares the number of these facts that have the value. FormulaError for a formula
    that cannot be read, an unknown fact, or a value that its fact does not have.
    """
    plain, found = without_counts(text)
    formula = read_formula(plain)
    counts = {at: _counted(count, at, facts) for at, count in found.items()}
    return _compiled(formula, facts, counts)


def _compiled(formula: Formula, facts: Alphabets, counts: Mapping[int, Condition]) -> Condition:
    match formula:
        case AllOf(parts):
            every = [_compiled(part, facts, counts) for part in parts]
            return lambda values: all(one(values) for one in every)
        case AnyOf(parts):
            some = [_compiled(part, facts, counts) for part in parts]
            return lambda values: any(one(values) for one in some)
        case Negation(part):
            inner = _compiled(part, facts, counts)
            return lambda values: not inner(values)
        case StateTerm():
            raise FormulaError(
                "rules know facts and no states", formula.at, "Write FACT = VALUE instead."
            )
        case FactTerm():
            if formula.at in counts:
                return counts[formula.at]
            name = formula.name or formula.branch
            digit = formula.digit if formula.digit is not None else _digit(name, facts, formula.at)
            return _compared(digit, formula, facts)


def _compared(digit: int, term: FactTerm, facts: Alphabets) -> Condition:
    names = list(facts)
    if digit >= len(names):
        raise FormulaError(f"there is no fact {digit}", term.at, f"There are {len(names)}, from 0.")
    value = term.value
    _check_value(names[digit], value, facts, term.at)
    if term.equal:
        return lambda values: values[digit] == value
    return lambda values: values[digit] != value


def _counted(count: Count, at: int, facts: Alphabets) -> Condition:
    names = list(facts)
    places = {name: digit for digit, name in enumerate(names)}
    digits: list[int] = []
    for fact in count.facts:
        if isinstance(fact, str):
            digit = places[fact] if fact in places else _digit(fact, facts, at)
        else:
            digit = fact
        if digit >= len(names):
            raise FormulaError(f"there is no fact {digit}", at, f"There are {len(names)}, from 0.")
        _check_value(names[digit], count.value, facts, at)
        digits.append(digit)
    value, compare, number = count.value, _SIGNS[count.sign], count.number
    return lambda values: compare(sum(values[digit] == value for digit in digits), number)


def _digit(name: str, facts: Alphabets, at: int) -> int:
    names = list(facts)
    if name not in facts:
        near = did_you_mean(name, names) or f"There are {', '.join(names)}."
        instead = instead_of(name, names)
        raise FormulaError(f"there is no fact {name!r}", at, near, instead=instead)
    return names.index(name)


def _check_value(name: str, value: str, facts: Alphabets, at: int) -> None:
    if value not in facts[name]:
        known = ", ".join(facts[name])
        raise FormulaError(
            f"the fact {name} has no value {value!r}", at, f"It has {known}.",
            instead=instead_of(value, facts[name]),
        )  # fmt: skip
