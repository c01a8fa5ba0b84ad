"""Disturbances of sensors, for trials: stuck, drift, noise, dropout in this order, then delay."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite
from random import Random
from typing import Any

from .errors import UsageError, did_you_mean

HAIR = 1e-9
PARAMETERS: Mapping[str, tuple[str, Any]] = {
    "stuck": ("value", None),
    "drift": ("every", 1.0),
    "noise": ("rate", 0.1),
    "dropout": ("rate", 1.0),
    "delay": ("seconds", 0.1),
    "none": ("", None),
}
"""The parameter of each kind, and what it is by default."""


@dataclass(frozen=True)
class Sample:
    """One reading of a sensor: its value, when it was read (s), and its number."""

    value: str | None
    time: float
    number: int


def checked(kind: str, given: Mapping[str, Any]) -> Any:
    """Return the parameter of a kind. UsageError if the kind or the parameter makes no sense."""
    if kind not in PARAMETERS:
        known = ", ".join(PARAMETERS)
        near = did_you_mean(kind, PARAMETERS) or f"There are {known}."
        raise UsageError(f"there is no disturbance {kind!r}", near)
    name, usual = PARAMETERS[kind]
    for other in given:
        if other != name:
            advice = f"It may say {name}." if name else ""
            raise UsageError(f"the disturbance {kind} has no {other!r}", advice)
    value = given.get(name, usual)
    if kind in ("stuck", "none"):
        if value is not None and not isinstance(value, str):
            raise UsageError(f"a sensor is stuck at a text, not at {value!r}")
        return value
    most = 1.0 if name == "rate" else 1e6
    number = isinstance(value, (int, float)) and not isinstance(value, bool) and isfinite(value)
    if not number or not 0 <= value <= most or (kind == "drift" and value == 0):
        least = "above 0" if kind == "drift" else "0"
        raise UsageError(f"{name} of {kind} is {value!r}, not a number from {least} to {most:g}")
    return float(value)


class DisturbedSensor:
    """The disturbances of one sensor. ``values`` are those of its fact, ``seed`` decides chance."""

    def __init__(self, values: Sequence[str], seed: str) -> None:
        self._values, self._seed, self._switched = values, seed, 0
        self._on: dict[str, Any] = {}
        self._chances: dict[str, Random] = {}
        self._delay = 0.0
        self._held: list[tuple[float, Sample]] = []

    def switch(self, kind: str, parameter: Any) -> None:
        """Begin one kind anew. The kind ``none`` ends all of them."""
        self._switched += 1
        self._chances[kind] = Random(f"{self._seed} {kind} {self._switched}")
        if kind == "none":
            self._on, self._delay = {}, 0.0
        elif kind == "delay":
            self._delay = parameter
        else:
            self._on[kind] = {"parameter": parameter}

    def take(self, sample: Sample, now: float) -> None:
        """Accept a sample that the sensor sends now."""
        for kind in ("stuck", "drift", "noise", "dropout"):
            if kind in self._on:
                passed = getattr(self, f"_{kind}")(sample, self._on[kind])
                if passed is None:
                    return
                sample = passed
        self._held.append((now + self._delay, sample))

    def release(self, now: float) -> list[Sample]:
        """Return the samples that arrive now, in the order in which they were sent."""
        arrived = [sample for due, sample in self._held if due <= now + HAIR]
        self._held = [one for one in self._held if one[0] > now + HAIR]
        return arrived

    def _stuck(self, sample: Sample, memory: dict[str, Any]) -> Sample:
        if memory["parameter"] is None:
            memory["parameter"] = sample.value
        return replace(sample, value=memory["parameter"])

    def _drift(self, sample: Sample, memory: dict[str, Any]) -> Sample:
        since = memory.setdefault("since", sample.time)
        if sample.value not in self._values:
            return sample
        steps = int((sample.time - since + HAIR) / memory["parameter"])
        at = self._values.index(sample.value) + steps
        return replace(sample, value=self._values[min(at, len(self._values) - 1)])

    def _noise(self, sample: Sample, memory: dict[str, Any]) -> Sample:
        chance = self._chances["noise"]
        wrong = chance.random() < memory["parameter"]
        others = [value for value in self._values if value != sample.value]
        if not wrong or sample.value is None or not others:
            return sample
        return replace(sample, value=chance.choice(others))

    def _dropout(self, sample: Sample, memory: dict[str, Any]) -> Sample | None:
        lost = self._chances["dropout"].random() < memory["parameter"]
        return None if lost else sample
