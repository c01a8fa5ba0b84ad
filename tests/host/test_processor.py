"""The processor time of a child: a child without processor time does not count as silent."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from smsl_studio.host.processor import ProcessorTime

Time = ProcessorTime


@pytest.mark.parametrize(
    ("before", "after", "starved"),
    [
        pytest.param(Time(0), Time(0.05, waited=0.04), True, id="waited, and has worked since"),
        pytest.param(Time(0), Time(0.05, ready=True), True, id="waits still"),
        pytest.param(Time(0, 7.0), Time(0.05, 7.002, 0.0, True), True, id="taken from the machine"),
        pytest.param(
            Time(0, 7.0), Time(0.05, 7.048, 0.0, True), False, id="works and says nothing"
        ),
        pytest.param(Time(0, 7.0), Time(0.05, 7.02, 0.0, True), False, id="works, half as quick"),
        pytest.param(Time(0, 7.0), Time(0.05, 7.001), False, id="sleeps"),
        pytest.param(Time(0, 7.0), Time(0.05, 7.03, 0.02), False, id="had enough to answer"),
        pytest.param(Time(0), Time(0.05), False, id="the kernel tells nothing"),
    ],
)
def test_who_could_have_worked_and_was_not_let_is_starved(
    before: Time, after: Time, starved: bool
) -> None:
    assert after.starved_since(before) is starved


@pytest.mark.parametrize(("work", "busy"), [("while True: pass", True), ("input()", False)])
def test_the_kernel_tells_who_is_ready_and_that_it_has_run(work: str, busy: bool) -> None:
    command = [sys.executable, "-c", f"print(flush=True)\n{work}"]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe) as process:
        assert process.stdout is not None
        process.stdout.readline()
        first = ProcessorTime.of(process.pid)
        while busy and ProcessorTime.of(process.pid).ran <= first.ran:
            os.sched_yield()
        while not busy and ProcessorTime.of(process.pid).ready:
            os.sched_yield()  # it has said its line, and goes to sleep next
        found = ProcessorTime.of(process.pid)
        process.kill()
    assert found.ready is busy
    assert found.ran > 0
    assert found.at >= first.at


def test_of_a_process_that_is_gone_nothing_is_known() -> None:
    process = subprocess.Popen([sys.executable, "-c", ""])
    process.wait()
    found = ProcessorTime.of(process.pid)
    assert found == ProcessorTime(found.at)
