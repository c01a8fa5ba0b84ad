"""The runner ends at once, whatever its world is doing."""

from __future__ import annotations

import threading
from collections.abc import Mapping

from pytestqt.qtbot import QtBot

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.errors import HostError
from smsl_studio.generate.rules import hanoi
from smsl_studio.host.local import LocalHost
from smsl_studio.host.protocol import Opened
from smsl_studio.studio.run.runner import Runner

PATIENCE = 20
"""Seconds after which the slow world stands after all, so that a fault cannot hang the tests."""


class SlowHost(LocalHost):
    """A table world that takes long to open, as a plugin that hangs would."""

    def __init__(self) -> None:
        super().__init__(hanoi(2), "table")
        self.opening = threading.Event()
        self.closed = threading.Event()
        self.was_ended = False

    def open(self, start: Mapping[str, str]) -> Opened:
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
