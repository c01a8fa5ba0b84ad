"""Sensors over a network: a host that adds their samples to the samples of another host (paper,
State Monitoring Wireless Sensor Network).

The host runs in the dispatcher's process and wraps the other host. Messages are fetched when the
run asks for them. A slow network, a dead broker or too many messages make facts unknown, but delay
no tick.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from threading import Event as Flag
from time import monotonic
from typing import Protocol

from smsl_studio.blueprint.address import Address, fact_text, split_fact
from smsl_studio.blueprint.check import FactKey
from smsl_studio.errors import HostError, UsageError
from smsl_studio.host.protocol import (
    Bound,
    Extending,
    Happened,
    Host,
    OpenedWorld,
    Priced,
    SensorInfo,
    Telling,
    Tick,
)
from smsl_studio.monitor.aggregate import FactRule
from smsl_studio.monitor.disturbance import DisturbedSensor, checked
from smsl_studio.monitor.reception import Reception, RemoteView
from smsl_studio.monitor.sample import Sample
from smsl_studio.runlog.event import Event
from smsl_studio.stop import heed

HELLO = 3.0
"""The wall time (s) that ``Remote.open`` waits for a first message of every source."""
LOOK = 0.01


class Feed(Protocol):
    """A connection that brings messages to a reception (see ``monitor.mqtt.BrokerLink``)."""

    @property
    def broker(self) -> str:
        """The address of the broker: ``HOST``, ``HOST:PORT`` or ``[V6]:PORT``."""

    @property
    def secure(self) -> bool:
        """Whether the connections are encrypted."""

    @property
    def connected(self) -> bool:
        """Whether the broker is connected, as far as is known."""

    @property
    def lost(self) -> float | None:
        """The time (s) since the connection was lost. None while there is a connection."""

    @property
    def connections(self) -> int:
        """The number of connections made so far."""

    def open(self) -> None:
        """Connect to the broker. RunRefused if there is none."""

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
        """Return this computer's monotonic time (s). The age of remote samples is measured on
        it."""
        return monotonic()

    def open(self) -> None:
        """Connect, and wait at most ``HELLO`` seconds for a message of every source. RunRefused if
        there is no broker, HostError if the run is closed meanwhile."""
        self._line.open()
        until = monotonic() + HELLO
        while self._reception.silent and monotonic() < until:
            self.wait()

    def wait(self) -> None:
        """Wait a moment for further messages. HostError if the run is closed meanwhile."""
        if self._closed.wait(LOOK):
            raise HostError("the host is closed")
        heed()

    def heard(self) -> tuple[Sample, ...]:
        """Return the newest sample of each source since the last call, with disturbances
        applied."""
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
        """Disturb the sensors of a name or a fact. Return their names; the tuple may be empty."""
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
        """Return the present state of the network. Any thread may call it."""
        line, reception = self._line, self._reception
        return RemoteView(
            line.broker,
            reception.site,
            reception.run,
            line.lost,
            line.connections,
            reception.nodes(monotonic()),
            reception.received,
            line.secure,
        )

    def close(self) -> None:
        """End the connection, even while ``open`` waits for a source."""
        self._closed.set()
        self._line.close()


class WithRemote:
    """A host that wraps another host and adds sensors over a network.

    ``rules`` are the aggregation rules of the facts that remote sensors read. ``alone`` are facts
    that only remote sensors read. The wrapped host's samples of these facts are dropped, because
    the table world has a sensor for every fact.
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
        """Build the world, then connect. RunRefused if there is no broker."""
        opened = self.inner.open(start)
        self.remote.open()
        sensors = [*opened.sensors, *self.remote.sensors]
        kept = [s for s in sensors if s.remote or (s.branch, s.digit) not in self._alone]
        patience = max(sensor.max_age for sensor in self.remote.sensors)
        return replace(
            opened,
            sensors=tuple(sorted(kept, key=self._place)),
            rules={**opened.rules, **self._rules},
            # After this time the samples from before the end of an operation are too old to count.
            settle=max(opened.settle, patience),
            remote=self.remote,
        )

    def hear(self, tell: Callable[[Event], None]) -> None:
        """Let the wrapped host tell the events of its procedures."""
        if isinstance(self.inner, Telling):
            self.inner.hear(tell)

    @property
    def holding(self) -> str:
        """Why a procedure of the wrapped host holds. Empty if none does."""
        return self.inner.holding if isinstance(self.inner, Telling) else ""

    def sense(self) -> tuple[Sample, ...]:
        """Read every sensor of the world once."""
        return self._sensed(self.inner.sense())

    def begin(self, edge: Address) -> None:
        """Start the library function bound to an edge."""
        self.inner.begin(edge)

    def tick(self) -> Tick:
        """Advance the world by one tick."""
        tick = self.inner.tick()
        return tick._replace(samples=self._sensed(tick.samples)) if self._alone else tick

    def cancel(self, mode: str) -> None:
        """End the running call."""
        self.inner.cancel(mode)

    def disturb(self, target: str, kind: str, **parameters: float | str) -> tuple[str, ...]:
        """Disturb sensors of the world, remote sensors, or both (all sensors of one fact)."""
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
        """Cause a fault of the world."""
        self.inner.inject(fault, **parameters)

    def costs(self, scene: Mapping[str, str | None], happened: Sequence[Happened]) -> Priced:
        """Ask the cost functions of the world's plugin."""
        return self.inner.costs(scene, happened)

    def suppose(self, edge: Address) -> None:
        """Make the guard of an edge agree."""
        self.inner.suppose(edge)

    def extend(self, edge: Address, target: str) -> tuple[Bound | None, bool]:
        """Let the host inside bind one more edge, if it can."""
        inner = self.inner
        return inner.extend(edge, target) if isinstance(inner, Extending) else (None, False)

    def poses(self) -> tuple[float, ...]:
        """Return the newest poses of the world."""
        return self.inner.poses()

    def status(self) -> Mapping[str, str]:
        """Return the world's short status texts for people."""
        return self.inner.status()

    def check(self) -> None:
        """Raise HostError if the wrapped host is gone. A dead broker only makes facts unknown."""
        self.inner.check()

    def close(self) -> None:
        """End the connection and the world. A second call does nothing."""
        self.remote.close()
        self.inner.close()

    def _sensed(self, samples: tuple[Sample, ...]) -> tuple[Sample, ...]:
        return tuple(sample for sample in samples if sample.fact not in self._alone)

    def _place(self, sensor: SensorInfo) -> int:
        """The sort key of a sensor: sensors of one fact keep the order in which they are named."""
        rule = self._rules.get((sensor.branch, sensor.digit))
        names = rule.sensors if rule else ()
        return names.index(sensor.name) if sensor.name in names else len(names)
