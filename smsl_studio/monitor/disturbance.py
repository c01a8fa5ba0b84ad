"""Disturbances between a sensor and the monitor, for tests.

The kinds act in this order, each at most once on a sensor: ``stuck``, ``drift`` and ``noise``
change the value, ``dropout`` loses the sample, ``delay`` delays it. A seed makes equal runs have
equal disturbances. Values have no numeric meaning. So a drift moves along the fact's values in
their order, and noise replaces a value by any other value of the fact.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from random import Random
from typing import Any, Protocol

from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.monitor.sample import BAD, GOOD, Sample

NONE = "none"
"""The kind that ends all disturbances of a sensor."""

HAIR = 1e-9

Parameter = str | float


class Disturbance(Protocol):
    """One kind of disturbance of the samples of one sensor, from its creation on."""

    def passes(self, sample: Sample) -> Sample | None:
        """Return the disturbed sample. None if it is lost."""
        ...


class Stuck:
    """The sensor always reads the same value: ``value``, or its first reading if that is None."""

    def __init__(self, value: str | None) -> None:
        self._value = value
        self._caught = value is not None

    def passes(self, sample: Sample) -> Sample | None:
        """Return the sample with the value at which the sensor is stuck."""
        if not self._caught:
            self._value, self._caught = sample.value, True
        if self._value is None:
            return sample._replace(value=None, reason="no valid reading", quality=BAD)
        return sample._replace(value=self._value, reason="", quality=GOOD)


class Drift:
    """The reading moves on by one value every ``every`` seconds, and stays at the last value."""

    def __init__(self, every: float, values: Sequence[str]) -> None:
        self._every, self._values = every, tuple(values)
        self._since: float | None = None

    def passes(self, sample: Sample) -> Sample | None:
        """Return the sample with its value moved on by the time since the first sample."""
        if self._since is None:
            self._since = sample.time
        if sample.value not in self._values:
            return sample
        steps = int((sample.time - self._since + HAIR) / self._every)
        at = self._values.index(sample.value) + steps
        return sample._replace(value=self._values[min(at, len(self._values) - 1)])


class Noise:
    """A share of the samples (``rate``, 0 to 1) gets another value."""

    def __init__(self, rate: float, values: Sequence[str], chance: Random) -> None:
        self._rate, self._values, self._chance = rate, tuple(values), chance

    def passes(self, sample: Sample) -> Sample | None:
        """Return the sample, by chance with another value."""
        wrong = self._chance.random() < self._rate
        others = [value for value in self._values if value != sample.value]
        if not wrong or sample.value is None or not others:
            return sample
        return sample._replace(value=self._chance.choice(others))


class Dropout:
    """A share of the samples (``rate``, 0 to 1) is lost."""

    def __init__(self, rate: float, chance: Random) -> None:
        self._rate, self._chance = rate, chance

    def passes(self, sample: Sample) -> Sample | None:
        """Return the sample, or by chance None."""
        return None if self._chance.random() < self._rate else sample


ORDER = ("stuck", "drift", "noise", "dropout")
KINDS = (*ORDER, "delay", NONE)

PARAMETERS: Mapping[str, tuple[str, Parameter | None]] = {
    "stuck": ("value", None),
    "drift": ("every", 1.0),
    "noise": ("rate", 0.1),
    "dropout": ("rate", 1.0),
    "delay": ("seconds", 0.1),
}
"""The parameter of each kind, and its default."""


def checked(kind: str, parameters: Mapping[str, Any]) -> Parameter | None:
    """Return the parameter of a kind, or its default. UsageError if the kind or the parameter is
    not valid."""
    if kind == NONE and not parameters:
        return None
    if kind not in KINDS:
        near = did_you_mean(kind, KINDS) or f"There are {', '.join(KINDS)}."
        raise UsageError(f"there is no disturbance {kind!r}", advice=near)
    name, default = PARAMETERS.get(kind, ("", None))
    for other in parameters:
        if other != name:
            advice = f"It may say {name}." if name else ""
            raise UsageError(f"the disturbance {kind} has no {other!r}", advice=advice)
    given = parameters.get(name, default)
    if kind == "stuck":
        if given is not None and not isinstance(given, str):
            raise UsageError(f"a sensor is stuck at a text, not at {given!r}")
        return given
    most = 1.0 if name == "rate" else 1e6
    number = isinstance(given, int | float) and not isinstance(given, bool) and isfinite(given)
    if not number or not 0 <= given <= most or (kind == "drift" and given == 0):
        least = "above 0" if kind == "drift" else "0"
        raise UsageError(f"{name} of {kind} is {given!r}, not a number from {least} to {most:g}")
    return float(given)


class DisturbedSensor:
    """Applies the disturbances of one sensor to its samples.

    ``values`` are the possible values of its fact, in order. ``seed`` decides all random choices.
    """

    def __init__(self, values: Sequence[str], seed: str) -> None:
        self._values = tuple(values)
        self._seed = seed
        self._switched = 0
        self._on: dict[str, Disturbance] = {}
        self._delay = 0.0
        self._held: list[tuple[float, Sample]] = []

    def switch(self, kind: str, parameter: Parameter | None) -> None:
        """Begin one kind of disturbance anew with its checked parameter. ``NONE`` ends all kinds.

        Samples that are already delayed still arrive at their times.
        """
        self._switched += 1
        chance = Random(f"{self._seed} {kind} {self._switched}")
        if kind == NONE:
            self._on, self._delay = {}, 0.0
        elif kind == "delay":
            assert isinstance(parameter, float)
            self._delay = parameter
        elif kind == "stuck":
            assert not isinstance(parameter, float)
            self._on[kind] = Stuck(parameter)
        else:
            assert isinstance(parameter, float)
            self._on[kind] = self._made(kind, parameter, chance)

    def take(self, sample: Sample, now: float) -> None:
        """Accept a sample that the sensor sends at ``now`` (s)."""
        for kind in ORDER:
            if kind in self._on:
                passed = self._on[kind].passes(sample)
                if passed is None:
                    return
                sample = passed
        self._held.append((now + self._delay, sample))

    def release(self, now: float) -> tuple[Sample, ...]:
        """Return the samples that arrive by ``now`` (s), in the order in which they were sent."""
        arrived = tuple(sample for due, sample in self._held if due <= now + HAIR)
        self._held = [one for one in self._held if one[0] > now + HAIR]
        return arrived

    def _made(self, kind: str, parameter: float, chance: Random) -> Disturbance:
        if kind == "drift":
            return Drift(parameter, self._values)
        if kind == "noise":
            return Noise(parameter, self._values, chance)
        return Dropout(parameter, chance)
