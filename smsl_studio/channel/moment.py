"""One moment of a world: the answer to a tick, and the samples in it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from smsl_studio.channel.fields import (
    LATEST,
    LONGEST_SENTENCE,
    count_of,
    number_of,
    objects_of,
    one_of,
    shown,
    text_of,
)
from smsl_studio.channel.frames import ChannelError, Frame

OUTCOMES = ("idle", "running", "returned", "failed", "raised")
QUALITIES = ("good", "uncertain", "bad")
MOST_SAMPLES = 20_000
_HAIR = 1e-9


class ToldSample(NamedTuple):
    """A sample as it was told: which sensor of which fact, and what it read.

    ``time`` is in simulated seconds of the world. ``value`` None means no valid reading; ``reason``
    says why.
    """

    fact: str
    sensor: str
    value: str | None
    time: float
    sequence: int
    quality: str
    reason: str


@dataclass(frozen=True, slots=True)
class ToldTick:
    """The answer to a tick: the state of the operation, and the samples since the last tick.

    ``progress`` is the share of the operation that is done, from 0 to 1. None means not known.
    """

    outcome: str
    message: str
    progress: float | None
    samples: tuple[ToldSample, ...]


def read_tick(frame: Frame, time: float) -> ToldTick:
    """Return the answer to a tick, after which it is ``time`` (s). ChannelError if it is not
    valid."""
    told = number_of(frame, "time", 0.0, LATEST, None)
    if abs(told - time) > _HAIR * max(1.0, time):
        raise ChannelError(f"the time is {told!r} s, and it should be {time!r} s")
    progress = frame.get("progress")
    if progress is not None:
        progress = number_of(frame, "progress", 0.0, 1.0, None)
    return ToldTick(
        one_of(frame, "outcome", OUTCOMES),
        text_of(frame, "message", LONGEST_SENTENCE, ""),
        progress,
        read_samples(frame, time),
    )


def read_samples(frame: Frame, time: float) -> tuple[ToldSample, ...]:
    """Return the samples in an answer. ChannelError if one is not valid, or later than ``time``
    (s)."""
    return tuple(_sample(one, time) for one in objects_of(frame, "samples", MOST_SAMPLES))


def sample_frame(sample: ToldSample) -> dict[str, Any]:
    """Return a sample as an object of an answer."""
    return dict(zip(ToldSample.__annotations__, sample, strict=True))


def _sample(frame: Frame, now: float) -> ToldSample:
    value = frame.get("value")
    if value is not None:
        value = text_of(frame, "value")
    elif "value" not in frame:
        raise ChannelError("a sample has no value")
    time = number_of(frame, "time", 0.0, LATEST, None)
    if time > now + _HAIR * max(1.0, now):
        raise ChannelError(f"a sample of {shown(frame.get('sensor'))} comes from the future")
    return ToldSample(
        text_of(frame, "fact"),
        text_of(frame, "sensor"),
        value,
        time,
        count_of(frame, "sequence"),
        one_of(frame, "quality", QUALITIES, "good"),
        text_of(frame, "reason", LONGEST_SENTENCE, ""),
    )
