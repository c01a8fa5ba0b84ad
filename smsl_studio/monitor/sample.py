"""Sample: the reading of one source for one fact at one instant. A round has one of each sensor."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.predicates.measure import BAD, GOOD, UNCERTAIN

__all__ = [
    "BAD",
    "GOOD",
    "LONGEST",
    "UNCERTAIN",
    "Sample",
    "SampleFields",
    "SensorRound",
    "sample_of",
]

LONGEST = 1000
"""The largest length of a name, a value or a reason, in characters."""


class Sample(NamedTuple):
    """One reading on its way to the monitor. It is a light value, because most are never used.

    A ``value`` of None means that the source has no valid reading; ``reason`` says why. ``time`` is
    the source's clock in seconds, which never goes back. ``sequence`` grows with every sample of a
    source, and ``boot`` with every start of the source. ``received`` is the time (s) at which a
    sample of a remote sensor arrived, on this computer's monotonic clock. It is None for sensors of
    the run itself. ``node`` is the name of the remote program; it is empty for this program.
    """

    branch: str
    digit: int
    source: str
    value: str | None
    time: float
    sequence: int
    boot: int = 0
    reason: str = ""
    quality: str = GOOD
    received: float | None = None
    node: str = ""

    @property
    def fact(self) -> FactKey:
        """The fact that the sample is about."""
        return self.branch, self.digit

    @property
    def order(self) -> tuple[int, int]:
        """The pair (boot, sequence). It must grow from one sample of a source to the next."""
        return self.boot, self.sequence


class SensorRound(tuple[Sample, ...]):
    """The samples of all sensors of one opened world, read in this order at one instant.

    A schedule makes a round only if nothing is unusual. Each sample is of another source, was read
    at ``time`` (s), is a good reading, and has a higher sequence than all before it. None of its
    texts is long. ``facts`` are the facts of the samples: one object in all rounds of an opened
    world. ``values`` are the values of the samples.
    """

    time: float
    facts: tuple[FactKey, ...]
    values: tuple[str, ...]


SampleFields = tuple[
    str, int, str, str | None, float, int, int, str, str, float | None, str
]  # fmt: skip
"""All fields of a sample, in their order."""

sample_of: Callable[[SampleFields], Sample] = partial(tuple.__new__, Sample)
"""Return the sample with these fields. Sensors are read at every tick, and this takes a third of
the time of a call with names."""
