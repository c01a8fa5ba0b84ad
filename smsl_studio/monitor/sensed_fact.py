"""A fact that predicates decide, fed from the ledgers of its sources."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.predicates import FactSense
from smsl_studio.blueprint.predicates.measure import measure_of
from smsl_studio.monitor.aggregate import Aggregate
from smsl_studio.monitor.decision import Decider
from smsl_studio.monitor.ledger import Ledger
from smsl_studio.monitor.sample import GOOD, Sample

DECIDED = "predicate"
"""The name under which the decision stands beside the answers of people."""


class SensedFact:
    """The decision about one fact, from the newest samples in the ledgers of its sources."""

    def __init__(self, sense: FactSense, ledgers: Mapping[str, Ledger]) -> None:
        positions = {one.name: one.position if one.valued else None for one in sense.sources}
        self._read = [
            (name, ledger, positions[name]) for name, ledger in ledgers.items() if name in positions
        ]
        self.sense = sense
        ages = {name: ledger.max_age for name, ledger, _ in self._read}
        self._decider = Decider(sense, ages)
        self._seen: dict[str, Sample | None] = dict.fromkeys(ages)
        self.newest: dict[str, Sample | None] = dict.fromkeys(ages)
        """The newest sample of each source at the last look, also an invalid or old one."""
        self.contested = False
        """Whether several programs spoke for one of its sources at the last look."""

    def decided(self, now: float, live: float) -> Aggregate:
        """Return the value of the fact, or None with the reason. It is called once for each look.

        ``live`` is the same instant on the monotonic clock, which counts if a source is elsewhere.
        """
        heard = [ledger.newest(now, live) for _, ledger, _ in self._read]
        clock = now
        for sample, _, _ in heard:
            if sample is not None and sample.received is not None:
                clock = live
        self.contested = False
        for (name, _, position), (sample, age, doubt) in zip(self._read, heard, strict=True):
            self.newest[name] = sample
            if doubt:
                self.contested = True
                self._seen[name] = None
                self._decider.take(name, None, clock, doubt)
            elif sample is not None and sample is not self._seen[name]:
                self._seen[name] = sample
                self._take(name, sample, position, clock - age)
        return self._decider.look(clock)

    def _take(self, name: str, sample: Sample, position: bool | None, at: float) -> None:
        if sample.value is None or sample.quality != GOOD:
            words = sample.reason or f"its reading is {sample.quality}"
            self._decider.take(name, None, at, words)
            return
        measure = measure_of(sample.value, position)
        if isinstance(measure, str):
            self._decider.take(name, None, at, measure)
        else:
            self._decider.take(name, measure, at)
