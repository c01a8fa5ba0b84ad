"""Conditions of rules: formulas about the facts of one state, and counts of facts with a value."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

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
Alphabets = Mapping[str, Sequence[str]]
"""The values of each fact, by its name, in the order of the facts."""


@dataclass(frozen=True, slots=True)
class Has:
    """A fact, by its digit, has a value, or, if not ``equal``, has another one."""

    digit: int
    value: str
    equal: bool


@dataclass(frozen=True, slots=True)
class Counted:
    """The number of facts that have a value lies between two bounds, or, if ``odd``, not."""

    digits: tuple[int, ...]
    value: str
    low: int
    high: int
    odd: bool


@dataclass(frozen=True, slots=True)
class Not:
    """A part does not hold."""

    part: Condition


@dataclass(frozen=True, slots=True)
class EveryPart:
    """EveryPart part holds."""

    parts: tuple[Condition, ...]


@dataclass(frozen=True, slots=True)
class SomePart:
    """A part holds."""

    parts: tuple[Condition, ...]


Condition = Has | Counted | Not | EveryPart | SomePart
"""A condition with its facts looked up. ``rule_circuit`` decides it."""


def condition(text: str, facts: Alphabets) -> Condition:
    """Return a formula with its facts looked up.

    A fact is named by its digit, its name, or its name in double quotes. ``count(FACT, FACT, ... =
    VALUE) OP N`` compares the number of these facts that have the value. FormulaError for a formula
    that cannot be read, an unknown fact, or a value that its fact does not have.
    """
    plain, found = without_counts(text)
    formula = read_formula(plain)
    counts = {at: _counted(count, at, facts) for at, count in found.items()}
    return _looked_up(formula, facts, counts)


def _looked_up(formula: Formula, facts: Alphabets, counts: Mapping[int, Condition]) -> Condition:
    match formula:
        case AllOf(parts):
            return EveryPart(tuple(_looked_up(part, facts, counts) for part in parts))
        case AnyOf(parts):
            return SomePart(tuple(_looked_up(part, facts, counts) for part in parts))
        case Negation(part):
            return Not(_looked_up(part, facts, counts))
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
    return Has(digit, value, term.equal)


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
    low, high, odd = _bounds(count.sign, count.number, len(digits))
    return Counted(tuple(digits), count.value, low, high, odd)


def _bounds(sign: str, number: int, most: int) -> tuple[int, int, bool]:
    """Return between which bounds a number from 0 to ``most`` lies where a comparison holds, and
    whether it is outside instead. An upper bound below the lower one never holds."""
    if number > most:
        # Whatever the exact number, it is never reached.
        number = most + 1
    if sign in ("=", "!="):
        return number, number, sign == "!="
    if sign in ("<", "<="):
        # Nothing is below 0, so the bounds are turned round.
        return number + (sign == "<="), most, True
    return number + (sign == ">"), most, False


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
