"""The fact bus: it carries samples from sensors to monitors in this process.

It needs no broker. It is bounded: only the newest sample of each speaker of a source waits. So a
speaker that sends too many samples loses only its own older samples. Lost samples are counted. Any
thread may publish. A subscriber fetches the waiting samples at its own times.
"""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Collection, Iterable
from dataclasses import dataclass
from itertools import chain

from smsl_studio.blueprint.check import FactKey
from smsl_studio.monitor.sample import LONGEST, Sample, SensorRound
from smsl_studio.monitor.speaker import same_word

MOST_SOURCES = 4096
"""The largest number of sources with waiting samples. It is far more than any site has."""

MOST_SPEAKERS = 4
"""The largest number of speakers of one source with waiting samples. Two make it unknown
already."""

SourceKey = tuple[str, int, str]
"""Branch, digit and source."""


@dataclass(frozen=True, slots=True)
class BusCounts:
    """The numbers of samples on a bus: all ``published`` samples, and those not handed on.

    ``replaced`` samples were older than another sample of their source when they were fetched.
    ``refused`` samples were too long, or there were too many sources. ``retained`` samples were
    kept by a broker, so they say nothing about the present.
    """

    published: int = 0
    replaced: int = 0
    refused: int = 0
    retained: int = 0


class Mailbox:
    """The samples that wait for one subscriber."""

    def __init__(self, bus: FactBus) -> None:
        self._bus = bus
        self._waiting: dict[SourceKey, list[Sample]] = {}
        self._whole: tuple[Sample, ...] | None = None
        """All that waits, if it was published together and each is of another source. This is so
        nearly always."""

    def take(self) -> tuple[Sample, ...]:
        """Return the newest sample of every speaker since the last call, in the order in which the
        sources first sent samples."""
        if self._whole is None and not self._waiting:
            return ()
        with self._bus.lock:
            whole, self._whole = self._whole, None
            waiting, self._waiting = self._waiting, {}
        return tuple(chain.from_iterable(waiting.values())) if whole is None else whole

    def close(self) -> None:
        """End the subscription. A second call does nothing."""
        self._bus.forget(self)
        self._waiting, self._whole = {}, None

    def put(self, samples: tuple[Sample, ...]) -> list[tuple[str, SourceKey]]:
        """Add waiting samples, while the bus holds its lock. Return a pair (kind of loss, source)
        for each sample that was left out."""
        left_out: list[tuple[str, SourceKey]] = []
        if self._whole is not None:
            self._waiting, self._whole = {one[:3]: [one] for one in self._whole}, None
        if not self._waiting and samples and len(samples) <= MOST_SOURCES:
            apart = isinstance(samples, SensorRound)
            if apart or len({sample[:3] for sample in samples}) == len(samples):
                self._whole = samples
                return left_out
        waiting = self._waiting
        for sample in samples:
            key = sample[:3]
            known = waiting.get(key)
            if known is not None:
                if _beside(known, sample):
                    left_out.append(("replaced", key))
            elif len(waiting) < MOST_SOURCES:
                waiting[key] = [sample]
            else:
                left_out.append(("refused", key))
        return left_out


class FactBus:
    """Carries samples from many publishers to many subscribers."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self._inboxes: tuple[Mailbox, ...] = ()
        self._counts: Counter[str] = Counter()
        self._floods: Counter[SourceKey] = Counter()

    def subscribe(self) -> Mailbox:
        """Return a new mailbox. It gets only samples that are published from now on."""
        inbox = Mailbox(self)
        with self.lock:
            self._inboxes = (*self._inboxes, inbox)
        return inbox

    def forget(self, inbox: Mailbox) -> None:
        """Hand no more samples to a mailbox."""
        with self.lock:
            self._inboxes = tuple(one for one in self._inboxes if one is not inbox)

    def publish(self, samples: Iterable[Sample], *, retained: bool = False) -> None:
        """Hand samples to all subscribers. Retained samples are only counted."""
        with self.lock:
            heard = samples if isinstance(samples, SensorRound) else tuple(samples)
            self._counts["published"] += len(heard)
            if retained:
                self._counts["retained"] += len(heard)
                return
            if not _all_short(heard):
                short = tuple(sample for sample in heard if not too_long(sample))
                self._counts["refused"] += len(heard) - len(short)
                heard = short
            for inbox in self._inboxes:
                for what, key in inbox.put(heard):
                    self._counts[what] += 1
                    if what == "replaced":
                        self._flooded(key)

    @property
    def counts(self) -> BusCounts:
        """The numbers of samples so far."""
        with self.lock:
            return BusCounts(**self._counts)

    def replaced(self, fact: FactKey, source: str) -> int:
        """Return the number of samples of one source that a newer sample replaced."""
        with self.lock:
            return self._floods[(*fact, source)]

    @property
    def flooding(self) -> SourceKey | None:
        """The source with the most replaced samples. None if no sample was replaced."""
        with self.lock:
            return max(self._floods, key=self._floods.__getitem__, default=None)

    def _flooded(self, key: SourceKey) -> None:
        if key in self._floods or len(self._floods) < MOST_SOURCES:
            self._floods[key] += 1


def _beside(waiting: list[Sample], sample: Sample) -> bool:
    """Add a waiting sample of a source. Return whether this sample or an earlier one was left out.

    Sequence and clock of one speaker's samples grow together. Two samples for which this is not so
    wait side by side, so that the subscriber sees two speakers.
    """
    for at, known in enumerate(waiting):
        if (known.node, known.boot) != (sample.node, sample.boot):
            continue
        if sample.sequence > known.sequence and not sample.time < known.time:
            waiting[at] = sample
            return True
        if sample.sequence < known.sequence and not sample.time > known.time:
            return True
        if same_word(sample, known):
            return True
    if len(waiting) < MOST_SPEAKERS:
        waiting.append(sample)
        return False
    waiting[-1] = sample
    return True


def _all_short(samples: Collection[Sample]) -> bool:
    """Whether a bus refuses none of these samples for certain: even all texts of each together
    are short. Those of a round are, by its promise."""
    if isinstance(samples, SensorRound):
        return True
    for branch, _, source, value, _, _, _, reason, _, _, node in samples:
        if len(branch) + len(source) + len(value or "") + len(reason) + len(node) > LONGEST:
            return False
    return True


def too_long(sample: Sample) -> bool:
    """Whether a bus refuses a sample because one of its texts is too long."""
    return (
        len(sample.branch) > LONGEST
        or len(sample.source) > LONGEST
        or len(sample.reason) > LONGEST
        or len(sample.node) > LONGEST
        or (sample.value is not None and len(sample.value) > LONGEST)
    )
