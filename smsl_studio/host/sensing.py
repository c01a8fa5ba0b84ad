"""Sensors by their period: which are due at a tick, and what they say."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from smsl_studio.host.call import words_of
from smsl_studio.library.bound import BoundSensor
from smsl_studio.monitor.sample import Sample


class Sensing:
    """The sensors of one world, and how often each has spoken since the world was opened."""

    def __init__(self, sensors: Iterable[BoundSensor], tick: float, boot: int) -> None:
        self._sensors = tuple(sensors)
        self._every = tuple(_ticks(sensor.period, tick) for sensor in self._sensors)
        self._spoken = [0] * len(self._sensors)
        self._boot = boot

    def all(self, subject: Any, time: float) -> tuple[Sample, ...]:
        """One sample of every sensor."""
        return tuple(self._sample(i, subject, time) for i in range(len(self._sensors)))

    def due(self, subject: Any, ticks: int, time: float) -> tuple[Sample, ...]:
        """One sample of every sensor whose period ends with this tick."""
        due = (i for i, every in enumerate(self._every) if ticks % every == 0)
        return tuple(self._sample(i, subject, time) for i in due)

    def _sample(self, index: int, subject: Any, time: float) -> Sample:
        sensor = self._sensors[index]
        self._spoken[index] += 1
        reason = ""
        try:
            value = sensor.function(subject, **sensor.arguments)
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # SystemExit, and what compiled libraries raise
            value, reason = None, words_of(error, sensor.location)
        if value is not None and type(value) is not str:
            value, reason = None, f"it reads {value!r}, which is no text"
        return Sample(
            sensor.branch,
            sensor.digit,
            sensor.name,
            value,
            time,
            self._spoken[index],
            self._boot,
            reason or ("no valid reading" if value is None else ""),
        )


def _ticks(period: float, tick: float) -> int:
    """The period in whole ticks, rounded up, at least one; a hair's breadth is forgiven."""
    return max(1, math.ceil(period / tick - 1e-6))
