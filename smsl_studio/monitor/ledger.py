"""The ledger of one source: its speakers, its newest sample, and the samples that did not count.

The age of a fact is measured on the receiver's clock, from the arrival of a sample. Repeated,
retained and overtaken samples do not have a growing (boot, sequence), so they do not refresh the
fact. A late sample does not refresh it either: its delay is longer than the largest age of the
fact. The clocks of source and receiver may differ, so the delay is measured against the quickest
sample of the same boot. While the source has more than one live speaker, its fact is unknown.
"""

from __future__ import annotations

from smsl_studio.monitor.aggregate import SourceValue
from smsl_studio.monitor.sample import GOOD, Sample
from smsl_studio.monitor.speaker import HAIR, Fit, Speaker, speaker_words

MOST = 8
"""The largest number of speakers of one source that are remembered. Two make it unknown already."""


class Ledger:
    """The samples of one source of one fact, with their speakers.

    ``max_age`` is in seconds. ``counted``, ``repeated`` (with overtaken samples) and ``late`` are
    numbers of samples. Only counted samples refresh the fact. ``only`` is its speaker, if exactly
    one has spoken.
    """

    __slots__ = ("_speakers", "counted", "late", "max_age", "name", "only", "repeated")

    def __init__(self, name: str, max_age: float) -> None:
        self.name = name
        self.max_age = max_age
        self.counted = self.repeated = self.late = 0
        self._speakers: list[Speaker] = []
        self.only: Speaker | None = None

    def take(self, sample: Sample, now: float) -> str | None:
        """Accept a sample if it is newer than all earlier samples of its speaker and not late.

        It arrived at ``now`` (s), or at its own ``received`` time. Return its value if it is
        evidence of this instant without doubt; None says nothing.
        """
        only = self.only
        if only is not None and only.follow(sample, now, self.max_age):
            self.counted += 1
            return None if only.live or sample.quality != GOOD else sample.value
        self._weigh(sample, now if sample.received is None else sample.received)
        return None

    def punctual(self, sample: Sample, now: float) -> bool:
        """Whether its only speaker has just sent this sample, at ``now`` (s) and without delay."""
        only = self.only
        return only is not None and only.sample is sample and only.punctual(now)

    def renew(self, sample: Sample, count: int) -> None:
        """Accept the last of ``count`` samples that its only speaker has sent without any delay."""
        if self.only is not None:
            self.only.renew(sample)
            self.counted += count

    def speaker(self, now: float, live: float = 0.0) -> Speaker | None:
        """Return the speaker of the newest sample, or None if there is no sample yet.

        ``now`` (s) is the time of the run, ``live`` the same instant on the monotonic clock.
        """
        if self.only is not None:
            return self.only
        heard = self._heard(now, live) or self._speakers
        return min(heard, key=lambda one: (one.over, one.age(now, live)), default=None)

    def said_now(self, now: float) -> Sample | None:
        """Return the sample of the only speaker if it arrived exactly at ``now`` and is
        evidence."""
        only = self.only
        if only is None or only.received != now or only.live:
            return None
        sample = only.sample
        return sample if sample.value is not None and sample.quality == GOOD else None

    def said(self, now: float, live: float = 0.0) -> SourceValue:
        """Return the value of the source at ``now`` (``live`` on the monotonic clock), or None with
        the reason."""
        speaker = self.speaker(now, live)
        if speaker is None:
            return SourceValue(self.name, None, "no reading yet", now)
        if self.only is None and len(heard := self._heard(now, live)) > 1:
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

    def newest(self, now: float, live: float = 0.0) -> tuple[Sample | None, float, str]:
        """Return the newest sample of the source, its age (s), and why it is no evidence, if it is
        not for its own words: two programs speak, or its boot is over.
        """
        only = self.only
        if only is not None and not only.over:
            return only.sample, only.read_age(now, live), ""
        speaker = self.speaker(now, live)
        if speaker is None:
            return None, 0.0, ""
        said = self.said(now, live)
        doubt = said.reason if said.contested or speaker.over else ""
        return speaker.sample, speaker.read_age(now, live), doubt

    @property
    def live(self) -> bool:
        """Whether it has a remote speaker, so that the monotonic clock counts."""
        return any(one.live for one in self._speakers)

    def _heard(self, now: float, live: float) -> list[Speaker]:
        """Return the speakers with a sample within the largest age, in the order of their first
        samples."""
        most = self.max_age + HAIR
        return [one for one in self._speakers if one.age(now, live) <= most]

    def _weigh(self, sample: Sample, now: float) -> None:
        """Accept or count a sample that is not simply the next sample of the only speaker."""
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
        """Whether another speaker of the same node has sent a newer sample already."""
        others = (one for one in self._speakers if one is not speaker and one.node == sample.node)
        return any(one.knows_newer(sample) for one in others)

    def _add(self, speaker: Speaker) -> None:
        """Add a speaker. If there are too many, the one with the longest silence is forgotten."""
        if len(self._speakers) == MOST:
            self._speakers.remove(min(self._speakers[1:], key=lambda one: one.heard))
        self._speakers.append(speaker)
        self.only = self._speakers[0] if len(self._speakers) == 1 else None
