"""The run's senses: what the host's sensors say, as the scene and as events."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from smsl_studio.blueprint.check import FactKey, Scene
from smsl_studio.host.protocol import Host, Opened, Tick
from smsl_studio.monitor.bus import FactBus
from smsl_studio.monitor.facts import FactMonitor, SourceState
from smsl_studio.monitor.sample import Sample
from smsl_studio.runlog.events import FactChanged


class Senses:
    """Time, scene and the last sensed value of every fact of one run.

    Whatever is sensed comes over ``bus``: what the host's sensors say, what sensors elsewhere say
    (``Opened.remote``), and what anybody else publishes there. Those elsewhere age on the
    monotonic clock, all others on that of the run.
    """

    def __init__(self, host: Host, opened: Opened) -> None:
        self._host = host
        self._remote = opened.remote
        self.bus = FactBus()
        self._inbox = self.bus.subscribe()
        self._monitor = FactMonitor(opened.sensors, opened.rules)
        self._told: dict[FactKey, str | None] = {}
        self.time = 0.0
        self.scene = Scene()

    def look(self) -> tuple[FactChanged, ...]:
        """Read every sensor once, now; what changed."""
        samples = self._host.sense()
        self.time = max((self.time, *(sample.time for sample in samples)))
        return self._take(samples)

    def listen(self) -> tuple[FactChanged, ...]:
        """While simulated time stands still: what sensors elsewhere say meanwhile."""
        return self._take(()) if self._remote is not None else ()

    def tick(self) -> tuple[Tick, tuple[FactChanged, ...]]:
        """Let the host go on for one tick; what it brought and what changed."""
        tick = self._host.tick()
        self.time = tick.time
        return tick, self._take(tick.samples)

    @property
    def sources(self) -> tuple[SourceState, ...]:
        """Every source of every fact as it stands now."""
        return self._monitor.sources(self.time, self._live)

    def answer(
        self, branch: str, digit: int, value: str | None, who: str
    ) -> tuple[FactChanged, ...]:
        """A person says what a fact is that no sensor may answer; what changed."""
        self._monitor.answer(branch, digit, value, who, self.time)
        return self._take(())

    def _take(self, samples: Iterable[Sample]) -> tuple[FactChanged, ...]:
        self.bus.publish(samples)
        if self._remote is not None:
            self.bus.publish(self._remote.heard())
        self._monitor.accept(self._inbox.take(), self.time)
        self.scene = self._monitor.scene(self.time, self._live)
        return tuple(self._changes())

    @property
    def _live(self) -> float:
        return self._remote.clock() if self._remote is not None else 0.0

    def _changes(self) -> Iterator[FactChanged]:
        for key, reading in self.scene.readings.items():
            if key in self._told and self._told[key] == reading.value:
                continue
            self._told[key] = reading.value
            yield FactChanged(
                t=self.time,
                branch=key[0],
                digit=key[1],
                value=reading.value,
                reason=reading.reason if reading.value is None else "",
            )
