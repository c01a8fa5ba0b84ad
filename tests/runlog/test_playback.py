"""Playing a run back from its events: after each tick it equals the live run."""

from __future__ import annotations

from collections.abc import Callable

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.runlog.changes import after
from smsl_studio.runlog.events import Event, FactChanged, RoutePlanned, RunStarted
from smsl_studio.runlog.moment import RunMoment
from smsl_studio.runlog.playback import EVERY, Playback
from smsl_studio.shipped import samples_dir


def _assert_alike(told: RunMoment, dispatcher: Dispatcher) -> None:
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
    dispatcher: Dispatcher,
    act: Callable[[int], None] = lambda tick: None,
    by_hand: bool = False,
) -> tuple[Event, ...]:
    """Run to the end; after each tick the events alone must say how the run stands."""
    events: list[Event] = []
    told = RunMoment(by_hand=by_hand)
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
    assert Playback(events).at(len(events)).phase == "goal_reached"


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
    assert Playback(events).at(len(events)).phase == "stopped"


def test_one_operation_that_fails_was_the_one_that_was_wanted() -> None:
    """By hand the run waits again, also where the failure was blamed on the operation first."""
    blueprint = smsl.read(samples_dir() / "hanoi-2.json")
    dispatcher = smsl.open_run(blueprint, host="local", attended=True, automatic=False)

    def act(tick: int) -> None:
        if tick == 1:
            dispatcher.inject("fail")
            dispatcher.step()
        elif tick == 10:
            assert dispatcher.phase == "ready"
            dispatcher.stop()
        elif tick == 11:
            dispatcher.end()

    told = [event.event for event in _retold(dispatcher, act, by_hand=True)]
    assert {"operation_risky", "relocalised"} <= set(told)


def test_who_asks_for_an_operation_in_place_of_a_question_that_a_pause_holds() -> None:
    """The question is withdrawn, and the operation is carried out: nothing stands still."""
    blueprint = smsl.read(samples_dir() / "three-levels.json")
    dispatcher = smsl.open_run(
        blueprint, start="SURGERY/State100", host="local", attended=True,
        levels={"supervision": "human"},
    )  # fmt: skip

    def act(tick: int) -> None:
        if tick == 2:
            assert dispatcher.phase == "waiting"
            dispatcher.pause()
        elif tick == 3:
            assert dispatcher.phase == "paused"
            following = dispatcher.status.tasks[0].address
            dispatcher.ask(blueprint.resolve(following))
        elif tick == 4:
            assert dispatcher.phase == "running"
        elif tick == 20:
            dispatcher.stop()
        elif tick == 21:
            dispatcher.end()

    _retold(dispatcher, act)


def test_a_run_of_many_facts_is_told_in_the_time_of_its_events() -> None:
    """What is copied for snapshots is no more than the log has, and every moment is there."""
    many = 3000
    facts = [FactChanged(t=float(n), branch="SB", digit=n, value="1") for n in range(many)]
    route = RoutePlanned(t=0.0, goal="SB/A", operations=tuple("abc" * many), cost=1.0)
    playback = Playback([route, *facts])
    copied = sum(len(one.facts) + len(one.route) for one in playback._snapshots)
    assert copied < 4 * (many + len(route.operations))
    for index in (0, 1, 2, 64, 65, 1777, many, many + 1):
        assert len(playback.at(index).facts) == max(index - 1, 0)


def test_any_moment_is_the_same_from_a_snapshot_and_from_the_start() -> None:
    facts = [FactChanged(t=n / 10, branch="SB1", digit=n % 3, value=str(n)) for n in range(1000)]
    start = RunStarted(t=0.0, world="table", seed=0, start={"SB1": "A"}, goals=())
    playback = Playback([start, *facts])
    told = RunMoment()
    assert playback.at(0) == told
    for index, event in enumerate(playback.events, 1):
        told = after(told, event)
        if index % 97 == 0 or index % EVERY in (0, 1):
            assert playback.at(index) == told
    assert playback.at(10**9) == told


def test_moments_are_found_by_time() -> None:
    facts = [FactChanged(t=t, branch="SB1", digit=0, value="x") for t in (1.0, 2.0, 2.0, 3.0)]
    playback = Playback(facts)
    found = [playback.index_at(t) for t in (0.5, 1.0, 2.0, 2.5, 9.0)]
    assert found == [0, 1, 3, 3, 4]
    assert (playback.time_of(0), playback.time_of(3), playback.end) == (0.0, 2.0, 3.0)
    assert Playback(()).end == 0.0
