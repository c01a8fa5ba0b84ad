"""Random predicates and random streams of samples, decided by the monitor and in the plain way."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from random import Random

from smsl_studio.blueprint.predicates import sense_of
from smsl_studio.monitor.aggregate import FactRule
from smsl_studio.monitor.facts import FactMonitor
from smsl_studio.monitor.sample import BAD, GOOD, UNCERTAIN, Sample
from tests.monitor.plain_predicates import PlainFact, PlainSource, random_fact, written

FACT = ("SB", 0)
LOOKS = 28
JUNK = ("nan", "inf", "-inf", "abc", "", "1e999", "1 2", "0x10", "1_0", "١")


@dataclass(frozen=True)
class Source:
    """A source as the monitor knows it."""

    name: str
    max_age: float
    branch: str = "SB"
    digit: int = 0
    aggregation: str = "single"


def told_apart(number: int) -> str:
    """Play one story. Return where the monitor and the plain way differ, or an empty text."""
    chance = Random(number)
    plain = random_fact(chance)
    entry = {
        "sources": {name: one.unit for name, one in plain.sources.items()},
        "range": {n: [float(one.low), float(one.high)] for n, one in plain.sources.items()
                  if one.low is not None and one.high is not None},
        "predicate": {value: written(tree) for value, tree in plain.values.items()},
    }  # fmt: skip
    sense = sense_of(entry)
    if sense is None or sense.fault is not None:
        return f"{number}: {entry} cannot be read: {sense and sense.fault}"
    _leave_unused(plain, [one.name for one in sense.sources])
    sources = [Source(name, one.max_age / 1000) for name, one in plain.sources.items()]
    monitor = FactMonitor(sources, {FACT: FactRule(sense=sense)})
    elsewhere = number % 2 == 1
    streams = {name: _stream(chance, one, elsewhere) for name, one in plain.sources.items()}
    now = 0
    for _ in range(LOOKS):
        arrived = []
        for name, stream in streams.items():
            newest = None
            while stream and stream[0][0] <= now:
                at, sample, numbers = stream.pop(0)
                # What is elsewhere is old from its arrival on, what is here from its reading on.
                at = at if elsewhere else now
                if elsewhere:
                    sample = sample._replace(source=name, received=at / 1000)
                else:
                    sample = sample._replace(source=name, time=now / 1000)
                arrived.append(sample)
                if newest is None or sample.sequence > newest[1]:
                    newest = at, sample.sequence, numbers
            if newest is not None:  # between two looks only the newest sample counts
                plain.sources[name].heard.append(newest)
        monitor.accept(arrived, now / 1000)
        reading = monitor.scene(now / 1000, now / 1000).get(*FACT)
        wanted = plain.look(now)
        if reading is None or reading.value != wanted:
            return f"{number}: {entry} at {now} ms: {reading}, in the plain way {wanted}"
        if reading.value is None and not reading.reason:
            return f"{number}: {entry} at {now} ms: unknown without a reason"
        now += chance.choice((10, 20, 20, 20, 50, 100, 350 if chance.random() < 0.3 else 20))
    return ""


def _leave_unused(plain: PlainFact, used: list[str]) -> None:
    for name in set(plain.sources) - set(used):
        del plain.sources[name]


def _stream(
    chance: Random, source: PlainSource, elsewhere: bool
) -> list[tuple[int, Sample, tuple[Fraction, ...] | None]]:
    """All samples of a source in the order of their arrival (ms), with what each means.

    One of a source elsewhere is overtaken by those after it.
    """
    found = []
    period, at = chance.choice((10, 20, 50, 100, 250)), chance.randint(0, 60)
    many = 3 if source.position else 1
    values = [Fraction(chance.randint(-24, 24), 8) for _ in range(many)]
    step = chance.choice((1, 4, 12))
    overtaken = chance.randint(1, 30) if elsewhere else 0
    for sequence in range(1, 60):
        values = [one + Fraction(chance.randint(-step, step), 8) for one in values]
        numbers: tuple[Fraction, ...] | None = tuple(values)
        text: str | None = " ".join(repr(float(one)) for one in values)
        quality = GOOD
        if chance.random() < 0.06:
            text, quality, numbers = chance.choice(
                ((None, BAD, None), (text, UNCERTAIN, None), (chance.choice(JUNK), GOOD, None))
            )
        sample = Sample("SB", 0, "", text, at / 1000, sequence, 0, "", quality)
        if chance.random() > 0.1:
            # Samples that come late again and again would be those of a second program.
            delay = 60 if sequence == overtaken else chance.choice((0, 0, 5)) if elsewhere else 0
            found.append((at + delay, sample, numbers))
        at += max(1, period + chance.randint(-period // 3, period // 3))
        if chance.random() < 0.05:
            at += chance.choice((200, 600))
    return sorted(found, key=lambda one: one[0])
