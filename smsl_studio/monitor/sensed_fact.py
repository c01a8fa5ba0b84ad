"""A fact that predicates decide, fed from the ledgers of its sources."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.predicates import FactSense
from smsl_studio.monitor.aggregate import SourceValue
from smsl_studio.monitor.decision import Decider
from smsl_studio.monitor.ledger import Ledger
from smsl_studio.monitor.measured import measure_of
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
        ages = {name: ledger.max_age for name, ledger, _ in self._read}
        self._decider = Decider(sense, ages)
        self._seen: dict[str, Sample | None] = dict.fromkeys(ages)

    def said(self, now: float, live: float) -> SourceValue:
        """Return the value of the fact, or None with the reason. ``live`` is the same instant on
        the monotonic clock, which counts if one source is elsewhere.
        """
        elsewhere = any(ledger.live for _, ledger, _ in self._read)
        clock, contested = (live if elsewhere else now), ""
        for name, ledger, position in self._read:
            sample, age, doubt = ledger.newest(now, live)
            if doubt:
                contested = contested or doubt
                self._seen[name] = None
                self._decider.take(name, None, clock, doubt)
            elif sample is not None and sample is not self._seen[name]:
                self._seen[name] = sample
                self._take(name, sample, position, clock - age)
        found = self._decider.look(clock)
        return SourceValue(DECIDED, found.value, found.reason, found.age, contested=bool(contested))

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
