"""What a plot of the sources of a fact shows: the last 30 s of each, and its thresholds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import isfinite, isnan, nan

from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.predicates import FactSense
from smsl_studio.blueprint.predicates.measure import measure_of
from smsl_studio.blueprint.predicates.predicate import thresholds_of
from smsl_studio.blueprint.predicates.terms import AbsTerm, SourceTerm, Threshold
from smsl_studio.runlog.history import Measures, RunHistory

SPAN = 30.0
"""The time (simulated s) that a plot shows."""
AXES = ("x", "y", "z")


@dataclass(frozen=True)
class ThresholdLine:
    """A number in the unit of the source at which a predicate decides, and its words, such as
    ``1 if > 2 N``.
    """

    at: float
    words: str


@dataclass(frozen=True)
class MeasureTrace:
    """One source of a fact. ``lines`` has a line of points for a number, and three for a position.

    Times are simulated seconds. A value that is not a number breaks a line, because nothing was
    measured then; ``missing`` is the reason if this is so now.
    """

    source: str
    unit: str
    times: tuple[float, ...]
    lines: tuple[tuple[float, ...], ...]
    thresholds: tuple[ThresholdLine, ...]
    missing: str = ""

    @property
    def newest(self) -> str:
        """The newest measure in words."""
        last = [line[-1] for line in self.lines if line]
        if not last or any(map(isnan, last)):
            return self.missing or "nothing measured"
        unit = "" if self.unit == "1" else f" {self.unit}"
        return ", ".join(f"{value:.4g}" for value in last) + unit


def traces_of(
    blueprint: Blueprint, fact: FactKey, history: RunHistory, now: float
) -> tuple[MeasureTrace, ...]:
    """Return what each source of a fact has measured in the last 30 s before ``now`` (simulated s).

    Empty if no predicates decide the fact.
    """
    branch = blueprint.branches.get(fact[0])
    sense = branch.notes.senses.get(fact[1]) if branch is not None else None
    if sense is None or sense.fault is not None:
        return ()
    return tuple(
        _trace(sense, at, history.measures.get((fact, one.name), Measures()), now)
        for at, one in enumerate(sense.sources)
    )


def _trace(sense: FactSense, at: int, kept: Measures, now: float) -> MeasureTrace:
    spec = sense.sources[at]
    seen = [one for one in kept if one[0] >= now - SPAN]
    many = 3 if spec.position else 1
    points = [_numbers(value, many) for _, value, _ in seen]
    lines = tuple(tuple(point[axis] for point in points) for axis in range(many))
    times = tuple(time for time, _, _ in seen)
    missing = seen[-1][2] if seen and seen[-1][1] is None else ""
    lines_at = tuple(_thresholds(sense, spec.name))
    return MeasureTrace(spec.name, spec.unit.text, times, lines, lines_at, missing)


def _numbers(value: str | None, many: int) -> tuple[float, ...]:
    """Return a measure as numbers, each NaN if there is none."""
    measure = None if value is None else measure_of(value, many == 3)
    if isinstance(measure, tuple):
        return measure
    return (measure,) if isinstance(measure, float) else (nan,) * many


def _thresholds(sense: FactSense, source: str) -> Iterator[ThresholdLine]:
    """Yield the numbers with which predicates compare the source itself, or its absolute value."""
    unit = sense.units[source]
    for predicate in sense.predicates:
        for one in thresholds_of(predicate.clause):
            both = isinstance(one.part, AbsTerm)
            part = one.part.part if isinstance(one.part, AbsTerm) else one.part
            if not isinstance(part, SourceTerm) or part.name != source:
                continue
            for sign in (1, -1) if both else (1,):
                at = sign * float(Fraction(one.number) * one.unit.to(unit))
                if isfinite(at):
                    yield ThresholdLine(at, f"{predicate.value} if {_words(one)}")


def _words(one: Threshold) -> str:
    unit = "" if one.unit.text == "1" else f" {one.unit.text}"
    return f"{one.sign} {one.number}{unit}"
