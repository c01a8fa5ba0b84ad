"""The senses of a run: the samples of sensors, as the scene and as events."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from operator import attrgetter
from types import MappingProxyType
from typing import NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import NOTHING_SENSED, FactKey, Reading, Scene
from smsl_studio.host.protocol import Host, OpenedWorld, Tick
from smsl_studio.monitor.aggregate import FactRule
from smsl_studio.monitor.bus import FactBus
from smsl_studio.monitor.facts import FactMonitor, SourceState
from smsl_studio.monitor.measure_record import MeasureRecord
from smsl_studio.monitor.sample import Sample
from smsl_studio.runlog.events import FactChanged, Measured
from smsl_studio.runlog.quick import fact_changed, measured


@dataclass(slots=True)
class _Doubt:
    """Why a fact is unknown since a time, and how many samples each of its sources had sent by
    then.
    """

    reason: str
    since: float
    counted: dict[str, int]

    def ends(self, source: SourceState) -> bool:
        """Whether a source has sent a new sample. One that was read before the doubt, and came
        late, says nothing about the fact now.
        """
        sample = source.sample
        early = sample is not None and sample.received is None and sample.time < self.since
        return source.counted > self.counted[source.said.source] and not early


_TIME = attrgetter("time")


class Moment(NamedTuple):
    """A time on the run's clock (simulated s), and on the clock of remote sensors (s)."""

    time: float
    live: float


SensedEvent = Measured | FactChanged


class Senses:
    """The time, the scene, and the last sensed value of every fact of one run.

    All samples come over ``bus``: those of the host's sensors, of remote sensors
    (``OpenedWorld.remote``), and of anybody else who publishes there. Remote samples age on the
    monotonic clock, all others in simulated time. ``rules`` say how facts follow from samples.

    ``whole`` says that the last tick has read every sensor and each has a value. Then another look
    at the same instant shows nothing new, as long as nothing but time has acted on the world.
    """

    def __init__(self, host: Host, opened: OpenedWorld, rules: Mapping[FactKey, FactRule]) -> None:
        self._host = host
        self._remote = opened.remote
        self.bus = FactBus()
        self._inbox = self.bus.subscribe()
        self._monitor = FactMonitor(opened.sensors, rules)
        sensed = self._monitor.sensed
        self._record = MeasureRecord(sensed) if sensed else None
        """What the log keeps of measures, None if no fact is decided from any."""
        self._told: dict[FactKey, str | None] = {}
        self._compared = NOTHING_SENSED
        """The readings that were last compared with what was told."""
        self._doubts: dict[FactKey, _Doubt] = {}
        self.time = 0.0
        self.scene = Scene()
        self.whole = False
        self._disturbed = False

    def look(self) -> tuple[SensedEvent, ...]:
        """Read every sensor once, and return the changed facts."""
        samples = self._host.sense()
        if samples:
            self.time = max((self.time, *map(_TIME, samples)))
        return self._take(samples)

    def listen(self) -> tuple[SensedEvent, ...]:
        """Return the facts that remote sensors have changed while simulated time stands still."""
        return self._take(()) if self._remote is not None else ()

    def tick(self) -> tuple[Tick, tuple[SensedEvent, ...]]:
        """Make one tick of the host. Return its result and the changed facts."""
        tick = self._host.tick()
        self.time = tick.time
        changes = self._take(tick.samples)
        self.whole = self._monitor.whole and not (self._disturbed or self._doubts)
        return tick, changes

    def distrust(self) -> None:
        """Note that a sensor is disturbed. It may say another thing at the same instant."""
        self._disturbed = True

    @property
    def sensed(self) -> tuple[FactKey, ...]:
        """The facts that a sensor or a person reports, in order of SB and digit."""
        return tuple(sorted(key for key, one in self.scene.readings.items() if one.sensed))

    @property
    def sources(self) -> tuple[SourceState, ...]:
        """The current state of every source of every fact."""
        return self._monitor.sources(self.time, self._live)

    @property
    def moment(self) -> Moment:
        """The current time on both clocks."""
        return Moment(self.time, self._live if self._remote is not None else 0.0)

    def measures(self) -> dict[str, tuple[float, ...]]:
        """Return the last number of each source that the log has, by ``SB/digit/source``."""
        found = {} if self._record is None else self._record.newest()
        return {
            f"{Address(branch)}/{digit}/{source}": numbers
            for ((branch, digit), source), numbers in found.items()
        }

    def late(self, since: Moment, facts: Collection[FactKey]) -> tuple[FactKey, ...]:
        """Return those of some facts that rest on a reading which is not newer than a time.

        An answer of a person counts until it is given again. A source without a value is not waited
        for.
        """
        found = dict.fromkeys(
            source.fact
            for source in self.sources
            if source.fact in facts and source.said.value is not None and not _newer(source, since)
        )
        return tuple(found)

    def answer(
        self, branch: str, digit: int, value: str | None, who: str
    ) -> tuple[SensedEvent, ...]:
        """Take the value that a person tells for a fact. Return the changed facts."""
        self._monitor.answer(branch, digit, value, who, self.time)
        self._doubts.pop((branch, digit), None)
        return self._take(())

    def forget(self, facts: Iterable[FactKey]) -> tuple[SensedEvent, ...]:
        """Forget what people have told about these facts. They must be asked again."""
        said = set(self._monitor.answered()) & set(facts)
        for branch, digit in said:
            self._monitor.answer(branch, digit, None, "", self.time)
        return self._take(()) if said else ()

    def doubt(self, facts: Iterable[FactKey], reason: str) -> tuple[SensedEvent, ...]:
        """Make facts unknown until they are sensed again. Return the changed facts.

        Every source that has sent samples of a fact must send a new one. A fact that nobody senses
        stays unknown until a person answers or vouches for it.
        """
        fresh = {key: _Doubt(reason, self.time, {}) for key in sorted(set(facts))}
        for source in self.sources if fresh else ():
            if source.fact in fresh:
                fresh[source.fact].counted[source.said.source] = source.counted
        self._doubts |= fresh
        return self._take(())

    @property
    def vouched(self) -> Scene:
        """The scene without the doubtful facts that nobody senses, as if a person vouched for
        them.
        """
        unsensed = {key for key, doubt in self._doubts.items() if not doubt.counted}
        if not unsensed:
            return self.scene
        kept = {key: one for key, one in self.scene.readings.items() if key not in unsensed}
        return Scene(MappingProxyType(kept), self.scene.time)

    def vouch(self) -> None:
        """Remove the doubt from facts that nobody senses, because a person vouches for their
        believed values.
        """
        self._doubts = {key: doubt for key, doubt in self._doubts.items() if doubt.counted}
        self._take(())

    def _take(self, samples: Sequence[Sample]) -> tuple[SensedEvent, ...]:
        if samples:
            self.bus.publish(samples)
        if self._remote is not None:
            self.bus.publish(self._remote.heard())
        heard = self._inbox.take()
        if heard:
            self._monitor.accept(heard, self.time)
        live = self._live if self._remote is not None else 0.0
        self.scene = self._monitor.scene(self.time, live)
        if self._doubts:
            self._dispel()
        changes = self._changes() if self.scene.readings is not self._compared else ()
        return changes if self._record is None else self._with_measures(self._record, changes)

    def _with_measures(
        self, record: MeasureRecord, changes: tuple[FactChanged, ...]
    ) -> tuple[SensedEvent, ...]:
        """Return the changed facts, after the measures that the log keeps now."""
        changed = [(one.branch, one.digit) for one in changes]
        told = (
            measured(self.time, *one[:4], one.quality, round(one.time, 6), one.reason)
            for one in record.keep(changed, self.time)
        )
        return (*told, *changes)

    def _dispel(self) -> None:
        """Remove the doubts whose sources have all sent new samples. Facts with other doubts are
        unknown.
        """
        for source in self.sources:
            doubt, name = self._doubts.get(source.fact), source.said.source
            if doubt is None or name not in doubt.counted:
                continue
            if source.said.contested:
                # If two programs send as this source and one stops, the other must send a new
                # sample too.
                doubt.counted[name] = source.counted
            elif doubt.ends(source) or source.said.value is None:
                del doubt.counted[name]
                if not doubt.counted:
                    del self._doubts[source.fact]
        unknown = {key: Reading(None, doubt.reason) for key, doubt in self._doubts.items()}
        readings = MappingProxyType({**self.scene.readings, **unknown})
        self.scene = Scene(readings, self.scene.time)

    @property
    def _live(self) -> float:
        return self._remote.clock() if self._remote is not None else 0.0

    def _changes(self) -> tuple[FactChanged, ...]:
        told, before, readings = self._told, self._compared, self.scene.readings
        self._compared = readings
        new = [key for key, one in readings.items() if before.get(key) is not one]
        changed = [key for key in new if told.get(key, ...) != readings[key].value]
        return tuple([self._change(key, readings[key]) for key in changed]) if changed else ()

    def _change(self, key: FactKey, reading: Reading) -> FactChanged:
        self._told[key] = reading.value
        value = reading.value
        return fact_changed(self.time, *key, value, reading.reason if value is None else "")


def _newer(source: SourceState, since: Moment) -> bool:
    sample = source.sample
    if sample is None:
        return True
    if sample.received is not None:
        return sample.received > since.live
    return sample.time > since.time
