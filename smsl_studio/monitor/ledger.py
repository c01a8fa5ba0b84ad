"""The ledger of one source: its newest sample, when it came, and what of it did not count.

A fact ages on the receiver's clock, from the moment a sample was taken in. Repeated, retained and
overtaken samples do not have a growing (boot, sequence) and refresh nothing. Neither does a late
one, which was held up on its way for longer than its fact may be old: the clocks of source and
receiver need not agree, so a sample is late by how much longer it took than the quickest of its
boot.
"""

from __future__ import annotations

from math import inf, isfinite

from smsl_studio.monitor.aggregate import Said
from smsl_studio.monitor.sample import GOOD, Sample

HAIR = 1e-9
"""Ages are sums of ticks: this much (s) beyond the maximum is still not too old."""

CREEP = 1e-3
"""A source's clock may be slow by one part in a thousand without its samples seeming late."""


class Ledger:
    """What one source said last of one fact, and how it came.

    ``received`` is on the receiver's clock: that of the run, and where the source is elsewhere
    (``live``) the monotonic one, on which it came. ``latency`` is beyond the quickest way seen.
    ``counted``, ``repeated`` (late in sequence, too) and ``late`` are how many samples came.
    """

    def __init__(self, name: str, max_age: float) -> None:
        self.name = name
        self.max_age = max_age
        self.sample: Sample | None = None
        self.received = 0.0
        self.live = False
        self.latency = 0.0
        self.counted = self.repeated = self.late = 0
        self._order = (0, 0)
        self._quickest = inf

    def take(self, sample: Sample, now: float) -> None:
        """Take a sample in, if it is newer than all before and came in time.

        It came at ``now`` (s), or when it says itself that it was received.
        """
        if sample.received is not None:
            now = sample.received
        before, order = self.sample, (sample.boot, sample.sequence)
        if before is not None and order <= self._order:
            self.repeated += 1
            return
        self._order = order
        quickest, latency = inf, 0.0
        if before is not None and before.boot == sample.boot:
            quickest = self._quickest + CREEP * (now - self.received)
        if isfinite(sample.time):
            way = now - sample.time
            quickest = way if way < quickest else quickest
            latency = way - quickest
        if latency > self.max_age + HAIR:
            self.late += 1
            return
        self.sample, self.received, self.live = sample, now, sample.received is not None
        self.latency, self._quickest = latency, quickest
        self.counted += 1

    def says_now(self, now: float) -> bool:
        """Whether its newest sample came at this very moment and is evidence."""
        sample = self.sample
        return (
            sample is not None
            and self.received == now
            and not self.live
            and sample.value is not None
            and sample.quality == GOOD
        )

    def said(self, now: float, live: float = 0.0) -> Said:
        """What it says as things stand at ``now``, or ``live`` on the monotonic clock: its value,
        or nothing with the reason."""
        sample = self.sample
        if sample is None:
            return Said(self.name, None, "no reading yet", now)
        # A sample may come in after the clock was read.
        age = max(0.0, live - self.received) if self.live else now - self.received
        if age > self.max_age + HAIR:
            return Said(self.name, None, f"no reading for {age:.1f} s", age)
        if sample.value is None:
            return Said(self.name, None, sample.reason or "no valid reading", age)
        if sample.quality != GOOD:
            reason = sample.reason or f"its reading is {sample.quality}"
            return Said(self.name, None, reason, age)
        return Said(self.name, sample.value, "", age)
