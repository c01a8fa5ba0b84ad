"""The ledger of one source: its speakers, its newest sample, and the samples that did not count.

A fact ages on the receiver's clock, from the moment a sample was taken in. Repeated, retained and
overtaken samples do not have a growing (boot, sequence) and refresh nothing. Neither does a late
one, which was held up on its way for longer than its fact may be old: the clocks of source and
receiver need not agree, so a sample is late by how much longer it took than the quickest of its
boot. While more than one speaker is heard within that age, the source says nothing.
"""

from __future__ import annotations

from smsl_studio.monitor.aggregate import SourceValue
from smsl_studio.monitor.sample import GOOD, Sample
from smsl_studio.monitor.speaker import HAIR, Fit, Speaker, speaker_words

MOST = 8
"""So many speakers of one source are remembered. Two are enough to make it unknown."""


class Ledger:
    """What was said for one source of one fact, and by whom.

    ``max_age`` is in seconds. ``counted``, ``repeated`` (overtaken, too) and ``late`` are how many
    samples came; only those that counted refreshed the fact.
    """

    def __init__(self, name: str, max_age: float) -> None:
        self.name = name
        self.max_age = max_age
        self.counted = self.repeated = self.late = 0
        self._speakers: list[Speaker] = []
        self._only: Speaker | None = None

    def take(self, sample: Sample, now: float) -> None:
        """Take a sample in, if it is newer than all before of its speaker and came in time.

        It came at ``now`` (s), or when it says itself that it was received.
        """
        if sample.received is not None:
            now = sample.received
        only = self._only
        if (
            only is not None
            and only.boot == sample.boot
            and only.node == sample.node
            and only.follow(sample, now, self.max_age)
        ):
            self.counted += 1
        else:
            self._weigh(sample, now)

    def speaker(self, now: float, live: float = 0.0) -> Speaker | None:
        """The speaker of the newest sample at ``now`` (``live`` on the monotonic clock); None:
        nobody yet."""
        if self._only is not None:
            return self._only
        heard = self._heard(now, live) or self._speakers
        return min(heard, key=lambda one: (one.over, one.age(now, live)), default=None)

    def said_now(self, now: float) -> Sample | None:
        """The sample of its only speaker, if that came at this very moment and is evidence."""
        only = self._only
        if only is None or only.received != now or only.live:
            return None
        sample = only.sample
        return sample if sample.value is not None and sample.quality == GOOD else None

    def said(self, now: float, live: float = 0.0) -> SourceValue:
        """What it says as things stand at ``now``, or ``live`` on the monotonic clock: its value,
        or nothing with the reason."""
        speaker = self.speaker(now, live)
        if speaker is None:
            return SourceValue(self.name, None, "no reading yet", now)
        if self._only is None and len(heard := self._heard(now, live)) > 1:
            reason = speaker_words(self.name, heard)
            return SourceValue(self.name, None, reason, speaker.age(now, live), contested=True)
        sample = speaker.sample
        age = speaker.read_age(now, live)
        if age > self.max_age + HAIR:
            return SourceValue(self.name, None, f"no reading for {age:.1f} s", age)
        if speaker.over:
            return SourceValue(self.name, None, "its samples are older than what was known", age)
        if sample.value is None:
            return SourceValue(self.name, None, sample.reason or "no valid reading", age)
        if sample.quality != GOOD:
            reason = sample.reason or f"its reading is {sample.quality}"
            return SourceValue(self.name, None, reason, age)
        return SourceValue(self.name, sample.value, "", age)

    @property
    def live(self) -> bool:
        """Whether anybody who speaks for it is elsewhere, so that the monotonic clock counts."""
        return any(one.live for one in self._speakers)

    def _heard(self, now: float, live: float) -> list[Speaker]:
        """The speakers heard within the age of the fact, in the order in which they first spoke."""
        most = self.max_age + HAIR
        return [one for one in self._speakers if one.age(now, live) <= most]

    def _weigh(self, sample: Sample, now: float) -> None:
        """Take a sample that is not simply the next one of the only speaker."""
        same = [one for one in self._speakers if one.called(sample)]
        fits = [one.fit(sample, now, self.max_age) for one in same]
        by_fit = {fit: [one for one, is_ in zip(same, fits, strict=True) if is_ is fit]
                  for fit in Fit}  # fmt: skip
        if by_fit[Fit.NEXT]:
            speaker = max(by_fit[Fit.NEXT], key=lambda one: one.sample.sequence)
            speaker.over = speaker.over and self._is_over(sample, speaker)
            speaker.take(sample, now)
            self.counted += not speaker.over
            self.repeated += speaker.over
        elif by_fit[Fit.FORMER]:
            self.repeated += 1
            if any(one.shadowed(sample, now, self.max_age) for one in by_fit[Fit.FORMER]):
                self._add(Speaker(sample, now, over=True))
        elif by_fit[Fit.LATE]:
            self.late += 1
            for one in by_fit[Fit.LATE]:
                one.heard = now
        else:
            over = self._is_over(sample, None)
            self._add(Speaker(sample, now, over))
            self.counted += not over
            self.repeated += over

    def _is_over(self, sample: Sample, speaker: Speaker | None) -> bool:
        """Whether its node has said something newer already, by another speaker than this one."""
        others = (one for one in self._speakers if one is not speaker and one.node == sample.node)
        return any(one.knows_newer(sample) for one in others)

    def _add(self, speaker: Speaker) -> None:
        """One more speaker; of too many, who has been silent for longest is forgotten."""
        if len(self._speakers) == MOST:
            self._speakers.remove(min(self._speakers[1:], key=lambda one: one.heard))
        self._speakers.append(speaker)
        self._only = self._speakers[0] if len(self._speakers) == 1 else None
