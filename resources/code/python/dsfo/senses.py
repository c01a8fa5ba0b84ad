"""The senses of a run: from samples and answers of people to the scene (clauses 9 and 13).

A fact ages from the arrival of its newest sample. One that is too old is unknown.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field

from .checks import Reading
from .disturbance import HAIR, DisturbedSensor, Sample, checked
from .elements import AUTOMATIC, HUMAN, Blueprint, FactKey, fact_text, split_fact
from .errors import UsageError, did_you_mean
from .events import Event, event
from .levels import Levels
from .world import Host, Tick

CREEP = 1e-3
"""How much slower than ours the clock of a sensor may be."""
MAX_AGE = 0.3
"""The age (s) at which a reading is too old where the blueprint declares none."""


class Source:
    """One sensor of one fact: its newest sample, and when that arrived."""

    def __init__(self, name: str, max_age: float) -> None:
        self.name, self.max_age = name, max_age
        self.sample: Sample | None = None
        self.read = self.counted = 0
        self._received, self._quickest = 0.0, float("inf")

    def take(self, sample: Sample, now: float) -> None:
        """Accept a sample if it is newer than all before it, and not late."""
        if self.sample is not None and sample.number <= self.sample.number:
            return
        way = now - sample.time
        quickest = self._quickest + CREEP * (now - self._received)
        if way - min(quickest, way) > self.max_age + HAIR:
            return
        self._quickest, self._received = min(way, quickest), now
        self.sample, self.counted = sample, self.counted + 1

    def reading(self, now: float) -> Reading:
        """Return what it says now."""
        if self.sample is None:
            return Reading(None, "no reading yet")
        age = now - self._received
        if age > self.max_age + HAIR:
            return Reading(None, f"no reading for {age:.1f} s")
        if self.sample.value is None:
            return Reading(None, "no valid reading")
        return Reading(self.sample.value)


@dataclass
class Sensed:
    """One fact: who tells it, its sensor, and what a person has answered (who, value, when)."""

    level: str
    source: Source
    max_age: float | None = None
    answer: tuple[str, str | None, float] | None = None

    def answered(self, now: float) -> Reading:
        """Return what a person has said, if that still counts."""
        if self.answer is None or self.level == AUTOMATIC:
            return Reading(None, "nobody has answered yet")
        _, value, at = self.answer
        if value is None:
            return Reading(None, "nobody has answered yet")
        if self.max_age is not None and now - at > self.max_age + HAIR:
            return Reading(None, f"the answer is {now - at:.1f} s old")
        return Reading(value)

    def reading(self, now: float) -> Reading:
        """Return the value of the fact, or why it is unknown."""
        if self.level == HUMAN:
            return self.answered(now)
        said = self.source.reading(now)
        if self.level == AUTOMATIC or said.value is not None:
            return said
        answer = self.answered(now)
        return answer if answer.value is not None else said


@dataclass
class Doubt:
    """Why a fact is unknown since a time, and how many samples each source had sent by then."""

    reason: str
    since: float
    counted: dict[str, int] = field(default_factory=dict)


class Senses:
    """The scene of one run, and the time (s)."""

    def __init__(self, blueprint: Blueprint, host: Host, levels: Levels, seed: int) -> None:
        self.scene: Mapping[FactKey, Reading] = {}
        self._host, self._blueprint, self._seed = host, blueprint, seed
        self._facts = {key: self._sensed(key, levels.fact(key)) for key in blueprint.sensed()}
        self._told: dict[FactKey, str | None] = {}
        self._doubts: dict[FactKey, Doubt] = {}
        self._disturbed: dict[FactKey, DisturbedSensor] = {}

    def _sensed(self, key: FactKey, level: str) -> Sensed:
        flag = self._blueprint.flag(key)
        source = Source(f"table_{key[0]}_{key[1]}", flag.max_age or MAX_AGE)
        return Sensed(level, source, flag.max_age if flag.told_by_people else None)

    @property
    def time(self) -> float:
        """Simulated seconds."""
        return self._host.time

    @property
    def sensed(self) -> list[str]:
        """The facts that a sensor or a person tells, in order."""
        return [fact_text(key) for key in sorted(self._facts)]

    def look(self) -> list[Event]:
        """Read every sensor now, and return the changes."""
        now = self.time
        for key, fact in self._facts.items():
            fact.source.read += 1
            sample = Sample(self._read(key), now, fact.source.read)
            if key in self._disturbed:
                self._disturbed[key].take(sample, now)
            else:
                fact.source.take(sample, now)
        for key, disturbed in self._disturbed.items():
            for sample in disturbed.release(now):
                self._facts[key].source.take(sample, now)
        return self._changes()

    def _read(self, key: FactKey) -> str | None:
        read, world = self._blueprint.flag(key).read, self._host.world
        with suppress(Exception):  # a sensor that fails has no value
            return world.sense(key) if read is None else read(world, key)
        return None

    def tick(self) -> tuple[Tick, list[Event]]:
        """Let the world go on for one tick. Return what the function did, and the changes."""
        tick = self._host.tick()
        return tick, self.look()

    def answer(self, fact: FactKey, value: str | None, who: str) -> list[Event]:
        """Take what a person says about a fact. None takes it back."""
        self._facts[fact].answer = who, value, self.time
        self._doubts.pop(fact, None)
        return self._changes()

    def forget(self, facts: Iterable[FactKey]) -> list[Event]:
        """Forget what people have said about these facts: they must be asked again."""
        said = [key for key in set(facts) if key in self._facts and self._has_answer(key)]
        for key in said:
            self._facts[key].answer = "", None, self.time
        return self._changes() if said else []

    def _has_answer(self, key: FactKey) -> bool:
        answer = self._facts[key].answer
        return answer is not None and answer[1] is not None

    def doubt(self, facts: Iterable[FactKey], reason: str) -> list[Event]:
        """Make facts unknown until each of their sources has sent something new."""
        for key in sorted(set(facts) & self._facts.keys()):
            counted = {name: count for name, count, _, _ in self._sources(key)}
            self._doubts[key] = Doubt(reason, self.time, counted)
        return self._changes()

    def late(self, since: float, facts: Collection[FactKey]) -> list[FactKey]:
        """Return those of some facts that rest on a reading which is not newer than a time."""
        return [
            key
            for key, fact in self._facts.items()
            if key in facts
            and fact.source.reading(self.time).value is not None
            and fact.source.sample is not None
            and not fact.source.sample.time > since
        ]

    def disturb(self, target: str, kind: str, given: Mapping[str, object]) -> list[str]:
        """Disturb a sensor, or the sensor of a fact, from now on. Return the names of sensors."""
        parameter = checked(kind, given)
        found = [key for key, one in self._facts.items() if one.source.name == target]
        fact = split_fact(target)
        found = found or [key for key in self._facts if key == fact]
        if not found:
            names = [one.source.name for one in self._facts.values()]
            near = did_you_mean(target, [*names, *map(fact_text, self._facts)])
            raise UsageError(f"nothing called {target!r} is sensed", near)
        for key in found:
            source = self._facts[key].source
            if key not in self._disturbed:
                seed = f"{self._seed} {fact_text(key)} {source.name}"
                self._disturbed[key] = DisturbedSensor(self._blueprint.flag(key).values, seed)
            self._disturbed[key].switch(kind, parameter)
        return [self._facts[key].source.name for key in found]

    def _sources(self, key: FactKey) -> list[tuple[str, int, float | None, str | None]]:
        """Return the name, the number of samples, the time of the newest and the value of each
        source of a fact.
        """
        fact, now = self._facts[key], self.time
        one = fact.source
        read = one.sample.time if one.sample is not None else None
        found = [(one.name, one.counted, read, one.reading(now).value)]
        if fact.answer is not None and fact.level != AUTOMATIC:
            found.append((fact.answer[0], 0, None, fact.answered(now).value))
        return found

    def _dispel(self) -> None:
        """Remove the doubts whose sources have all sent something new."""
        for key, doubt in list(self._doubts.items()):
            for name, count, read, value in self._sources(key):
                early = read is not None and read < doubt.since
                new = count > doubt.counted.get(name, count) and not early
                if name in doubt.counted and (new or value is None):
                    del doubt.counted[name]
            if not doubt.counted:
                del self._doubts[key]

    def _changes(self) -> list[Event]:
        now = self.time
        scene = {key: fact.reading(now) for key, fact in self._facts.items()}
        self._dispel()
        scene.update((key, Reading(None, one.reason)) for key, one in self._doubts.items())
        self.scene = scene
        found = []
        for key, one in scene.items():
            if key not in self._told or self._told[key] != one.value:
                self._told[key] = one.value
                reason = one.reason if one.value is None else ""
                said = {"branch": key[0], "digit": key[1], "value": one.value, "reason": reason}
                found.append(event("fact_changed", now, **said))
        return found
