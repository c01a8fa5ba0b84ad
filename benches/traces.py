"""Traces: a run has equal events in this process, in a child, in the window, and from its log."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from benches.row import Row
from tests.front.any_run import AnyRun, any_run
from tests.front.test_traces import in_child_and_log, in_process, in_window

RUNS = 200
WINDOW = 300.0
"""The wall time (s) that a run may take in the window."""


def rows() -> Iterator[Row]:
    return compared("random runs under random scripts", map(any_run, range(RUNS)))


def compared(words: str, runs: Iterable[AnyRun]) -> Iterator[Row]:
    """Carry each run out in the three places, read the log of one, and count what differs."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from PySide6.QtWidgets import QApplication

    application = QApplication.instance() or QApplication([])

    def wait(over: Callable[[], bool]) -> None:
        end = time.monotonic() + WINDOW
        while not over() and time.monotonic() < end:
            application.processEvents()
            time.sleep(0.01)

    count, differing = 0, {"a child process": 0, "the log": 0, "the window": 0}
    with TemporaryDirectory() as folder:
        for run in runs:
            count += 1
            told = in_process(run)
            child, log = in_child_and_log(run, Path(folder) / f"{count}.jsonl")
            found = (child, log, in_window(run, wait))
            for place, trace in zip(differing, found, strict=True):
                if trace != told:
                    differing[place] += 1
                    # A child that gets too little time is ended, and then its last event says so.
                    last = (trace or ["nothing"])[-1][:300]
                    print(f"{words}, run {count}, {place}: {last}", file=sys.stderr, flush=True)
    for place, many in differing.items():
        yield Row(f"{count} {words}, here and in {place}", many, "traces differ", bound="0")
