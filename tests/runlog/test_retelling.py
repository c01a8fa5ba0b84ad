"""Telling a run again from its events: after each tick it stands as the live run stood."""

from __future__ import annotations

from collections.abc import Callable

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.runlog.changes import after
from smsl_studio.runlog.events import Event, FactChanged, RunStarted
from smsl_studio.runlog.retelling import EVERY, Retelling
from smsl_studio.runlog.retold import Retold
from smsl_studio.shipped import samples_dir


def _assert_alike(told: Retold, dispatcher: Dispatcher) -> None:
    status = dispatcher.status
    assert told.configuration == status.configuration
    if status.running is not None:
        assert (told.running, told.running_since) == (str(status.running), status.running_since)
    assert told.operations == status.operations
    assert told.goals == tuple(map(str, status.goals))
    sensed = {
        key: reading.value for key, reading in status.scene.readings.items() if reading.sensed
    }
    assert {key: fact.value for key, fact in told.facts.items()} == sensed
    if not dispatcher.finished:
        assert told.phase == status.phase


def _retold(
    dispatcher: Dispatcher, act: Callable[[int], None] = lambda tick: None
) -> tuple[Event, ...]:
    """Run to the end; after each tick the events alone must say how the run stands."""
    events: list[Event] = []
    told = Retold()
    try:
        ticks = 0
        happened = dispatcher.open()
        while True:
            for event in happened:
                told = after(told, event)
            events += happened
            _assert_alike(told, dispatcher)
            if dispatcher.finished or ticks > 10_000:
                break
            act(ticks)
            happened = dispatcher.tick()
            ticks += 1
    finally:
        dispatcher.close()
    return tuple(events)


@pytest.mark.parametrize("name", ["hfsm", "registration", "hanoi-4", "three-roots"])
def test_the_events_alone_say_how_a_run_stands(name: str) -> None:
    blueprint = smsl.read(samples_dir() / f"{name}.json")
    events = _retold(smsl.open_run(blueprint, host="local"))
    assert Retelling(events).at(len(events)).phase == "goal_reached"


def test_who_asks_for_an_operation_while_it_holds_finds_it_paused_afterwards() -> None:
    blueprint = smsl.read(samples_dir() / "hanoi-corrected.json")
    dispatcher = smsl.open_run(blueprint, host="local", attended=True)

    shut = [Address("SB1", "State_caa", name) for name in ("Op_1a", "Op_1b", "Op_2b")]

    def act(tick: int) -> None:
        if tick == 1:
            for edge in shut:
                dispatcher.prune(edge, "shut")
        elif tick == 10:
            assert dispatcher.phase == "no_route"
            dispatcher.restore(shut[1])
            dispatcher.ask(shut[1])
        elif tick == 20:
            assert dispatcher.phase == "paused"
            dispatcher.stop()
        elif tick == 22:
            dispatcher.end()

    events = _retold(dispatcher, act)
    assert Retelling(events).at(len(events)).phase == "stopped"


def test_any_moment_is_the_same_from_a_snapshot_and_from_the_start() -> None:
    facts = [FactChanged(t=n / 10, branch="SB1", digit=n % 3, value=str(n)) for n in range(1000)]
    start = RunStarted(t=0.0, world="table", seed=0, start={"SB1": "A"}, goals=())
    retelling = Retelling([start, *facts])
    told = Retold()
    assert retelling.at(0) == told
    for index, event in enumerate(retelling.events, 1):
        told = after(told, event)
        if index % 97 == 0 or index % EVERY in (0, 1):
            assert retelling.at(index) == told
    assert retelling.at(10**9) == told


def test_moments_are_found_by_time() -> None:
    facts = [FactChanged(t=t, branch="SB1", digit=0, value="x") for t in (1.0, 2.0, 2.0, 3.0)]
    retelling = Retelling(facts)
    found = [retelling.index_at(t) for t in (0.5, 1.0, 2.0, 2.5, 9.0)]
    assert found == [0, 1, 3, 3, 4]
    assert (retelling.time_of(0), retelling.time_of(3), retelling.end) == (0.0, 2.0, 3.0)
    assert Retelling(()).end == 0.0
