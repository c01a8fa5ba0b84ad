"""The sensors of a program elsewhere: checks what they read, and disturbs it for trials."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from smsl_studio.blueprint.address import fact_text, split_fact
from smsl_studio.blueprint.predicates.measure import measure_of
from smsl_studio.channel.frames import ChannelError
from smsl_studio.channel.moment import ToldSample
from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.host.program_offer import ProgramOffer
from smsl_studio.host.protocol import SensorInfo
from smsl_studio.monitor.disturbance import DisturbedSensor, checked
from smsl_studio.monitor.sample import BAD, Sample

BOOT = 1
"""A program is opened once in a run, so its sensors start once."""


class ProgramSensors:
    """The sensors that an offer has for a blueprint."""

    def __init__(self, offer: ProgramOffer, seed: int) -> None:
        self._seed = seed
        self._offer = offer
        self._sensors = {(fact_text(one.branch, one.digit), one.name): one for one in offer.sensors}
        self._values = {key: offer.values(one) for key, one in self._sensors.items()}
        self._disturbed: dict[tuple[str, str], DisturbedSensor] = {}

    def heard(self, told: Sequence[ToldSample], now: float) -> tuple[Sample, ...]:
        """Return the samples that arrive at ``now`` (s). ChannelError if one is of no sensor, or
        reads no value of its fact."""
        heard: list[Sample] = []
        for one in told:
            key = (one.fact, one.sensor)
            info = self._sensors.get(key)
            if info is None:
                if key in self._offer.unbound:
                    continue
                raise ChannelError(f"{one.sensor[:60]!r} of {one.fact[:60]!r} was not offered")
            self._check(one, info)
            quality = one.quality if one.value is not None else BAD
            sample = Sample(info.branch, info.digit, info.name, one.value, one.time, one.sequence,
                            BOOT, one.reason, quality)  # fmt: skip
            disturbed = self._disturbed.get(key)
            if disturbed is None:
                heard.append(sample)
            else:
                disturbed.take(sample, now)
        for disturbed in self._disturbed.values():
            heard.extend(disturbed.release(now))
        return tuple(heard)

    def disturb(
        self, target: str, kind: str, parameters: Mapping[str, float | str]
    ) -> tuple[str, ...]:
        """Disturb the sensors of a name or a fact. Return their names. UsageError if there are
        none."""
        parameter = checked(kind, parameters)
        fact = split_fact(target)
        met = [key for key, one in self._sensors.items() if one.name == target] or [
            key for key, one in self._sensors.items() if (one.branch, one.digit) == fact
        ]
        if not met:
            known = [text for key in self._sensors for text in key]
            advice = did_you_mean(target, known)
            raise UsageError(f"nothing called {target!r} is sensed", advice=advice)
        for key in met:
            if key not in self._disturbed:
                one = self._sensors[key]
                values = () if one.unit else self._offer.alphabet(one)
                self._disturbed[key] = DisturbedSensor(values, f"{self._seed} {key[0]} {key[1]}")
            self._disturbed[key].switch(kind, parameter)
        return tuple(name for _, name in met)

    def _check(self, one: ToldSample, info: SensorInfo) -> None:
        if one.value is None:
            return
        if info.unit:
            wrong = measure_of(one.value, None)
            if isinstance(wrong, str):
                raise ChannelError(f"{info.name}: {wrong}")
        elif one.value not in self._values[one.fact, one.sensor]:
            words = f"{info.name} reads {one.value[:40]!r}, which is no value of {one.fact}"
            raise ChannelError(words)
