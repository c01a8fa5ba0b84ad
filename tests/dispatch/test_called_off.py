"""A stop works while a run plans or waits for its world, and changes nothing in the trace."""

from __future__ import annotations

import pytest

from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.search import Move, PlanSearch
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.dispatch.route.planner import Planner
from smsl_studio.host.protocol import Tick
from smsl_studio.runlog.events import Event
from smsl_studio.stop import StopListener, Stopped, heed, heeding, starving
from tests.dispatch.fake_host import FakeHost
from tests.dispatch.runs import blueprint, goals
from tests.dispatch.test_bounds import wide


class Count:
    """A listener that calls the work off once ``wanted``; it counts how often it was asked."""

    def __init__(self, wanted: int) -> None:
        self.asked, self.wanted = 0, wanted

    def heed(self) -> None:
        self.asked += 1
        if self.asked >= self.wanted:
            raise Stopped


def test_a_search_that_is_called_off_at_every_node_finds_the_same() -> None:
    looked_at: list[int] = []

    def moves(node: int) -> list[Move]:
        looked_at.append(node)
        return [Move(node + step, 1.0, 1, lambda: (), (str(step),), step) for step in (1, 2)]

    search = PlanSearch(0, lambda node: node == 20, moves)
    found = None
    while found is None:
        try:
            with heeding(StopListener(2).heed):
                found = search.found()
        except Stopped:
            continue
    assert [move.what for move in found] == [2] * 10
    assert len(looked_at) == len(set(looked_at)), "no node was looked at twice"


@pytest.mark.parametrize("patience", [2, 3, 10])
def test_a_plan_is_the_same_however_often_it_was_called_off(patience: int) -> None:
    made = blueprint(wide(3))
    hierarchy = Hierarchy(made)
    start, wanted = start_configuration(hierarchy, {}), goals(made, "SB1/State111")
    planner, called_off = Planner(hierarchy), 0
    while True:
        try:
            with heeding(StopListener(patience * (1 + called_off // 10)).heed):
                legs = planner.legs(start, wanted)
            break
        except Stopped:
            called_off += 1
    assert called_off > 3
    assert legs == Planner(hierarchy).legs(start, wanted)


def test_no_more_is_looked_at_once_a_stop_is_wanted() -> None:
    made = blueprint(wide(3))
    dispatcher = _opened(made)
    listener = Count(wanted=5)
    with heeding(listener.heed):
        events = dispatcher.tick()
    assert listener.asked == 5
    assert [event.event for event in events] == []

    dispatcher.stop()
    dispatcher.leave()
    ends = [event.event for event in dispatcher.tick()]
    assert ends == ["commanded", "stopped", "run_finished"]


def test_a_run_that_is_called_off_again_and_again_tells_the_same_story() -> None:
    made = blueprint(wide(2))
    told, calm = _story(made, patience=7), _story(made, patience=0)
    assert [event.line() for event in told] == [event.line() for event in calm]
    assert calm[-1].event == "run_finished"


def test_a_look_shows_what_is_known_and_the_next_one_more() -> None:
    dispatcher = _opened(blueprint(wide(3)))
    dispatcher.pause()
    dispatcher.tick()
    with heeding(StopListener(1).heed):
        hurried = dispatcher.status
    assert hurried.planning
    assert hurried.route == ()
    unhurried = dispatcher.status
    assert not unhurried.planning
    assert len(unhurried.route) > 3
    assert dispatcher.status is unhurried


class MuteHost(FakeHost):
    """A world that does not answer for as long as somebody waits for it."""

    mute = False

    def tick(self) -> Tick:
        while self.mute:
            heed()
        return super().tick()

    def cancel(self, mode: str) -> None:
        while self.mute:
            heed()
        super().cancel(mode)


def test_a_world_that_does_not_answer_holds_up_no_stop() -> None:
    host = MuteHost(blueprint(wide(2)), lasts=5)
    dispatcher = Dispatcher(host.blueprint, host, RunTerms(attended=True))
    dispatcher.open()
    while dispatcher.status.running is None:
        dispatcher.tick()
    host.mute = True
    with heeding(Count(wanted=3).heed):
        assert dispatcher.tick() == ()

    dispatcher.stop(by="N. Kaya")
    *_, stopped, finished = dispatcher.tick()
    assert (stopped.event, finished.event) == ("stopped", "run_finished")
    assert dispatcher.status.reason == "stopped"
    assert dispatcher.status.sentence.startswith("Stopped by N. Kaya.")


def _opened(made: Blueprint) -> Dispatcher:
    dispatcher = Dispatcher(made, FakeHost(made), RunTerms(attended=True))
    dispatcher.open()
    return dispatcher


def _story(made: Blueprint, patience: int) -> list[Event]:
    """The events of a run, each tick of which may heed so often (0: as often as it likes)."""
    dispatcher = Dispatcher(made, FakeHost(made))
    events = list(dispatcher.open())
    ticks = 0
    while not dispatcher.finished:
        ticks += 1
        if patience:
            with heeding(StopListener(patience + ticks // 20).heed):
                events += dispatcher.tick()
        else:
            events += dispatcher.tick()
    return events


@pytest.mark.parametrize(("starves", "looks"), [(True, 4), (False, 1)])
def test_who_is_given_no_time_by_the_machine_is_waited_for_longer_and_not_for_ever(
    starves: bool, looks: int
) -> None:
    with heeding(StopListener(2, most=3).heed), starving(starves):
        for _ in range(looks):
            heed()
        with pytest.raises(Stopped):
            heed()
