"""The runner ends at once, whatever its world does, and stops its own work at once."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping

import pytest
from pytestqt.qtbot import QtBot

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import HostError
from smsl_studio.generate.rules import hanoi
from smsl_studio.host.local import LocalHost
from smsl_studio.host.protocol import OpenedWorld
from smsl_studio.runlog.events import RunFinished
from smsl_studio.stop import heed
from smsl_studio.studio.running.runner import Runner
from tests.dispatch.fake_host import FakeHost
from tests.dispatch.runs import blueprint
from tests.dispatch.test_bounds import wide

PATIENCE = 20
"""Seconds after which the slow world stands after all, so that a fault cannot hang the tests."""


class SlowHost(LocalHost):
    """A table world that takes long to open, as a plugin that hangs would."""

    def __init__(self) -> None:
        super().__init__(hanoi(2), "table")
        self.opening = threading.Event()
        self.closed = threading.Event()
        self.was_ended = False

    def open(self, start: Mapping[str, str]) -> OpenedWorld:
        self.opening.set()
        self.was_ended = self.closed.wait(PATIENCE)
        if self.was_ended:
            raise HostError("the host is closed")
        return super().open(start)

    def close(self) -> None:
        self.closed.set()
        super().close()


def test_a_world_that_is_still_opening_is_ended_and_not_waited_for(qtbot: QtBot) -> None:
    host = SlowHost()
    runner = Runner(lambda: Dispatcher(hanoi(2), host), 1.0)
    runner.start()
    qtbot.waitUntil(host.opening.is_set)

    runner.close()

    assert runner.isFinished()
    assert host.was_ended


class OpeningHost(LocalHost):
    """A world that is built for ever, by a child that is waited for."""

    def __init__(self) -> None:
        super().__init__(hanoi(2), "table")
        self.opening = threading.Event()

    def open(self, start: Mapping[str, str]) -> OpenedWorld:
        self.opening.set()
        while True:
            heed()


def test_a_stop_calls_off_the_opening_of_a_world(qtbot: QtBot) -> None:
    host = OpeningHost()
    runner = Runner(lambda: Dispatcher(hanoi(2), host), 1.0)
    runner.start()
    qtbot.waitUntil(host.opening.is_set)

    runner.command(COMMANDS["stop"].command())
    qtbot.waitUntil(runner.isFinished)

    news = runner.take()
    assert news is not None
    events, status = news
    assert isinstance(events[-1], RunFinished)
    assert (events[-1].reason, status.phase) == ("stopped", "stopped")


def test_a_stop_calls_off_a_plan_that_has_no_end(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    planning = threading.Event()

    def legs(*_: object) -> None:
        planning.set()
        while True:
            heed()

    monkeypatch.setattr("smsl_studio.dispatch.route.planner.Planner.legs", legs)
    made = blueprint(wide(2))
    runner = Runner(lambda: Dispatcher(made, FakeHost(made), RunTerms(attended=True)), 1.0)
    runner.start()
    qtbot.waitUntil(planning.is_set)
    seen: list[DispatchStatus] = []

    def is_seen(what: Callable[[DispatchStatus], bool]) -> Callable[[], bool]:
        def look() -> bool:
            news = runner.take()
            seen.extend([news[1]] if news is not None else [])
            return any(map(what, seen))

        return look

    try:
        qtbot.waitUntil(is_seen(lambda status: status.planning))
        runner.command(COMMANDS["stop"].command())
        qtbot.waitUntil(is_seen(lambda status: status.phase == "stopped"))
    finally:
        runner.close()
