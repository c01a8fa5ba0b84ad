"""The fact monitor: samples become facts with age, quality and reason.

Ages are measured on the receiver's clock (simulated time in simulation), from the moment a sample
was accepted. Only a growing (boot, sequence) of a source refreshes its fact: late, repeated and
retained samples do not.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from types import MappingProxyType
from typing import Protocol

from smsl_studio.blueprint.check import FactKey, Reading, Scene
from smsl_studio.monitor.sample import Sample

HAIR = 1e-9
"""Ages are sums of ticks: this much (s) beyond the maximum is still not too old."""


class Source(Protocol):
    """What the monitor must know of a sensor: which fact, and when it is stale (s).

    ``aggregation``: with ``priority`` the first sensor that has a reading decides; otherwise all
    that have one must agree.
    """

    @property
    def name(self) -> str: ...
    @property
    def branch(self) -> str: ...
    @property
    def digit(self) -> int: ...
    @property
    def max_age(self) -> float: ...
    @property
    def aggregation(self) -> str: ...


@dataclass(frozen=True, slots=True)
class _Latest:
    """The newest sample of a source, and when it came."""

    sample: Sample
    received: float


class FactMonitor:
    """C_fact: from the samples of the sensors to the scene.

    The order of the sensors of one fact is their priority. Samples of anyone else are dropped.
    """

    def __init__(self, sensors: Iterable[Source]) -> None:
        self._sources: dict[FactKey, list[Source]] = {}
        self._latest: dict[tuple[FactKey, str], _Latest | None] = {}
        for sensor in sensors:
            key = (sensor.branch, sensor.digit)
            self._sources.setdefault(key, []).append(sensor)
            self._latest[key, sensor.name] = None

    def accept(self, samples: Iterable[Sample], now: float) -> None:
        """Take in what the sensors said, at ``now`` (s) on the receiver's clock."""
        for sample in samples:
            key = ((sample.branch, sample.digit), sample.source)
            if key not in self._latest:
                continue
            known = self._latest[key]
            if known is None or _order(sample) > _order(known.sample):
                self._latest[key] = _Latest(sample, now)

    def scene(self, now: float) -> Scene:
        """Every sensed fact as it stands at ``now`` (s): its value, or unknown with the reason."""
        readings = {key: self._reading(key, sources, now) for key, sources in self._sources.items()}
        return Scene(MappingProxyType(readings), now)

    def _reading(self, key: FactKey, sources: list[Source], now: float) -> Reading:
        said = [self._said(key, source, now) for source in sources]
        valid = [reading for reading in said if reading.value is not None]
        if not valid:
            return said[0]
        if len(valid) == 1 or sources[0].aggregation == "priority":
            return valid[0]
        if len({reading.value for reading in valid}) == 1:
            return min(valid, key=lambda reading: reading.age)
        words = ", ".join(
            f"{source.name} says {reading.value}"
            for source, reading in zip(sources, said, strict=True)
            if reading.value is not None
        )
        return Reading(None, f"conflict: {words}", max(reading.age for reading in valid))

    def _said(self, key: FactKey, source: Source, now: float) -> Reading:
        latest = self._latest[key, source.name]
        if latest is None:
            return Reading(None, "no reading yet", now)
        age = now - latest.received
        if age > source.max_age + HAIR:
            return Reading(None, f"no reading for {age:.1f} s", age)
        if latest.sample.value is None:
            return Reading(None, latest.sample.reason or "no valid reading", age)
        return Reading(latest.sample.value, "", age)


def _order(sample: Sample) -> tuple[int, int]:
    return sample.boot, sample.sequence
