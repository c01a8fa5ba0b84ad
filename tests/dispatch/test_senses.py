"""The senses of a run: its time never goes back, and what is elsewhere is heard in between."""

from __future__ import annotations

from smsl_studio.dispatch.senses import Senses
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
