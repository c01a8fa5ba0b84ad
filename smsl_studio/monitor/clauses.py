"""Conditions of predicates as functions that look at the present measures.

All three truths count: a comparison with an unknown measure is unknown, and unknown is never true.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import dist, inf, isfinite
from operator import ge, gt, le, lt
from typing import Any

from smsl_studio.blueprint.predicates import FactSense, Unit
from smsl_studio.blueprint.predicates.measure import Measure
from smsl_studio.blueprint.predicates.predicate import unit_of
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
from smsl_studio.blueprint.predicates.units import SECOND
from smsl_studio.monitor.speaker import HAIR

Amount = Callable[[], float | None]
Truth = Callable[[], bool | None]


class PresentMeasure:
    """What one source measures: the measure that is ``present`` now, None if none counts, and the
    time (s) at which its newest ``good`` sample came. ``there`` says that the source exists.
    """

    __slots__ = ("good", "present", "there")

    def __init__(self, there: bool = True, good: float | None = None) -> None:
        self.there, self.good = there, good
        self.present: Measure | None = None


@dataclass(slots=True)
class Look:
    """What the conditions of a fact look at: its sources by their names, at ``now`` (s).

    ``began`` is the first look (s). ``former`` is the time of the look before, if it is so long ago
    that nothing is known between.
    """

    sources: Mapping[str, PresentMeasure]
    now: float = 0.0
    began: float | None = None
    former: float | None = None


def truth_of(clause: Clause, sense: FactSense, look: Look) -> Truth:
    """Return the function that tells whether a condition holds. It is called once for each look."""
    return _Clauses(sense, look).truth(clause)


class _Clauses:
    """Makes the functions of one predicate."""

    def __init__(self, sense: FactSense, look: Look) -> None:
        self._look, self._sources = look, look.sources
        self._units = sense.units

    def truth(self, clause: Clause) -> Truth:
        """Return the function of a condition."""
        match clause:
            case Threshold():
                return self._threshold(clause)
            case Opposite(part):
                return _opposite(self.truth(part))
            case Every(parts):
                return _every([self.truth(one) for one in parts])
            case Some(parts):
                return _some([self.truth(one) for one in parts])
            case Dwell(part, seconds):
                return _Watch(self._look, self.truth(part), seconds).truth

    def _threshold(self, one: Threshold) -> Truth:
        unit = unit_of(one.part, self._units)
        limit = float(Fraction(one.number) * one.unit.to(unit))
        if isinstance(one.part, SourceTerm):
            return _plainly_compared(self._sources[one.part.name], one.sign, limit)
        compared = _compared(self._amount(one.part, unit), one.sign, limit)
        if not isinstance(one.part, AgeTerm):
            return compared
        return self._waited(self._sources[one.part.name], compared, one.sign, limit)

    def _waited(self, source: PresentMeasure, compared: Truth, sign: str, limit: float) -> Truth:
        """The truth about an age. Before the first good sample the age is at least the time since
        the first look, because none came in that time."""

        look = self._look

        def truth() -> bool | None:
            """Compare the age, or the least that it can be."""
            if source.good is not None:
                return compared()
            if look.began is None or not source.there:
                return None
            waited = look.now - look.began
            beyond = waited > limit if sign in (">", "<=") else waited >= limit
            return (sign in (">", ">=")) if beyond else None

        return truth

    def _amount(self, part: Expression, unit: Unit) -> Amount:
        """Return a function that computes an expression in a unit."""
        match part:
            case SourceTerm(name):
                return _scaled(self._sources[name], self._scale(name, unit))
            case AgeTerm(name):
                return _age(self._look, self._sources[name], float(SECOND.to(unit)))
            case DistanceTerm(first, second):
                pair = self._sources[first.name], self._sources[second.name]
                scales = self._scale(first.name, unit), self._scale(second.name, unit)
                return _distance(pair, scales)
            case AbsTerm(inner):
                return _absolute(self._amount(inner, unit))
            case ExtremeTerm(parts, largest):
                return _extreme([self._amount(one, unit) for one in parts], largest)
            case SumTerm(left, right, minus):
                return _sum(self._amount(left, unit), self._amount(right, unit), minus)

    def _scale(self, name: str, unit: Unit) -> float:
        return float(self._units[name].to(unit))


class _Watch:
    """Whether a condition holds for a time (s) without a break, and is known to.

    It was false until ``_false_until``, and has had its present truth since ``_since``.
    """

    __slots__ = ("_false_until", "_look", "_part", "_seconds", "_since", "_truth")

    def __init__(self, look: Look, part: Truth, seconds: float) -> None:
        self._look, self._part, self._seconds = look, part, seconds
        self._truth: bool | None = None
        self._since = self._false_until = -inf

    def truth(self) -> bool | None:
        """Look at the condition now. True: it held for all of the time; false: it did not."""
        look, truth = self._look, self._part()
        now = look.now
        if look.former is not None:
            if self._truth is False:
                self._false_until = look.former
            self._truth = None
        if truth is not self._truth:
            if self._truth is False:
                self._false_until = now
            self._truth, self._since = truth, now
        if truth is False or now - self._false_until < self._seconds - HAIR:
            return False
        long = now - self._since >= self._seconds - HAIR
        return True if truth and long else None


def _scaled(source: Any, scale: float) -> Amount:
    def amount() -> float | None:
        """Return the number in another unit."""
        value = source.present
        return None if value is None else value * scale

    return amount


def _age(look: Look, source: PresentMeasure, scale: float) -> Amount:
    def amount() -> float | None:
        """Return the time since the newest good sample."""
        at = source.good
        return None if at is None else (look.now - at) * scale

    return amount


def _distance(pair: tuple[Any, Any], scales: tuple[float, float]) -> Amount:
    def amount() -> float | None:
        """Return the distance of the two positions."""
        one, other = pair[0].present, pair[1].present
        if one is None or other is None:
            return None
        found = dist([x * scales[0] for x in one], [x * scales[1] for x in other])
        return found if isfinite(found) else None

    return amount


def _absolute(part: Amount) -> Amount:
    def amount() -> float | None:
        """Return the number without its sign."""
        value = part()
        return None if value is None else abs(value)

    return amount


def _extreme(parts: list[Amount], largest: bool) -> Amount:
    choose = max if largest else min

    def amount() -> float | None:
        """Return the largest or the smallest number, if all are known."""
        values = [part() for part in parts]
        known = [value for value in values if value is not None]
        return choose(known) if len(known) == len(values) else None

    return amount


def _sum(left: Amount, right: Amount, minus: bool) -> Amount:
    def amount() -> float | None:
        """Return the sum or the difference, if both numbers are known."""
        one, other = left(), right()
        if one is None or other is None:
            return None
        found = one - other if minus else one + other
        return found if isfinite(found) else None

    return amount


def _compared(part: Amount, sign: str, limit: float) -> Truth:
    compare = _SIGNS[sign]

    def truth() -> bool | None:
        """Compare the number with its limit."""
        value = part()
        return None if value is None else compare(value, limit)

    return truth


_SIGNS = {"<": lt, "<=": le, ">": gt, ">=": ge}


def _plainly_compared(source: Any, sign: str, limit: float) -> Truth:
    """As ``_compared`` for the number of a source, in its own unit. Most conditions are such."""
    compare = _SIGNS[sign]

    def truth() -> bool | None:
        """Compare the newest number with its limit."""
        value = source.present
        return None if value is None else compare(value, limit)

    return truth


def _opposite(part: Truth) -> Truth:
    def truth() -> bool | None:
        """Return the other truth."""
        found = part()
        return None if found is None else not found

    return truth


def _every(parts: list[Truth]) -> Truth:
    def truth() -> bool | None:
        """Return false if one is false, true if all are true. All are asked, because some watch."""
        found = [part() for part in parts]
        return False if False in found else None if None in found else True

    return truth


def _some(parts: list[Truth]) -> Truth:
    def truth() -> bool | None:
        """Return true if one is true, false if all are false. All are asked."""
        found = [part() for part in parts]
        return True if True in found else None if None in found else False

    return truth
