"""A fact that predicates decide, fed from the ledgers of its sources."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.check import Reading
from smsl_studio.blueprint.predicates import FactSense
from smsl_studio.monitor.decision import Decider
from smsl_studio.monitor.ledger import Ledger
from smsl_studio.monitor.sample import Sample

DECIDED = "predicate"
"""The name under which the decision stands beside the answers of people."""


class SensedFact:
    """The decision about one fact, from the newest samples in the ledgers of its sources."""

    __slots__ = ("_decider", "_feeds", "_newest", "contested", "sense")

    def __init__(self, sense: FactSense, ledgers: Mapping[str, Ledger]) -> None:
        names = {one.name for one in sense.sources}
        known = {name: ledger for name, ledger in ledgers.items() if name in names}
        self.sense = sense
        self._decider = Decider(sense, {name: one.max_age for name, one in known.items()})
        self._feeds = tuple((self._decider.heard[name], one) for name, one in known.items())
        self._newest: Mapping[str, Sample | None] | None = None
        """The newest samples of the last look, None if they are those that were taken."""
        self.contested = False
        """Whether several programs spoke for one of its sources at the last look."""

    @property
    def newest(self) -> Mapping[str, Sample | None]:
        """The newest sample of each source at the last look, also an invalid or old one."""
        if self._newest is not None:
            return self._newest
        return {one.spec.name: one.sample for one, _ in self._feeds}

    def decided(self, now: float, live: float) -> Reading:
        """Return the value of the fact, or None with the reason. It is called once for each look.

        ``live`` is the same instant on the monotonic clock, which counts if a source is elsewhere.
        """
        clock = now
        for _, ledger in self._feeds:
            speaker = ledger.only
            if speaker is None or speaker.over:
                return self._weighed(now, live)
            if speaker.live:
                clock = live
        self.contested, self._newest = False, None
        oldest = 0.0
        for heard, ledger in self._feeds:
            speaker = ledger.only
            if speaker is not None and speaker.sample is not heard.sample:
                heard.take(speaker.sample, clock - speaker.read_age(now, live))
            oldest = max(oldest, heard.count(clock))
        return self._decider.look(clock, oldest)

    def _weighed(self, now: float, live: float) -> Reading:
        """Decide as ``decided`` does, where a source has not one speaker."""
        newest = [ledger.newest(now, live) for _, ledger in self._feeds]
        elsewhere = any(one is not None and one.received is not None for one, _, _ in newest)
        clock = live if elsewhere else now
        self.contested = False
        oldest = 0.0
        for (heard, _), (sample, age, doubt) in zip(self._feeds, newest, strict=True):
            if doubt:
                self.contested = True
                heard.doubt(doubt, clock)
            elif sample is not None and sample is not heard.sample:
                heard.take(sample, clock - age)
            oldest = max(oldest, heard.count(clock))
        pairs = zip(self._feeds, newest, strict=True)
        self._newest = {heard.spec.name: sample for (heard, _), (sample, _, _) in pairs}
        return self._decider.look(clock, oldest)
