"""The speakers of a source: the programs whose samples carry its name.

A source is bound to the node and boot that spoke first. Whoever else speaks under its name within
its age is a second speaker, and then nobody can say which of them is right. Two programs may even
use one node name and one boot. They are told apart by their sequences and clocks: those of one
program grow together, those of two do not.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from math import inf, isfinite, nan

from smsl_studio.monitor.sample import Sample

HAIR = 1e-9
"""Seconds by which an age, a sum of ticks, may exceed the maximum without being too old."""

CREEP = 1e-3
"""A source's clock may be slow by one part in a thousand without its samples seeming late."""

LONG = 40
"""Characters of a node's name that are told in a reason."""

HERE, NAMELESS = "this program", "a node without a name"


class Fit(Enum):
    """What a sample is to a speaker: its next word, one of its former words, one that was held up
    for too long, or a word of somebody else."""

    NEXT = "next"
    FORMER = "former"
    LATE = "late"
    FOREIGN = "foreign"


class Speaker:
    """One program that speaks for a source, as far as its samples show.

    ``sample`` is its newest sample and ``received`` when it came (s): on the monotonic clock where
    it is ``live``, that is elsewhere, else on the clock of the run. ``heard`` is when anything of
    it came last, also what refreshed nothing. ``latency`` (s) is beyond the quickest way seen.
    ``over`` says that its word does not count, because it is not newer than what was known.
    """

    def __init__(self, sample: Sample, now: float, over: bool = False) -> None:
        self.node, self.boot, self.over = sample.node, sample.boot, over
        self.sample, self.received, self.heard = sample, now, now
        self.live = sample.received is not None
        self.latency = 0.0
        self._time, self._quickest = nan, inf
        self._shadow: tuple[Sample, float] | None = None
        self._clocked(sample, now)

    def called(self, sample: Sample) -> bool:
        """Whether a sample has its node and boot."""
        return self.node == sample.node and self.boot == sample.boot

    def age(self, now: float, live: float) -> float:
        """How long ago (s) anything of it came; ``live`` is now on the monotonic clock."""
        # A sample may come in after the clock was read.
        return max(0.0, live - self.heard) if self.live else now - self.heard

    def read_age(self, now: float, live: float) -> float:
        """How old (s) its newest sample is."""
        return max(0.0, live - self.received) if self.live else now - self.received

    def knows_newer(self, sample: Sample) -> bool:
        """Whether a sample of the same node is older than what this one has said: by its boot, or
        by its sequence and clock."""
        if self.boot != sample.boot:
            return self.boot > sample.boot
        clock = sample.time <= self._time or not isfinite(sample.time)
        return sample.sequence <= self.sample.sequence and clock

    def fit(self, sample: Sample, now: float, max_age: float) -> Fit:
        """What a sample of this node and boot that came at ``now`` (s) is to it."""
        newest, time = self.sample, sample.time
        on = time - self._time if isfinite(time) else 0.0  # NaN where it had no clock yet
        if sample.sequence > newest.sequence:
            if not isfinite(time):
                return Fit.NEXT
            way = now - time
            quickest = self._quickest + CREEP * (now - self.received)
            if way - min(quickest, way) > max_age + HAIR:
                return Fit.LATE
            jumped = way < self._quickest - max_age - HAIR < inf
            return Fit.FOREIGN if on < -HAIR or jumped else Fit.NEXT
        if sample.sequence == newest.sequence:
            return Fit.FORMER if same_word(sample, newest) else Fit.FOREIGN
        return Fit.FOREIGN if on > HAIR else Fit.FORMER

    def follow(self, sample: Sample, now: float, max_age: float) -> bool:
        """Take its next word, if a sample is no doubt that; else nothing is done."""
        time = sample.time
        way = now - time
        quickest = self._quickest + CREEP * (now - self.received)
        latency = way - quickest
        # All comparisons are false where a clock shows no number.
        grows = sample.sequence > self.sample.sequence and time >= self._time
        if not (grows and -max_age < latency < max_age):
            return False
        if latency > 0:
            self._quickest, self.latency = quickest, latency
        else:
            self._quickest, self.latency = way, 0.0
        self.sample, self._time = sample, time
        self.received = self.heard = now
        self.live = sample.received is not None
        return True

    def take(self, sample: Sample, now: float) -> None:
        """Its next word, which came at ``now`` (s)."""
        self._clocked(sample, now)
        self.sample, self.received, self.heard = sample, now, now
        self.live = sample.received is not None

    def shadowed(self, sample: Sample, now: float, max_age: float) -> bool:
        """Whether former words that still come in are those of a second program.

        A program that copies another's name, boot and clock, and runs a little ahead, makes the
        other's samples look overtaken. What a network held up comes all at once; what a program
        says comes as its clock goes on.
        """
        if sample.received is None or same_word(sample, self.sample):
            return False
        if self._shadow is None or not _follows(sample, self._shadow[0]):
            self._shadow = sample, now
            return False
        first, since = self._shadow
        came, said = now - since, sample.time - first.time
        return came > max_age / 2 and abs(came - said) < came / 2

    def _clocked(self, sample: Sample, now: float) -> None:
        self._quickest += CREEP * (now - self.received)
        self.latency = 0.0
        if isfinite(sample.time):
            way = now - sample.time
            self._quickest = min(way, self._quickest)
            self.latency, self._time = way - self._quickest, sample.time


def speaker_words(source: str, speakers: Sequence[Speaker]) -> str:
    """``two speakers for camera: bench, intruder``, in the order in which they were first heard."""
    many = {2: "two", 3: "three"}.get(len(speakers), "several")
    boots: dict[str, set[int]] = {}
    for one in speakers:
        boots.setdefault(_name(one), set()).add(one.boot)
    told: list[str] = []
    for one in speakers:
        name = _name(one)
        words = f"{name} of boot {one.boot}" if len(boots[name]) > 1 else name
        told.append(f"another program as {words}" if words in told else words)
    return f"{many} speakers for {source}: {', '.join(told)}"


def _name(speaker: Speaker) -> str:
    name = speaker.node or (NAMELESS if speaker.live else HERE)
    return name if len(name) <= LONG else f"{name[: LONG - 1]}…"


def same_word(one: Sample, other: Sample) -> bool:
    """Whether a sample is another one once more: the same reading under the same sequence."""
    times = one.time == other.time or not (isfinite(one.time) or isfinite(other.time))
    return one.sequence == other.sequence and one.value == other.value and times


def _follows(sample: Sample, before: Sample) -> bool:
    return sample.sequence > before.sequence and sample.time > before.time
