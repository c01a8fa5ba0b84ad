"""The senses of a run: its time never goes back, and remote samples are read between ticks."""

from __future__ import annotations

from smsl_studio.dispatch.execution.senses import Senses
from smsl_studio.host.local import LocalHost
from smsl_studio.monitor.sample import Sample
from tests.dispatch.runs import sample


class _Late(LocalHost):
    """A host whose sensors say when they read, which is some time ago."""

    def sense(self) -> tuple[Sample, ...]:
        return tuple(Sample("SB1", 0, "late", "a", 0.01, 1) for _ in range(2))


def test_the_time_does_not_go_back_to_when_something_was_read() -> None:
    hanoi = sample("hanoi-2")
    host = _Late(hanoi, "table")
    opened = host.open({"SB1": "State_aa"})
    senses = Senses(host, opened, opened.rules)
    for _ in range(4):
        senses.tick()
    assert senses.time > 0.01
    before = senses.time
    senses.look()
    assert senses.time == before


def test_nobody_elsewhere_is_nobody_to_listen_to() -> None:
    hanoi = sample("hanoi-2")
    host = LocalHost(hanoi, "table")
    opened = host.open({"SB1": "State_aa"})
    senses = Senses(host, opened, opened.rules)
    senses.look()
    senses.bus.publish([Sample("SB1", 0, "table_SB1_0", "b", 0.0, 99, 1)])
    assert senses.listen() == ()
    assert senses.scene.readings["SB1", 0].value == "a"
    senses.look()
    assert senses.scene.readings["SB1", 0].value == "b"


def test_what_is_in_doubt_is_said_anew_also_after_a_second_speaker() -> None:
    """Its reading from before the doubt may be young enough when the other one falls silent."""
    hanoi = sample("hanoi-2")
    host = LocalHost(hanoi, "table")
    opened = host.open({"SB1": "State_aa"})
    senses = Senses(host, opened, opened.rules)
    fact = ("SB1", 0)

    def reason() -> str:
        return senses.scene.readings[fact].reason

    senses.look()
    senses.tick()
    senses.bus.publish([Sample(*fact, "table_SB1_0", "b", senses.time, 1, boot=9)])
    for _ in range(3):
        senses.tick()
    host.disturb("table_SB1_0", "dropout")  # the sensor itself is silent from now on
    assert reason().startswith("two speakers for table_SB1_0: this program of boot 1, this program")
    senses.doubt([fact], "it was cancelled")
    while not reason().startswith("no reading"):
        senses.tick()
        assert senses.scene.readings[fact].value is None
    host.disturb("table_SB1_0", "none")
    senses.tick()
    assert senses.scene.readings[fact].value == "a"


def test_a_reading_from_before_a_doubt_does_not_end_it() -> None:
    hanoi = sample("hanoi-2")
    host = LocalHost(hanoi, "table")
    opened = host.open({"SB1": "State_aa"})
    senses = Senses(host, opened, opened.rules)
    fact = ("SB1", 0)
    senses.look()
    host.disturb("table_SB1_0", "delay", seconds=0.2)
    for _ in range(20):
        senses.tick()
    assert senses.scene.readings[fact].value == "a"
    senses.doubt([fact], "it was cancelled")
    began = senses.time
    while senses.scene.readings[fact].value is None:
        senses.tick()
        assert senses.time < began + 1.0
    assert senses.time >= began + 0.2 - 1e-9, "it was read before"


def test_a_tick_that_read_every_sensor_needs_no_other_look() -> None:
    """But a sensor that is disturbed, or a fact in doubt, is looked at once more."""
    hanoi = sample("hanoi-2")
    host = LocalHost(hanoi, "table")
    opened = host.open({"SB1": "State_aa"})
    senses = Senses(host, opened, opened.rules)
    senses.look()
    for _ in range(3):
        senses.tick()
        assert senses.whole
    host.disturb("table_SB1_0", "dropout")
    senses.doubt([("SB1", 0)], "it was cancelled")
    senses.tick()
    assert not senses.whole
    host.disturb("table_SB1_0", "none")
    senses.tick()
    assert senses.whole
    senses.distrust()
    senses.tick()
    assert not senses.whole
