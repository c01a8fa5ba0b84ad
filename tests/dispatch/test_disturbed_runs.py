"""Runs with disturbed sensors hold with a reason and commit nothing on unknown facts.

They are equal in both hosts.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.front.inputs import read
from smsl_studio.host.local import LocalHost
from smsl_studio.host.process import ProcessHost
from smsl_studio.host.protocol import Host
from smsl_studio.runlog.events import (
    Committed,
    Event,
    FactChanged,
    OperationRefused,
    RunFinished,
)
from smsl_studio.shipped import samples_dir

HANOI = read(samples_dir() / "hanoi-2.json")
Switch = tuple[int, str, str, dict[str, Any]]


def _run(host: Host, switches: Sequence[Switch]) -> list[Event]:
    """A run to its end, disturbed at some of its ticks."""
    dispatcher = Dispatcher(HANOI, host)
    events = list(dispatcher.open())
    for tick in range(200):
        if dispatcher.finished:
            break
        for at, target, kind, parameters in switches:
            if at == tick:
                host.disturb(target, kind, **parameters)
        events.extend(dispatcher.tick())
    return events


def _end(events: Sequence[Event]) -> RunFinished:
    assert isinstance(events[-1], RunFinished)
    return events[-1]


def test_nothing_disturbed_it_gets_there() -> None:
    assert _end(_run(LocalHost(HANOI, "table"), ())).reason == "goal_reached"


def test_with_a_lost_sensor_nothing_begins() -> None:
    host = LocalHost(HANOI, "table")
    dispatcher = Dispatcher(HANOI, host, RunTerms(automatic=False))
    dispatcher.open()
    host.disturb("SB1/0", "dropout")
    for _ in range(7):
        dispatcher.tick()
    assert dispatcher.status.scene.readings["SB1", 0].reason == "no reading for 0.4 s"
    dispatcher.ask(Address("SB1", "State_aa", "Op_1b"))
    refused = [one for one in dispatcher.tick() if isinstance(one, OperationRefused)]
    reason = "SB1/State_aa does not check true: Fact 1 of SB1 is unknown, no reading for 0.4 s"
    assert [one.reasons for one in refused] == [(reason,)]


def test_a_stuck_sensor_commits_nothing() -> None:
    events = _run(LocalHost(HANOI, "table"), [(0, "SB1/0", "stuck", {"value": "a"})])
    assert _end(events).reason == "held"
    assert not any(isinstance(event, Committed) for event in events)


ONCE = st.tuples(
    st.integers(0, 12),
    st.sampled_from(["SB1/0", "SB1/1"]),
    st.sampled_from(
        [("noise", {"rate": 0.3}), ("dropout", {"rate": 0.7}), ("stuck", {}), ("none", {}),
         ("delay", {"seconds": 0.1}), ("delay", {"seconds": 0.5}), ("drift", {"every": 0.3})]
    ),
)  # fmt: skip


def test_both_hosts_tell_the_same_disturbed_story() -> None:
    child = ProcessHost(HANOI, "table", 3)

    @settings(max_examples=12, database=None)
    @given(st.lists(ONCE, max_size=4))
    def alike(drawn: list[tuple[int, str, tuple[str, dict[str, Any]]]]) -> None:
        switches = [(at, target, *kind) for at, target, kind in drawn]
        events = _run(LocalHost(HANOI, "table", 3), switches)
        assert events == _run(child, switches)
        _no_wrong_commit(events)

    try:
        alike()
    finally:
        child.close()


def _no_wrong_commit(events: Sequence[Event]) -> None:
    """What was committed was sensed: every digit read what its state has, at that moment."""
    sensed: dict[tuple[str, int], str | None] = {}
    for event in events:
        if isinstance(event, FactChanged):
            sensed[event.branch, event.digit] = event.value
        elif isinstance(event, Committed):
            for branch, state in event.configuration.items():
                for digit, value in enumerate(HANOI[branch].facts(state)):
                    assert sensed[branch, digit] == value
