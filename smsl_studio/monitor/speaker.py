"""The speakers of a source: the programs whose samples carry its name.

A source is bound to the node and boot of its first sample. Another program that uses its name
within its largest age is a second speaker, and then it is not known which of them is right. Two
programs may even use the same node name and boot. Their sequences and clocks show the difference:
sequence and clock of one program grow together, those of two programs do not.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from math import inf, isfinite, nan

from smsl_studio.monitor.sample import Sample

HAIR = 1e-9
"""The tolerance (s) for ages: an age is a sum of ticks and has rounding errors."""

CREEP = 1e-3
"""The tolerance for a slow clock of a source: one part in a thousand makes no sample late."""

LONG = 40
"""The largest length of a node's name in a reason, in characters."""

HERE, NAMELESS = "this program", "a node without a name"


class Fit(Enum):
    """The relation of a sample to a speaker: its next sample, an earlier sample, a late sample, or
    a sample of another program."""

    NEXT = "next"
    FORMER = "former"
    LATE = "late"
    FOREIGN = "foreign"


class Speaker:
    """One program that sends samples for a source, as its samples show it.

    ``sample`` is its newest sample, and ``received`` (s) the time of its arrival. A ``live``
    speaker is remote, and its times are on the monotonic clock; other times are on the clock of the
    run. ``heard`` (s) is the arrival of its last sample of any kind. ``latency`` (s) is the delay
    beyond the quickest sample. ``over`` says that its samples do not count, because they are not
    newer than the known ones.
    """

    __slots__ = (
        "_quickest",
        "_shadow",
        "_time",
        "boot",
        "heard",
        "latency",
        "live",
        "node",
        "over",
        "received",
        "sample",
    )

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
        """Return the time (s) since its last sample of any kind. ``live`` is now on the monotonic
        clock."""
        # A sample may arrive after the clock was read.
        return max(0.0, live - self.heard) if self.live else now - self.heard

    def read_age(self, now: float, live: float) -> float:
        """Return the age (s) of its newest sample."""
        return max(0.0, live - self.received) if self.live else now - self.received

    def knows_newer(self, sample: Sample) -> bool:
        """Whether a sample of the same node is older than this speaker's newest sample: by its
        boot, or by its sequence and clock."""
        if self.boot != sample.boot:
            return self.boot > sample.boot
        clock = sample.time <= self._time or not isfinite(sample.time)
        return sample.sequence <= self.sample.sequence and clock

    def fit(self, sample: Sample, now: float, max_age: float) -> Fit:
        """Return the relation of a sample with the same node and boot, which came at ``now``
        (s)."""
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
        """Accept a sample if it is without doubt the next one. Return whether it was accepted.

        It came at ``now`` (s), or at its own ``received`` time."""
        _, _, _, _, time, sequence, boot, _, _, received, node = sample
        if boot != self.boot or node != self.node:
            return False
        if received is not None:
            now = received
        way = now - time
        quickest = self._quickest + CREEP * (now - self.received)
        latency = way - quickest
        # All comparisons are false if a clock is NaN.
        grows = sequence > self.sample.sequence and time >= self._time
        if not (grows and -max_age < latency < max_age):
            return False
        if latency > 0:
            self._quickest, self.latency = quickest, latency
        else:
            self._quickest, self.latency = way, 0.0
        self.sample, self._time = sample, time
        self.received = self.heard = now
        self.live = received is not None
        return True

    def punctual(self, now: float) -> bool:
        """Whether its newest sample came at ``now`` (s), and neither this one nor the quickest had
        any delay. It is a sensor of the run itself.
        """
        exact = self._quickest == 0.0 and self.latency == 0.0
        return exact and self.received == now == self._time and not (self.live or self.over)

    def renew(self, sample: Sample) -> None:
        """Accept a sample of the same kind: it came when it was read."""
        self.sample = sample
        self._time = self.received = self.heard = sample.time

    def take(self, sample: Sample, now: float) -> None:
        """Accept its next sample, which came at ``now`` (s)."""
        self._clocked(sample, now)
        self.sample, self.received, self.heard = sample, now, now
        self.live = sample.received is not None

    def shadowed(self, sample: Sample, now: float, max_age: float) -> bool:
        """Whether earlier samples that still arrive come from a second program.

        A program may copy another's name, boot and clock and run a little ahead. Then the other's
        samples look overtaken. Samples that a network has delayed arrive all at once, but samples
        of a program arrive at the pace of its clock.
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
    """Name the speakers of a source, in the order of their first samples: ``two speakers for
    camera: bench, intruder``."""
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
    """Whether two samples are the same reading with the same sequence."""
    times = one.time == other.time or not (isfinite(one.time) or isfinite(other.time))
    return one.sequence == other.sequence and one.value == other.value and times


def _follows(sample: Sample, before: Sample) -> bool:
    return sample.sequence > before.sequence and sample.time > before.time
