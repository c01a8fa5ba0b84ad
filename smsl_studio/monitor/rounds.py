"""Rounds of sensors: while nothing is unusual, a whole round is one step of the monitor.

Nearly all samples of a run come so: every sensor is read at a tick, and each sample is simply the
next one of its source. Then the ledgers learn only from the newest round, when somebody asks them.
"""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.blueprint.check import FactKey
from smsl_studio.monitor.ledger import Ledger
from smsl_studio.monitor.sample import Sample, SensorRound


class Rounds:
    """The rounds of one opened world that follow each other without anything between them.

    ``newest`` is the last of them that is not in the ledgers yet, and None if all are.
    """

    def __init__(self) -> None:
        self.newest: SensorRound | None = None
        self._facts: tuple[FactKey, ...] | None = None
        self._ledgers: tuple[Ledger, ...] = ()
        self._count = 0

    def begin(self, samples: Sequence[Sample], ledgers: Sequence[Ledger], now: float) -> None:
        """Let rounds go on from samples that are in these ledgers, if they are a round of ``now``
        (s) and every ledger has only this one speaker, without any delay.
        """
        if not isinstance(samples, SensorRound) or samples.time != now:
            return
        pairs = zip(ledgers, samples, strict=True)
        if len(ledgers) == len(samples) and all(one.punctual(last, now) for one, last in pairs):
            self._facts, self._ledgers = samples.facts, tuple(ledgers)

    def take(self, samples: Sequence[Sample], now: float) -> SensorRound | None:
        """Take samples that are the next round, read just now, and return them. None if they are
        anything else.
        """
        if not isinstance(samples, SensorRound) or samples.facts is not self._facts:
            return None
        if samples.time != now:
            return None
        self.newest = samples
        self._count += 1
        return samples

    def end(self) -> None:
        """Let no round follow the last one, because other samples come. Write the newest round."""
        self.write()
        self._facts = None

    def write(self) -> None:
        """Write the newest round into the ledgers, as if all rounds had come one by one."""
        newest, self.newest = self.newest, None
        if newest is not None:
            for ledger, sample in zip(self._ledgers, newest, strict=True):
                ledger.renew(sample, self._count)
        self._count = 0
