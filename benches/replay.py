"""Replay: a log of 100,000 events is opened, and random moments of it are shown.

A long log is read beside the window. Wall time is measured: the longest time without an answer of
the window while the log is read, and while it is shown.
"""

from __future__ import annotations

import json
import os
import time
from collections.abc import Iterator
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

from benches.row import Row, median_ms
from smsl_studio.runlog.events import Committed, Event, FactChanged, OperationStarted, RunStarted
from smsl_studio.runlog.log import RunLog
from smsl_studio.runlog.playback import Playback

EVENTS = 100_000
JUMPS = 300
PATIENCE = 120.0
"""The wall time (s) within which a log must be read."""


def long_run(count: int = EVENTS) -> tuple[Event, ...]:
    """Return a run in a circle, with three events for each operation."""
    told: list[Event] = [
        RunStarted(t=0.0, world="table", seed=0, start={"SB1": "State_0"}, goals=("SB1/State_9",))
    ]
    while len(told) < count:
        number = len(told) // 3
        here, there = f"State_{number % 10}", f"State_{(number + 1) % 10}"
        edge, t = f"SB1/{here}/Op", number * 0.5
        told += [
            OperationStarted(t=t, address=edge, target=there, function="table.set_facts"),
            FactChanged(t=t + 0.4, branch="SB1", digit=0, value=there[-1]),
            Committed(t=t + 0.5, operations=(edge,), configuration={"SB1": there}),
        ]
    return tuple(told[:count])


def rows() -> Iterator[Row]:
    events = long_run()
    playback = Playback(events)
    yield Row(f"fold {EVENTS:,} events, with snapshots", median_ms(lambda: Playback(events), 3))
    chance, slowest = Random(1), 0.0
    for _ in range(JUMPS):
        at = chance.randrange(EVENTS)
        began = time.perf_counter()
        playback.at(at)
        slowest = max(slowest, time.perf_counter() - began)
    yield Row(f"the slowest of {JUMPS} jumps in them", slowest * 1e3, bound="50 ms")
    with TemporaryDirectory() as folder:
        yield from _opened(_written(Path(folder), events))


def _written(folder: Path, events: tuple[Event, ...]) -> Path:
    """Write the log of a run, with its blueprint beside it."""
    states = {f"State_{n}": {"Op": f"State_{(n + 1) % 10}"} for n in range(10)}
    head = {"INITIAL": "State_0", "ACTIVATING": "State_9", "NUM_FACTS": 1}
    (folder / "round.json").write_text(json.dumps({"SB1": {"HEADER": head, **states}}))
    path = folder / "run.jsonl"
    with RunLog(path, {"file": str(folder / "round.json")}) as log:
        log.write(events)
        log.finish()
    return path


def _opened(path: Path) -> Iterator[Row]:
    """What the window's thread does meanwhile, in steps of Qt's event loop."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from PySide6.QtWidgets import QApplication, QMainWindow

    from smsl_studio.front.inputs import read
    from smsl_studio.front.recordings import open_recording
    from smsl_studio.studio.base.theme import LIGHT
    from smsl_studio.studio.features.replay.playback import ReplayVerbs

    drawn = read(path.with_name("round.json"))
    spent = median_ms(lambda: open_recording(path, drawn), 3)
    yield Row(f"read, verify, fold and tell a log of {EVENTS:,} events", spent)
    application = QApplication.instance() or QApplication([])
    window = QMainWindow()
    window.resize(1280, 800)
    replaying = ReplayVerbs(lambda: drawn, path.parent, LIGHT, window)
    window.setCentralWidget(replaying.pane)
    window.show()
    longest, shown, end = 0.0, 0.0, time.monotonic() + PATIENCE
    replaying.open(path)
    while replaying.opening.reading is not None and time.monotonic() < end:
        began = time.monotonic()
        application.processEvents()
        if replaying.opening.reading is not None:
            longest = max(longest, time.monotonic() - began)
        else:
            shown = time.monotonic() - began
        time.sleep(0.001)
    assert replaying.is_open, "the log was read"
    replaying.stop()
    yield Row("the longest that the window waits meanwhile (wall)", longest * 1e3, bound="1 s")
    yield Row("the time in which it is shown (wall)", shown * 1e3, bound="1 s")
