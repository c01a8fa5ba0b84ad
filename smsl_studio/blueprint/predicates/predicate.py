"""Predicates with their meaning: the sources they name, and whether the units fit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from smsl_studio.blueprint.predicates.predicate_text import written_source
from smsl_studio.blueprint.predicates.terms import (
    AbsTerm,
    AgeTerm,
    Clause,
    DistanceTerm,
    Dwell,
    Every,
    Expression,
    ExtremeTerm,
    Opposite,
    Some,
    SourceTerm,
    SumTerm,
    Threshold,
)
from smsl_studio.blueprint.predicates.units import SECOND, Unit
from smsl_studio.errors import FormulaError, did_you_mean


@dataclass(frozen=True, slots=True)
class ValuePredicate:
    """The condition under which a fact has one value, and its text."""

    value: str
    text: str
    clause: Clause


def thresholds_of(clause: Clause) -> Iterator[Threshold]:
    """Yield the comparisons of a condition in the order of the text."""
    match clause:
        case Threshold():
            yield clause
        case Dwell(part) | Opposite(part):
            yield from thresholds_of(part)
        case Every(parts) | Some(parts):
            for part in parts:
                yield from thresholds_of(part)


def names_of(part: Expression) -> Iterator[SourceTerm | AgeTerm]:
    """Yield the sources that an expression names, in the order of the text."""
    match part:
        case SourceTerm() | AgeTerm():
            yield part
        case DistanceTerm(first, second):
            yield first
            yield second
        case AbsTerm(inner):
            yield from names_of(inner)
        case ExtremeTerm(parts):
            for one in parts:
                yield from names_of(one)
        case SumTerm(left, right):
            yield from names_of(left)
            yield from names_of(right)


def positions_of(clause: Clause) -> Iterator[str]:
    """Yield the sources that a condition uses as positions."""
    for threshold in thresholds_of(clause):
        yield from _positions(threshold.part)


def numbers_of(clause: Clause) -> Iterator[str]:
    """Yield the sources that a condition uses as numbers."""
    for threshold in thresholds_of(clause):
        places = set(_positions(threshold.part))
        for one in names_of(threshold.part):
            if isinstance(one, SourceTerm) and one.name not in places:
                yield one.name


def check_units(clause: Clause, sources: Mapping[str, Unit]) -> None:
    """Check that a condition names sources only, and that all its units fit. FormulaError if not.

    The sentence says the character at which it does not fit, and the advice a remedy.
    """
    for threshold in thresholds_of(clause):
        for one in names_of(threshold.part):
            if one.name not in sources:
                known = ", ".join(map(written_source, sources)) or "none"
                near = did_you_mean(one.name, sources) or f"The sources are: {known}."
                raise FormulaError(f"{one.name!r} is no source of this fact", one.at, near)
        unit = unit_of(threshold.part, sources)
        if not threshold.unit.fits(unit):
            raise FormulaError(
                f"{threshold.number} {threshold.unit.text} is compared with {_measured(unit)}",
                threshold.at,
                "Write the number without a unit."
                if unit.text == "1"
                else f"Write the number in {unit.text}, or in another unit of its kind.",
            )


def _measured(unit: Unit) -> str:
    return "a count, which has no unit" if unit.text == "1" else f"a measure in {unit.text}"


def unit_of(part: Expression, sources: Mapping[str, Unit]) -> Unit:
    """Return the unit in which an expression is computed: that of the first source it names.

    FormulaError if its parts are of several kinds.
    """
    match part:
        case AgeTerm():
            return SECOND
        case SourceTerm(name):
            return sources[name]
        case AbsTerm(inner):
            return unit_of(inner, sources)
        case DistanceTerm(left, right) | SumTerm(left, right):
            return _common(left, right, sources)
        case ExtremeTerm(parts):
            for one in parts[1:]:
                _common(parts[0], one, sources)
            return unit_of(parts[0], sources)


def _common(left: Expression, right: Expression, sources: Mapping[str, Unit]) -> Unit:
    first, second = unit_of(left, sources), unit_of(right, sources)
    if not first.fits(second):
        name = next(names_of(right))
        raise FormulaError(
            f"a measure in {second.text} stands beside one in {first.text}",
            name.at,
            "Only measures of one kind can be added, compared or put together.",
        )
    return first


def _positions(part: Expression) -> Iterator[str]:
    match part:
        case DistanceTerm(first, second):
            yield first.name
            yield second.name
        case AbsTerm(inner):
            yield from _positions(inner)
        case ExtremeTerm(parts):
            for one in parts:
                yield from _positions(one)
        case SumTerm(left, right):
            yield from _positions(left)
            yield from _positions(right)
