"""The schedule of sensors: it reads each sensor at its period, and applies disturbances."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import Any

from smsl_studio.blueprint.address import fact_text, split_fact
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.predicates.measure import measure_text
from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.host.brief import invalid, words_of
from smsl_studio.host.default_decision import decided
from smsl_studio.library.bound import BoundSensor
from smsl_studio.monitor.disturbance import DisturbedSensor, checked
from smsl_studio.monitor.sample import BAD, GOOD, LONGEST, Sample, SensorRound, sample_of

_REMEMBERED = 1000
"""So many different values of sensors are remembered: far more than facts have."""


def _no_values(fact: FactKey) -> Sequence[str]:
    return ()


class SensorSchedule:
    """The sensors of one world, with the number of samples of each since the world was opened.

    ``tick`` is in simulated seconds. ``boot`` counts how often the world was opened. ``values``
    returns the possible values of a fact, in order, for disturbances that change values.
    """

    def __init__(
        self,
        sensors: Iterable[BoundSensor],
        tick: float,
        boot: int,
        values: Callable[[FactKey], Sequence[str]] = _no_values,
        seed: int = 0,
    ) -> None:
        self._sensors = tuple(sensors)
        self._rows = tuple((_ready(one), one.branch, one.digit, one.name) for one in self._sensors)
        self._facts = tuple((one.branch, one.digit) for one in self._sensors)
        self._brief = all(max(len(s.branch), len(s.name)) <= LONGEST for s in self._sensors)
        self._read: set[str] = set()
        """Values that were looked at before, and are readings of a usual length."""
        self._every = tuple(_ticks(sensor.period, tick) for sensor in self._sensors)
        self._indices: Sequence[int] = range(len(self._sensors))
        self._slowest = max(self._every, default=1)
        self._spoken = [0] * len(self._sensors)
        self._boot = boot
        self._values = values
        self._seed = seed
        self._disturbed: dict[int, DisturbedSensor] = {}

    def all(self, subject: Any, time: float) -> tuple[Sample, ...]:
        """Read every sensor. For a disturbed sensor, return the samples that arrive now."""
        if not self._sensors:
            return ()
        return self._heard(self._indices, subject, time)

    def due(self, subject: Any, ticks: int, time: float) -> tuple[Sample, ...]:
        """Read the sensors whose period ends with this tick. Add delayed samples that arrive
        now."""
        due = self._indices
        if not due:
            return ()
        if self._slowest > 1:
            due = [i for i in due if ticks % self._every[i] == 0]
        return self._heard(due, subject, time)

    def disturb(self, target: str, kind: str, parameters: Mapping[str, Any]) -> tuple[str, ...]:
        """Disturb the sensor called ``target``, or all sensors of the fact ``target``
        (``SB/digit``).

        Return the names of the disturbed sensors. An unknown target or kind raises UsageError.
        """
        parameter = checked(kind, parameters)
        met = self._met(target)
        for index in met:
            if index not in self._disturbed:
                sensor = self._sensors[index]
                key = (sensor.branch, sensor.digit)
                seed = f"{self._seed} {fact_text(*key)} {sensor.name}"
                values = () if sensor.unit else self._values(key)
                self._disturbed[index] = DisturbedSensor(values, seed)
            self._disturbed[index].switch(kind, parameter)
        return tuple(self._sensors[index].name for index in met)

    def _met(self, target: str) -> tuple[int, ...]:
        named = tuple(i for i, sensor in enumerate(self._sensors) if sensor.name == target)
        fact = split_fact(target)
        met = named or tuple(
            i for i, sensor in enumerate(self._sensors) if (sensor.branch, sensor.digit) == fact
        )
        if met:
            return met
        names = [sensor.name for sensor in self._sensors]
        facts = [fact_text(sensor.branch, sensor.digit) for sensor in self._sensors]
        raise UsageError(
            f"nothing called {target!r} is sensed", advice=did_you_mean(target, [*names, *facts])
        )

    def _heard(self, indices: Sequence[int], subject: Any, time: float) -> tuple[Sample, ...]:
        if not indices and not self._disturbed:
            return ()
        samples, values = self._samples(indices, subject, time)
        if not self._disturbed:
            if len(values) < len(self._facts) or not self._brief:
                return tuple(samples)
            found = SensorRound(samples)
            found.time, found.facts, found.values = time, self._facts, tuple(values)
            return found
        heard: list[Sample] = []
        for index, sample in zip(indices, samples, strict=True):
            if index in self._disturbed:
                self._disturbed[index].take(sample, time)
            else:
                heard.append(sample)
        for disturbed in self._disturbed.values():
            heard.extend(disturbed.release(time))
        return tuple(heard)

    def _samples(
        self, indices: Sequence[int], subject: Any, time: float
    ) -> tuple[list[Sample], list[str]]:
        """Read these sensors, all in one pass. Return the samples, and the usual values."""
        rows, spoken, boot, read = self._rows, self._spoken, self._boot, self._read
        samples: list[Sample] = []
        usual: list[str] = []
        for index in indices:
            call, branch, digit, name = rows[index]
            spoken[index] = count = spoken[index] + 1
            reason, quality = "", GOOD
            try:
                value = call(subject)
            except KeyboardInterrupt:
                raise
            except BaseException as error:  # SystemExit, and what compiled libraries raise
                value, reason = None, words_of(error, self._sensors[index].location)
            if type(value) is not str or value not in read:
                value, reason = self._weighed(value, reason)
                quality = BAD if value is None else GOOD
            else:
                usual.append(value)
            samples.append(
                sample_of(
                    (branch, digit, name, value, time, count, boot, reason, quality, None, "")
                )
            )
        return samples, usual

    def _weighed(self, value: Any, reason: str) -> tuple[str | None, str]:
        """Return what a sensor returned if it is a reading, or None with the reason."""
        wrong = invalid(value)
        if wrong:
            return None, wrong
        if value is None:
            return None, reason or "no valid reading"
        if len(self._read) < _REMEMBERED and len(value) <= LONGEST:
            self._read.add(value)
        return str(value), reason


def _ready(sensor: BoundSensor) -> Callable[[Any], Any]:
    """Return the function of a sensor with its arguments, to be called with the world."""
    if sensor.default is not None:
        return decided(sensor.default)
    plain = partial(sensor.function, **sensor.arguments) if sensor.arguments else sensor.function
    return partial(_measured, plain, sensor.scale) if sensor.unit else plain


def _measured(function: Callable[[Any], Any], scale: float, subject: Any) -> str | None:
    """Return what a sensor measures as a sample carries it. ValueError if it is no number."""
    value = function(subject)
    if value is None:
        return None
    text = measure_text(value, scale)
    if text is None:
        raise ValueError("it returned no finite number and no position of three")
    return text


def _ticks(period: float, tick: float) -> int:
    """Return the period in whole ticks, rounded up, at least one. A tiny rounding error of the
    division does not add a tick."""
    return max(1, math.ceil(period / tick - 1e-6))
