"""A run has the same trace in this process, in a child, in the window, and from its log."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication

import smsl_studio as smsl
from smsl_studio import front
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.front.script.player import ScriptPlayer
from smsl_studio.runlog.changes import after
from smsl_studio.runlog.events import Event, RunFinished
from smsl_studio.runlog.grammar.log_reader import read_log
from smsl_studio.runlog.moment import RunMoment
from smsl_studio.studio.running.runner import FASTEST, Runner
from tests.front.any_run import AnyRun, any_run

RUNS = 20


def lines(events: tuple[Event, ...]) -> list[str]:
    return [event.line() for event in events]


def in_process(run: AnyRun) -> list[str]:
    return lines(smsl.run(run.blueprint, script=run.script, **run.asked).events)


def in_child_and_log(run: AnyRun, log: Path) -> tuple[list[str], list[str]]:
    """What a run in a child process tells, and what its log tells afterwards."""
    told = smsl.run(run.blueprint, script=run.script, host="process", log=log, **run.asked)
    found = read_log(log, COMMANDS)
    assert found.doubt is None
    return lines(told.events), [record.text for record in found.records]


def in_window(run: AnyRun, wait: Callable[[Callable[[], bool]], None]) -> list[str]:
    """What the window's loop hears."""
    acting = ScriptPlayer(run.script)

    def make() -> Dispatcher:
        return front.open_run(run.blueprint, host="process", attended=True, **run.asked)

    runner = Runner(make, FASTEST, acting=acting)
    told: list[Event] = []

    def over() -> bool:
        news = runner.take()
        told.extend(news[0] if news else ())
        return bool(told) and isinstance(told[-1], RunFinished)

    runner.start()
    wait(over)
    runner.close()
    return lines(tuple(told))


@pytest.mark.parametrize("number", range(RUNS))
def test_any_run_leaves_the_same_trace_everywhere(number: int, tmp_path: Path) -> None:
    run = any_run(number)
    told = in_process(run)
    assert in_child_and_log(run, tmp_path / "log") == (told, told)


@pytest.mark.parametrize("number", range(RUNS))
def test_any_run_leaves_the_same_trace_in_the_window(number: int, qapp: QApplication) -> None:
    run = any_run(number)

    def wait(over: Callable[[], bool]) -> None:
        end = time.monotonic() + 60
        while not over():
            assert time.monotonic() < end, "the run does not end"
            qapp.processEvents()
            time.sleep(0.002)

    assert in_window(run, wait) == in_process(run)


def test_the_runs_are_of_many_kinds() -> None:
    runs = [smsl.run(r.blueprint, script=r.script, **r.asked) for r in map(any_run, range(60))]
    reasons = {run.reason for run in runs}
    assert {"goal_reached", "held", "no_route", "stopped"} <= reasons
    words = {event.event for run in runs for event in run.events}
    assert {"mismatch", "task_closed", "disturbed", "fault_injected", "taken_over", "paused",
            "relocalised", "operation_risky"} <= words  # fmt: skip


@pytest.mark.parametrize("number", range(RUNS))
def test_any_run_can_be_retold_from_its_events(number: int) -> None:
    """After every tick the events alone say how the run stands."""
    run = any_run(number)
    dispatcher = front.open_run(run.blueprint, host="local", attended=True, **run.asked)
    acting, told = ScriptPlayer(run.script), RunMoment()
    happened = dispatcher.open()
    while True:
        acting.hear(happened)
        for event in happened:
            told = after(told, event)
        status = dispatcher.status
        assert told.configuration == status.configuration
        assert told.operations == status.operations
        assert tuple(told.tasks) == tuple(task.name for task in status.tasks)
        sensed = {k: r.value for k, r in status.scene.readings.items() if r.sensed}
        if told.begun:
            assert {key: fact.value for key, fact in told.facts.items()} == sensed
        if dispatcher.finished:
            break
        if told.begun:
            assert told.phase == status.phase
        acting.before(dispatcher)
        happened = dispatcher.tick()
    dispatcher.close()
