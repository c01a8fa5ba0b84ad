"""The fact bus: it carries samples from sensors to monitors in this process.

It needs no broker. It is bounded: of each speaker of a source only the newest sample waits, so that
one which floods costs its own older samples and nothing else; what was left out is counted. Any
thread may publish. Whoever subscribes fetches what waits when it suits its clock.
"""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from smsl_studio.blueprint.check import FactKey
from smsl_studio.monitor.sample import Sample
from smsl_studio.monitor.speaker import same_word

MOST_SOURCES = 4096
"""Sources of facts that may wait at once: far more than any site has."""

MOST_SPEAKERS = 4
"""Speakers of one source that may wait at once; two are enough to make it unknown."""

LONGEST = 1000
"""Characters of a name, a value or a reason: far more than any of them needs."""

SourceKey = tuple[str, int, str]
"""Branch, digit and source."""


@dataclass(frozen=True, slots=True)
class BusCounts:
    """What went over a bus: every sample was published; of these some were not handed on.

    ``replaced`` were overtaken by a newer one of their source before they were fetched, or were
    older themselves; ``refused`` are too long, or of one source too many; ``retained`` were kept
    by a broker, and so say nothing of now.
    """

    published: int = 0
    replaced: int = 0
    refused: int = 0
    retained: int = 0


class Mailbox:
    """What waits for one subscriber."""

    def __init__(self, bus: FactBus) -> None:
        self._bus = bus
        self._waiting: dict[SourceKey, list[Sample]] = {}

    def take(self) -> tuple[Sample, ...]:
        """The newest sample of every speaker of every source since the last time, in the order in
        which the sources first spoke."""
        if not self._waiting:
            return ()
        with self._bus.lock:
            waiting, self._waiting = self._waiting, {}
        return tuple([sample for samples in waiting.values() for sample in samples])

    def close(self) -> None:
        """End the subscription; calling it twice is harmless."""
        self._bus.forget(self)
        self._waiting = {}

    def put(self, samples: Iterable[Sample]) -> list[tuple[str, SourceKey]]:
        """Let samples wait (the bus holds its lock); what was left out for them, and of whom."""
        waiting, left_out = self._waiting, []
        for sample in samples:
            key = (sample.branch, sample.digit, sample.source)
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
    """Samples from many to many, newest first."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self._inboxes: tuple[Mailbox, ...] = ()
        self._counts: Counter[str] = Counter()
        self._floods: Counter[SourceKey] = Counter()

    def subscribe(self) -> Mailbox:
        """A new inbox; what was published before is not in it."""
        inbox = Mailbox(self)
        with self.lock:
            self._inboxes = (*self._inboxes, inbox)
        return inbox

    def forget(self, inbox: Mailbox) -> None:
        """Hand nothing more to an inbox."""
        with self.lock:
            self._inboxes = tuple(one for one in self._inboxes if one is not inbox)

    def publish(self, samples: Iterable[Sample], *, retained: bool = False) -> None:
        """Hand samples to everyone who subscribed; retained ones are only counted."""
        with self.lock:
            heard = list(samples)
            self._counts["published"] += len(heard)
            if retained:
                self._counts["retained"] += len(heard)
                return
            short = [sample for sample in heard if not too_long(sample)]
            if len(short) < len(heard):
                self._counts["refused"] += len(heard) - len(short)
            for inbox in self._inboxes:
                for what, key in inbox.put(short):
                    self._counts[what] += 1
                    if what == "replaced":
                        self._flooded(key)

    @property
    def counts(self) -> BusCounts:
        """What went over it so far."""
        with self.lock:
            return BusCounts(**self._counts)

    def replaced(self, fact: FactKey, source: str) -> int:
        """How many samples of one source were left out for a newer one."""
        with self.lock:
            return self._floods[(*fact, source)]

    @property
    def flooding(self) -> SourceKey | None:
        """The source of which most samples were left out for newer ones, if any were."""
        with self.lock:
            return max(self._floods, key=self._floods.__getitem__, default=None)

    def _flooded(self, key: SourceKey) -> None:
        if key in self._floods or len(self._floods) < MOST_SOURCES:
            self._floods[key] += 1


def _beside(waiting: list[Sample], sample: Sample) -> bool:
    """Let one more sample of a source wait; whether that one, or one before it, was left out.

    Samples of one speaker grow in sequence and clock together. Any other two wait side by side, so
    that whoever fetches them sees that two speak.
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


def too_long(sample: Sample) -> bool:
    """Whether a bus refuses a sample for the length of what it says."""
    return (
        len(sample.branch) > LONGEST
        or len(sample.source) > LONGEST
        or len(sample.reason) > LONGEST
        or len(sample.node) > LONGEST
        or (sample.value is not None and len(sample.value) > LONGEST)
    )
