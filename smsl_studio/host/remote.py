"""Sensors over a network: a host that adds their samples to those of another host.

It runs in the dispatcher's process and wraps the other host. Messages are fetched when the run asks
for them. A slow network, a dead broker or too many messages make facts unknown, but delay no tick.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from threading import Event as Flag
from time import monotonic
from typing import Protocol

from smsl_studio.blueprint.address import Address, fact_text, split_fact
from smsl_studio.blueprint.check import FactKey
from smsl_studio.errors import HostError, UsageError
from smsl_studio.host.protocol import Happened, Host, OpenedWorld, Priced, SensorInfo, Tick
from smsl_studio.monitor.aggregate import FactRule
from smsl_studio.monitor.disturbance import DisturbedSensor, checked
from smsl_studio.monitor.reception import Reception, RemoteView
from smsl_studio.monitor.sample import Sample
from smsl_studio.stop import heed

HELLO = 3.0
"""Wall seconds in which every source must have spoken for the first time."""
LOOK = 0.01


class Feed(Protocol):
    """What brings messages to a reception (see ``monitor.mqtt.BrokerLink``)."""

    @property
    def broker(self) -> str:
        """Where the broker is: ``HOST``, ``HOST:PORT`` or ``[V6]:PORT``."""

    @property
    def connected(self) -> bool:
        """Whether the broker is there, as far as is known."""

    @property
    def lost(self) -> float | None:
        """For how long (s) the broker has been gone; None while it is there."""

    @property
    def connections(self) -> int:
        """How often a connection was made."""

    def open(self) -> None:
        """Connect to the broker; RunRefused where there is none."""

    def close(self) -> None:
        """End the connection."""


class Remote:
    """The network sources of one run."""

    def __init__(
        self,
        line: Feed,
        reception: Reception,
        sensors: Sequence[SensorInfo],
        values: Mapping[FactKey, Sequence[str]],
        seed: int,
    ) -> None:
        self.sensors = tuple(sensors)
        self._line, self._reception = line, reception
        self._closed = Flag()
        self._values, self._seed = values, seed
        self._disturbed: dict[tuple[str, int, str], DisturbedSensor] = {}

    def clock(self) -> float:
        """This computer's monotonic seconds, on which samples from elsewhere age."""
        return monotonic()

    def open(self) -> None:
        """Connect, and wait at most ``HELLO`` s for every source. RunRefused: there is no
        broker."""
        self._line.open()
        until = monotonic() + HELLO
        while self._reception.silent and monotonic() < until:
            if self._closed.wait(LOOK):
                raise HostError("the host is closed")
            heed()

    def heard(self) -> tuple[Sample, ...]:
        """The newest sample of each source since the last time, disturbed where that is on."""
        samples = self._reception.take()
        if not self._disturbed:
            return samples
        now, passed = monotonic(), []
        for sample in samples:
            disturbed = self._disturbed.get((*sample.fact, sample.source))
            if disturbed is None:
                passed.append(sample)
            else:
                disturbed.take(sample, now)
        for disturbed in self._disturbed.values():
            passed.extend(one._replace(received=now) for one in disturbed.release(now))
        return tuple(passed)

    def disturb(self, target: str, kind: str, parameters: Mapping[str, object]) -> tuple[str, ...]:
        """Disturb the sensors it meets; the empty tuple where there is none of this name."""
        parameter = checked(kind, parameters)
        named = [sensor for sensor in self.sensors if sensor.name == target]
        fact = split_fact(target)
        met = named or [s for s in self.sensors if (s.branch, s.digit) == fact]
        for sensor in met:
            key = (sensor.branch, sensor.digit, sensor.name)
            if key not in self._disturbed:
                values = self._values.get(key[:2], ())
                seed = f"{self._seed} {fact_text(*key[:2])} {sensor.name}"
                self._disturbed[key] = DisturbedSensor(values, seed)
            self._disturbed[key].switch(kind, parameter)
        return tuple(sensor.name for sensor in met)

    def view(self) -> RemoteView:
        """How the network stands now; any thread may ask."""
        line, reception = self._line, self._reception
        return RemoteView(
            line.broker,
            reception.site,
            reception.run,
            line.lost,
            line.connections,
            reception.nodes(monotonic()),
            reception.received,
        )

    def close(self) -> None:
        """End the connection, also while ``open`` waits for a source."""
        self._closed.set()
        self._line.close()


class WithRemote:
    """A host that does what another one does, and has further sensors over a network.

    ``rules`` are those of the facts that are told from elsewhere. ``alone`` are facts that only the
    network senses: samples of the world for them are dropped (the table world has every fact
    anyhow).
    """

    def __init__(
        self,
        inner: Host,
        remote: Remote,
        rules: Mapping[FactKey, FactRule],
        alone: frozenset[FactKey] = frozenset(),
    ) -> None:
        self.inner = inner
        self.remote = remote
        self._rules, self._alone = rules, alone

    def open(self, start: Mapping[str, str]) -> OpenedWorld:
        """Build the world, then connect; RunRefused where there is no broker."""
        opened = self.inner.open(start)
        self.remote.open()
        sensors = [*opened.sensors, *self.remote.sensors]
        kept = [s for s in sensors if s.remote or (s.branch, s.digit) not in self._alone]
        patience = max(sensor.max_age for sensor in self.remote.sensors)
        return replace(
            opened,
            sensors=tuple(sorted(kept, key=self._place)),
            rules={**opened.rules, **self._rules},
            # Samples from before the end of an operation are too old when its target is checked.
            settle=max(opened.settle, patience),
            remote=self.remote,
        )

    def sense(self) -> tuple[Sample, ...]:
        """Every sensor of the world once."""
        return self._sensed(self.inner.sense())

    def begin(self, edge: Address) -> None:
        """Start the library function bound to an edge."""
        self.inner.begin(edge)

    def tick(self) -> Tick:
        """One tick of the world."""
        tick = self.inner.tick()
        return tick._replace(samples=self._sensed(tick.samples)) if self._alone else tick

    def cancel(self, mode: str) -> None:
        """End the running call."""
        self.inner.cancel(mode)

    def disturb(self, target: str, kind: str, **parameters: float | str) -> tuple[str, ...]:
        """Disturb sensors of the world, elsewhere, or both (all of one fact)."""
        elsewhere = self.remote.disturb(target, kind, parameters)
        if elsewhere and (split_fact(target) is None or split_fact(target) in self._alone):
            return elsewhere
        try:
            return (*self.inner.disturb(target, kind, **parameters), *elsewhere)
        except UsageError:
            if elsewhere:
                return elsewhere
            raise

    def inject(self, fault: str, **parameters: float | str) -> None:
        """Something goes wrong in the world on purpose."""
        self.inner.inject(fault, **parameters)

    def costs(self, scene: Mapping[str, str | None], happened: Sequence[Happened]) -> Priced:
        """What the cost functions of the world's plugin say."""
        return self.inner.costs(scene, happened)

    def poses(self) -> tuple[float, ...]:
        """The newest poses of the world."""
        return self.inner.poses()

    def status(self) -> Mapping[str, str]:
        """The world's short words for people."""
        return self.inner.status()

    def check(self) -> None:
        """HostError where the inner host is gone; a dead broker costs facts, not the run."""
        self.inner.check()

    def close(self) -> None:
        """End the connection and the world; twice is harmless."""
        self.remote.close()
        self.inner.close()

    def _sensed(self, samples: tuple[Sample, ...]) -> tuple[Sample, ...]:
        return tuple(sample for sample in samples if sample.fact not in self._alone)

    def _place(self, sensor: SensorInfo) -> int:
        """Sensors of one fact count in the order in which they are named."""
        rule = self._rules.get((sensor.branch, sensor.digit))
        names = rule.sensors if rule else ()
        return names.index(sensor.name) if sensor.name in names else len(names)
