"""Rounds of sensors: a monitor that gets whole rounds says the same as one that gets their samples
one by one.
"""

from __future__ import annotations

import random

import pytest

from smsl_studio.host.local import LocalHost
from smsl_studio.monitor.bus import FactBus
from smsl_studio.monitor.facts import FactMonitor
from smsl_studio.monitor.sample import BAD, GOOD, Sample, SensorRound
from tests.dispatch.runs import sample

START = {"SB1": "State_aaa"}


@pytest.mark.parametrize("seed", range(24))
def test_rounds_say_what_their_samples_say(seed: int) -> None:
    """Ticks, silences, other speakers and disturbed sensors come in any order."""
    chance = random.Random(seed)
    host = LocalHost(sample("hanoi-corrected"), "table")
    opened = host.open(START)
    quick, plain = FactMonitor(opened.sensors), FactMonitor(opened.sensors)
    rounds = 0
    for step in range(60):
        heard = _heard(host, chance) if step > 3 else host.tick().samples
        rounds += isinstance(heard, SensorRound)
        now = max((one.time for one in heard), default=0.0)
        for _ in range(chance.choice((0,) * 9 + (1, 9))):
            now = host.tick().time  # it comes late
        quick.accept(heard, now)
        plain.accept(tuple(heard), now)
        for _ in range(chance.choice((0,) * 9 + (3, 400))):
            now = host.tick().time  # then there is a silence
        assert quick.scene(now) == plain.scene(now)
        if chance.random() < 0.2:
            assert quick.sources(now) == plain.sources(now)
    assert quick.sources(now) == plain.sources(now)
    assert rounds


def _heard(host: LocalHost, chance: random.Random) -> tuple[Sample, ...]:
    what = chance.random()
    if what < 0.1:
        kind = chance.choice(("dropout", "delay", "none", "none", "none"))
        given = {"delay": {"seconds": 0.1}, "dropout": {"rate": 0.5}}.get(kind, {})
        host.disturb("table_SB1_0", kind, **given)
    if what < 0.2:
        times = (0.0, 1.0)
        value = chance.choice(("a", "b", None))
        quality = GOOD if value is not None else BAD
        name = "table_SB1_1"
        at, count, boot = chance.choice(times), chance.randrange(60), chance.choice((1, 2))
        return (Sample("SB1", 1, name, value, at, count, boot, quality=quality),)
    return host.sense() if what < 0.3 else host.tick().samples


def test_a_round_is_made_only_of_usual_samples() -> None:
    host = LocalHost(sample("hanoi-corrected"), "table")
    host.open(START)
    assert not isinstance(host.sense(), SensorRound)  # each value is looked at once
    whole = host.tick().samples
    assert isinstance(whole, SensorRound)
    assert [one.fact for one in whole] == list(whole.facts)
    assert [one.value for one in whole] == list(whole.values)
    assert {one.time for one in whole} == {whole.time}
    host.disturb("table_SB1_0", "delay", seconds=0.05)
    assert not isinstance(host.tick().samples, SensorRound)


def test_a_round_that_waits_with_other_samples_is_no_round_any_more() -> None:
    host = LocalHost(sample("hanoi-corrected"), "table")
    host.open(START)
    host.sense()
    bus, other = FactBus(), Sample("SB1", 0, "eye", "b", 0.0, 1)
    inbox = bus.subscribe()
    first, second = host.tick().samples, host.tick().samples
    bus.publish(first)
    assert inbox.take() is first
    bus.publish(first)
    bus.publish([other])
    bus.publish(second)
    assert inbox.take() == (*second, other)
    assert bus.counts.replaced == 3
    bus.publish(first)
    inbox.close()
    assert inbox.take() == ()
