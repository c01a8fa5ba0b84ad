"""Conditions of rules: formulas about the facts of one state, and counts of facts with a value."""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Mapping, Sequence

from smsl_studio.blueprint.properties.formula import (
    AllOf,
    AnyOf,
    FactTerm,
    Formula,
    Negation,
    StateTerm,
)
from smsl_studio.blueprint.properties.reading import read_formula
from smsl_studio.errors import FormulaError, did_you_mean

Values = tuple[str, ...]
Condition = Callable[[Values], bool]
Alphabets = Mapping[str, Sequence[str]]
"""The values of each fact, by its name, in the order of the facts."""

_COUNT = re.compile(
    r"\bcount\(\s*(?P<facts>[^()=!<>]*?)\s*=\s*(?P<value>'[^']*'|[^\s()]+)\s*\)"
    r"\s*(?P<sign><=|>=|!=|=|<|>)\s*(?P<number>\d{1,6})(?!\w)"
)
_SIGNS: Mapping[str, Callable[[int, int], bool]] = {
    "=": operator.eq, "!=": operator.ne, "<": operator.lt, "<=": operator.le, ">": operator.gt,
    ">=": operator.ge,
}  # fmt: skip
_MARK = "#count"


def condition(text: str, facts: Alphabets) -> Condition:
    """Return the function that decides a formula for the values of a state.

    A fact is named by its digit, its name, or its name in double quotes. ``count(FACT, FACT, ... =
    VALUE) OP N`` compares the number of these facts that have the value. FormulaError for a formula
    that cannot be read, an unknown fact, or a value that its fact does not have.
    """
    counts: list[Condition] = []

    def kept(found: re.Match[str]) -> str:
        """Put a term of its own in place of a count, as long as the count."""
        counts.append(_counted(found, facts))
        return f"'{_MARK}{len(counts) - 1}' = 1".ljust(len(found[0]))

    return _compiled(read_formula(_COUNT.sub(kept, text)), facts, counts)


def _compiled(formula: Formula, facts: Alphabets, counts: Sequence[Condition]) -> Condition:
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
            if formula.branch.startswith(_MARK):
                return counts[int(formula.branch.removeprefix(_MARK))]
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


def _counted(found: re.Match[str], facts: Alphabets) -> Condition:
    at = found.start()
    names = [name.strip().strip("'\"") for name in found["facts"].split(",")]
    digits = [
        int(name) if name.isdecimal() and name not in facts else _digit(name, facts, at)
        for name in names
    ]
    if any(digit >= len(facts) for digit in digits):
        raise FormulaError("a count names a fact that does not exist", at)
    value, compare = found["value"].strip("'"), _SIGNS[found["sign"]]
    for digit in digits:
        _check_value(list(facts)[digit], value, facts, at)
    number = int(found["number"])
    return lambda values: compare(sum(values[digit] == value for digit in digits), number)


def _digit(name: str, facts: Alphabets, at: int) -> int:
    names = list(facts)
    if name not in facts:
        near = did_you_mean(name, names) or f"There are {', '.join(names)}."
        raise FormulaError(f"there is no fact {name!r}", at, near)
    return names.index(name)


def _check_value(name: str, value: str, facts: Alphabets, at: int) -> None:
    if value not in facts[name]:
        known = ", ".join(facts[name])
        raise FormulaError(f"the fact {name} has no value {value!r}", at, f"It has {known}.")
