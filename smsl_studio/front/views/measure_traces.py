"""What a plot of the sources of a fact shows: the last 30 s of each, and its thresholds."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import takewhile
from math import isfinite, isnan, nan
from typing import NamedTuple

from smsl_studio.blueprint.address import fact_text
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.notation import notation_of
from smsl_studio.blueprint.predicates import FactSense
from smsl_studio.blueprint.predicates.measure import measure_of
from smsl_studio.blueprint.predicates.predicate import thresholds_of
from smsl_studio.blueprint.predicates.terms import AbsTerm, SourceTerm, Threshold
from smsl_studio.runlog.history import Measures, RunHistory

SPAN = 30.0
"""The time (simulated s) that a plot shows."""
AXES = ("x", "y", "z")
STAYS = 1.0
"""How long (s) a measure stays in a plot if the fact has no ``max_age``."""
Kept = tuple[float, str | None, str]


class PlotMoment(NamedTuple):
    """The time of a plot, and how long a measure stays there until the next one (simulated s)."""

    now: float
    stays: float


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


@dataclass(frozen=True)
class MeasuredFact:
    """A fact that measures decide, at ``now`` (simulated s): its name, the traces of its sources,
    its values as they were (from, to and value; ``?`` is unknown), and the notation of the paper.
    """

    key: FactKey
    name: str
    now: float
    traces: tuple[MeasureTrace, ...]
    values: tuple[tuple[float, float, str], ...]
    notation: tuple[str, ...]


def measured_of(
    blueprint: Blueprint, fact: FactKey, history: RunHistory, now: float
) -> MeasuredFact | None:
    """Return what decided a fact in the last 30 s before ``now``; None if no predicates do."""
    traces = traces_of(blueprint, fact, history, now)
    if not traces:
        return None
    spans = history.facts.get(fact, ())
    values = tuple(
        (max(one.start, now - SPAN), min(one.end if one.end is not None else now, now), one.words)
        for one in spans
        if one.start <= now and (one.end is None or one.end >= now - SPAN)
    )
    name = blueprint[fact[0]].fact_name(fact[1])
    return MeasuredFact(fact, name, now, traces, values, notation_of(blueprint, fact_text(*fact)))


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
    note = branch.fact_note(fact[1]) if branch is not None else None
    stays = max(note.max_age if note and note.max_age else STAYS, 2 / sense.log_rate)
    return tuple(
        _trace(
            sense, at, history.measures.get((fact, one.name), Measures()), PlotMoment(now, stays)
        )
        for at, one in enumerate(sense.sources)
    )


def _trace(sense: FactSense, at: int, kept: Measures, moment: PlotMoment) -> MeasureTrace:
    spec = sense.sources[at]
    seen = list(_with_gaps(_lately(kept, moment.now), moment))
    many = 3 if spec.position else 1
    points = [_numbers(value, many) for _, value, _ in seen]
    lines = tuple(tuple(point[axis] for point in points) for axis in range(many))
    times = tuple(time for time, _, _ in seen)
    missing = seen[-1][2] if seen and seen[-1][1] is None else ""
    lines_at = tuple(_thresholds(sense, spec.name))
    return MeasureTrace(spec.name, spec.unit.text, times, lines, lines_at, missing)


def _lately(kept: Measures, now: float) -> Iterator[Kept]:
    """Yield the measures of the last 30 s before ``now`` in order of time."""
    newest = takewhile(lambda one: one[0] >= now - SPAN, reversed(kept))
    yield from reversed([one for one in newest if one[0] <= now])


def _with_gaps(seen: Iterable[Kept], moment: PlotMoment) -> Iterator[Kept]:
    """Yield measures, and one without a number where the next one comes too late."""
    before: Kept | None = None
    for one in (*seen, None):
        time = moment.now if one is None else one[0]
        if before is not None and before[1] is not None and time - before[0] > moment.stays:
            words = f"no reading for {time - before[0]:.1f} s"
            yield before[0] + moment.stays, None, words
        if one is not None:
            yield one
        before = one


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
