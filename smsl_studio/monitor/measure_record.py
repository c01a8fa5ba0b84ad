"""What the log of a run keeps of the measures: enough to see why each fact is what it is."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from math import isfinite

from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.predicates.measure import measure_of
from smsl_studio.monitor.sample import BAD, Sample
from smsl_studio.monitor.sensed_fact import SensedFact
from smsl_studio.monitor.speaker import HAIR

LARGEST = 2.0**53
"""Times of sources that a log can keep are smaller than this (s)."""


class MeasureRecord:
    """Chooses the samples to keep: all new ones of a fact whose value changes, and those of every
    fact as often as its ``log_rate`` says.

    A sample is kept once. The times are those of the run (s).
    """

    def __init__(self, facts: Mapping[FactKey, SensedFact]) -> None:
        self._facts = facts
        self._periods = {key: 1.0 / one.sense.log_rate for key, one in facts.items()}
        self._due = dict.fromkeys(facts, 0.0)
        self._next = 0.0
        self._kept: dict[tuple[FactKey, str], Sample] = {}

    def keep(self, changed: Collection[FactKey], now: float) -> Iterator[Sample]:
        """Yield the samples to keep at ``now``, where the values of some facts have changed."""
        every = now >= self._next - HAIR
        if not every and not changed:
            return
        for key in self._facts if every else changed:
            fact = self._facts.get(key)
            if fact is None or (now < self._due[key] - HAIR and key not in changed):
                continue
            self._due[key] = now + self._periods[key]
            yield from self._new(key, fact)
        self._next = min(self._due.values(), default=0.0)

    def newest(self) -> dict[tuple[FactKey, str], tuple[float, ...]]:
        """Return the last number of each source that was kept, or three for a position."""
        found: dict[tuple[FactKey, str], tuple[float, ...]] = {}
        for place, sample in self._kept.items():
            measure = None if sample.value is None else measure_of(sample.value, None)
            if isinstance(measure, float):
                found[place] = (measure,)
            elif isinstance(measure, tuple):
                found[place] = measure
        return found

    def _new(self, key: FactKey, fact: SensedFact) -> Iterator[Sample]:
        """Yield the samples of a fact that were not kept yet, as far as they measure something."""
        for name, sample in fact.newest.items():
            if sample is None or self._kept.get((key, name)) is sample:
                continue
            self._kept[key, name] = sample
            time = sample.time if isfinite(sample.time) and abs(sample.time) < LARGEST else 0.0
            measure = None if sample.value is None else measure_of(sample.value, None)
            if isinstance(measure, str):
                # It has no number, so its words are the reason and not the value.
                yield sample._replace(value=None, time=time, quality=BAD, reason=measure)
            else:
                yield sample._replace(time=time)
