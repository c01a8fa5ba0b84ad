"""The fact monitor: makes facts, with age and reason, from samples (paper, Eq. 5).

Ages are measured on the receiver's clock, from the arrival of a sample. For sensors of the run this
is the clock of the run (simulated time in simulation). For remote sensors it is the monotonic
clock. Only a growing (boot, sequence) of a source refreshes its fact; late, repeated and retained
samples do not. ``aggregate`` makes one value from several sources. ``ledger`` finds the speaker of
a source.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from types import MappingProxyType
from typing import Protocol

from smsl_studio.blueprint.address import fact_text
from smsl_studio.blueprint.check import NOTHING_SENSED, FactKey, Reading, Scene, fresh_reading
from smsl_studio.errors import UsageError
from smsl_studio.monitor.aggregate import NOBODY, Aggregate, FactRule, SourceValue, aggregate
from smsl_studio.monitor.ledger import Ledger
from smsl_studio.monitor.rounds import Rounds
from smsl_studio.monitor.sample import Sample
from smsl_studio.monitor.sensed_fact import DECIDED, SensedFact
from smsl_studio.monitor.speaker import HAIR

NO_RULES: Mapping[FactKey, FactRule] = MappingProxyType({})


class FactSource(Protocol):
    """The properties of a sensor that the monitor needs: its fact and its largest age (s).

    ``aggregation`` counts if no rule is declared for the fact.
    """

    @property
    def name(self) -> str:
        """The name of the sensor."""

    @property
    def branch(self) -> str:
        """The SB of the fact that the sensor reads."""

    @property
    def digit(self) -> int:
        """The digit of the fact, counted from 0."""

    @property
    def max_age(self) -> float:
        """The largest age (s) of its newest sample. An older sample makes the fact unknown."""

    @property
    def aggregation(self) -> str:
        """The mode that makes one value from several sensors of this fact (see ``aggregate``)."""


@dataclass(frozen=True, slots=True)
class SourceState:
    """The state of one source of one fact, for people. Times are in seconds.

    ``sample`` is its newest sample. ``latency`` is its delay beyond the quickest sample since the
    source started. ``counted``, ``repeated`` and ``late`` are numbers of samples; only counted
    samples refresh the fact. ``limit`` is the largest age; None means that a person's answer holds
    until the next answer.
    """

    fact: FactKey
    said: SourceValue
    sample: Sample | None
    latency: float
    counted: int
    repeated: int
    late: int
    limit: float | None = None


@dataclass(slots=True)
class _Fact:
    """One fact: its rule, its sources in order, a person's answer, and the last agreed value.

    ``alone`` is its only source, if one source is enough for the rule. It allows a short cut.
    """

    rule: FactRule
    sources: dict[str, Ledger]
    answer: tuple[SourceValue, float] | None = None
    agreed: tuple[Aggregate, float] | None = None
    alone: Ledger | None = None
    sensed: SensedFact | None = None
    """The decision of its predicates, if it has any."""


class FactMonitor:
    """Makes the scene from the samples of the sensors (paper, Eq. 5, ``C_fact``).

    The order of the sensors of one fact is their priority. Samples of unknown sensors are dropped
    and counted as ``strangers``. A person's answer comes only through ``answer``. ``whole`` says
    that every fact of the last scene has a value that its only source has sent at this instant.
    """

    def __init__(
        self, sensors: Iterable[FactSource], rules: Mapping[FactKey, FactRule] = NO_RULES
    ) -> None:
        self.strangers = 0
        self._facts: dict[FactKey, _Fact] = {}
        self._bare = Scene()
        self._fresh: dict[FactKey, str] = {}
        """The values that lone sources have sent at the instant ``_fresh_at``."""
        self._fresh_at = 0.0
        self._rounds = Rounds()
        self._values: tuple[str, ...] | None = None
        """The values of the round that ``_fresh`` was made from, None if it was made otherwise."""
        self._shown: dict[FactKey, str] = {}
        """The values of the newest readings if all facts were fresh."""
        self._readings = NOTHING_SENSED
        for sensor in sensors:
            key = (sensor.branch, sensor.digit)
            if key not in self._facts:
                rule = rules.get(key) or FactRule(sensor.aggregation)
                self._facts[key] = _Fact(rule, {})
            self._facts[key].sources[sensor.name] = Ledger(sensor.name, sensor.max_age)
        self._ledgers = {
            (*key, name): ledger
            for key, fact in self._facts.items()
            for name, ledger in fact.sources.items()
        }
        for key, rule in rules.items():
            if rule.people or rule.sensors or rule.sense is not None:
                self._facts.setdefault(key, _Fact(rule, {}))
        for fact in self._facts.values():
            if fact.rule.sense is not None:
                fact.sensed = SensedFact(fact.rule.sense, fact.sources)
                continue
            alone = len(fact.sources) == 1 and not fact.rule.people
            if alone and fact.rule.aggregation in ("single", "any", "priority"):
                fact.alone = next(iter(fact.sources.values()))
        self.whole = not self._facts
        self._lone = all(fact.alone is not None for fact in self._facts.values())
        self._reads = tuple((key, _read_of(fact)) for key, fact in self._facts.items())

    def accept(self, samples: Sequence[Sample], now: float) -> None:
        """Take in samples, at ``now`` (s) on the clock of the run."""
        if self._lone:
            self._accept_lone(samples, now)
            return
        ledgers = self._ledgers
        for sample in samples:
            ledger = ledgers.get(sample[:3])
            if ledger is not None:
                ledger.take(sample, now)
            else:
                self.strangers += 1

    def _accept_lone(self, samples: Sequence[Sample], now: float) -> None:
        """Take in samples if every fact has one source that is enough for it."""
        whole = self._rounds.take(samples, now)
        if whole is not None:
            if self._values != whole.values:
                self._fresh = dict(zip(whole.facts, whole.values, strict=True))
                self._values = whole.values
            self._fresh_at = now
            return
        self._rounds.end()
        fresh = dict(self._fresh) if self._fresh_at == now else {}
        self._fresh, self._fresh_at, self._values = fresh, now, None
        ledgers = self._ledgers
        found: list[Ledger] = []
        for sample in samples:
            ledger = ledgers.get(sample[:3])
            if ledger is None:
                self.strangers += 1
                continue
            found.append(ledger)
            value = ledger.take(sample, now)
            if value is not None:
                fresh[sample[:2]] = value
            else:
                fresh.pop(sample[:2], None)
        if len(found) == len(ledgers):
            self._rounds.begin(samples, found, now)

    def answer(self, branch: str, digit: int, value: str | None, who: str, now: float) -> None:
        """Take in the answer of a person ``who`` to a fact, at ``now`` (s). None takes it back.

        UsageError if a person may not answer this fact.
        """
        fact = self._facts.get((branch, digit))
        if fact is None or not fact.rule.people:
            raise UsageError(
                f"{fact_text(branch, digit)} is not a fact that a person answers",
                advice="Its level must be human or shared.",
            )
        said = SourceValue(who, value, "" if value is not None else NOBODY, human=True)
        fact.answer = (said, now)

    @property
    def sensed(self) -> Mapping[FactKey, SensedFact]:
        """The facts that predicates decide."""
        return {key: one.sensed for key, one in self._facts.items() if one.sensed is not None}

    def answered(self) -> tuple[FactKey, ...]:
        """Return the facts that have an answer of a person."""
        return tuple(key for key, fact in self._facts.items() if _says(fact))

    def scene(self, now: float, live: float = 0.0) -> Scene:
        """Return the scene at ``now`` (s): each sensed fact with its value, or with the reason why
        it is unknown.

        ``live`` is the same instant on the monotonic clock, for remote sources.
        """
        if not self._facts:
            if self._bare.time != now:
                self._bare = Scene(time=now)
            return self._bare
        self.whole = self._lone and self._fresh_at == now and len(self._fresh) == len(self._facts)
        if self.whole:
            return Scene(self._fresh_readings(), now)
        self._rounds.write()
        readings = {key: read(now, live) for key, read in self._reads}
        return Scene(MappingProxyType(readings), now)

    def _fresh_readings(self) -> Mapping[FactKey, Reading]:
        """Return the readings if every fact has a value of this instant. They are the same object
        as before if no value is another, which is so in most ticks."""
        fresh = self._fresh
        if fresh is self._shown:
            return self._readings
        if fresh != self._shown:
            self._readings = MappingProxyType(
                dict(zip(self._facts, map(fresh_reading, map(fresh.get, self._facts)), strict=True))
            )
        self._shown = fresh
        return self._readings

    def sources(self, now: float, live: float = 0.0) -> tuple[SourceState, ...]:
        """Return the state of every source at ``now`` (s), even of sources that do not count."""
        self._rounds.write()
        found = []
        for key, fact in self._facts.items():
            for ledger in fact.sources.values():
                speaker = ledger.speaker(now, live)
                found.append(
                    SourceState(
                        key,
                        ledger.said(now, live),
                        speaker.sample if speaker is not None else None,
                        speaker.latency if speaker is not None else 0.0,
                        ledger.counted,
                        ledger.repeated,
                        ledger.late,
                        ledger.max_age,
                    )
                )
            limit = fact.rule.max_age
            found.extend(
                SourceState(key, said, None, 0.0, 0, 0, 0, limit) for said in _others(fact, now)
            )
        return tuple(found)


def _others(fact: _Fact, now: float) -> list[SourceValue]:
    """Return a person's answer, and an unknown value for each named sensor that the world does not
    have.

    If none of the named sensors exists, the fact is unknown.
    """
    answers = [_answered(fact, now)] if fact.rule.people and fact.answer else []
    if (fact.sources and not fact.rule.awaits_all) or fact.sensed is not None:
        return answers
    named = (name for name in fact.rule.sensors if name not in fact.sources)
    return [
        *(SourceValue(name, None, "this world has no such sensor", now) for name in named),
        *answers,
    ]


def _says(fact: _Fact) -> bool:
    return fact.answer is not None and fact.answer[0].value is not None


def _answered(fact: _Fact, now: float) -> SourceValue:
    assert fact.answer is not None
    said, at = fact.answer
    age, limit = now - at, fact.rule.max_age
    if limit is not None and age > limit + HAIR:
        return SourceValue(said.source, None, f"the answer is {age:.1f} s old", age, human=True)
    return SourceValue(said.source, said.value, said.reason, age, human=True)


def _read_of(fact: _Fact) -> Callable[[float, float], Reading]:
    """Return the function that reads a fact at an instant, on both clocks (s)."""
    if fact.alone is not None:
        return partial(_said_alone, fact.alone)
    if fact.sensed is None:
        return partial(_aggregated, fact)
    return partial(_shared, fact, fact.sensed) if fact.rule.people else fact.sensed.decided


def _said_alone(alone: Ledger, now: float, live: float) -> Reading:
    newest = alone.said_now(now)
    if newest is not None:
        return fresh_reading(newest.value)
    only = alone.said(now, live)
    return Reading(only.value, only.reason, only.age)


def _aggregated(fact: _Fact, now: float, live: float) -> Reading:
    said = [ledger.said(now, live) for ledger in fact.sources.values()]
    verdict = aggregate(fact.rule, [*said, *_others(fact, now)])
    if fact.rule.conflict_after > 0:
        elsewhere = any(ledger.live for ledger in fact.sources.values())
        verdict = _patient(fact, verdict, said, live if elsewhere else now)
    return Reading(verdict.value, verdict.reason, verdict.age)


def _shared(fact: _Fact, sensed: SensedFact, now: float, live: float) -> Reading:
    """Return what the predicates say, or the answer of a person where one counts."""
    found = sensed.decided(now, live)
    said = SourceValue(DECIDED, found.value, found.reason, found.age, contested=sensed.contested)
    answers = [_answered(fact, now)] if fact.answer else []
    verdict = aggregate(fact.rule, [said, *answers])
    return Reading(verdict.value, verdict.reason, verdict.age)


def _patient(fact: _Fact, verdict: Aggregate, said: list[SourceValue], now: float) -> Aggregate:
    """Keep the last agreed value, with its growing age, during a short conflict.

    It is kept for at most ``conflict_after`` seconds, and only while one source still has it.
    """
    if not verdict.conflict:
        fact.agreed = (verdict, now) if verdict.value is not None else None
        return verdict
    if fact.agreed is None:
        return verdict
    agreed, at = fact.agreed
    held = any(one.value == agreed.value for one in said)
    if not held or now - at > fact.rule.conflict_after + HAIR:
        fact.agreed = None
        return verdict
    return Aggregate(agreed.value, "", agreed.age + now - at)
