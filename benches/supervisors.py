"""The shipped supervisors on Hanoi with faults: what each of them prevented.

Each of the nine faults is injected once into the first operation of the run of three disks, with
failure states, and the sensed state is adopted. The run is done without a supervisor, and under
each of the three. An objection prevented a failure if the same operation began from the same state
in the run without a supervisor, and failed there. Nobody is there to be asked, so a run that asks
holds.

``familiar`` has the log of the run without a fault. ``rules`` vetoes an operation that has failed
in the run once.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from benches.row import Row
from smsl_studio import front
from smsl_studio.front.inputs import read
from smsl_studio.front.runs import open_run
from smsl_studio.runlog.events import (
    Commanded,
    Event,
    Held,
    OperationEnded,
    OperationStarted,
    RunFinished,
)
from smsl_studio.shipped import samples_dir
from tests.plugins.faulted import AFTER, WITH_FAILURES, Case, cases

RULES = """
[[rule]]
failed = 1
answer = "veto"
reason = "it has failed in this run"

[[rule]]
forecast = "differs"
answer = "veto"
reason = "its forecast differs"
"""
SHOW = "show"


@dataclass(frozen=True)
class Outcome:
    """One run: how it ended, what began, what failed, and what a supervisor objected to."""

    reason: str
    begun: tuple[str, ...]
    failed: tuple[str, ...]
    objected: tuple[str, ...]


def rows() -> Iterator[Row]:
    """Run nine faults without a supervisor, and under each of the three."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        rules = folder / "rules.toml"
        rules.write_text(RULES, "utf-8")
        known = folder / "known"
        known.mkdir()
        front.run(read(samples_dir() / WITH_FAILURES), "hanoi", log=known / "run.jsonl")
        asked = {
            "no supervisor": "",
            "rules": f"rules:file={rules}",
            "forecast": "forecast",
            "familiar": f"familiar:folder={known}",
        }
        first = [case for case in cases() if case.during == 1]
        alone: list[Outcome] = []
        for name, supervisor in asked.items():
            begun = time.process_time()
            found = [_run(case, supervisor) for case in first]
            alone = alone or found
            yield from _rows(name, found, alone)
            yield Row(f"{name}: one run", (time.process_time() - begun) / len(found), "CPU s")


def _rows(name: str, found: list[Outcome], alone: list[Outcome]) -> Iterator[Row]:
    reached = sum(one.reason == "goal_reached" for one in found)
    begun, failed = sum(len(one.begun) for one in found), sum(len(one.failed) for one in found)
    objected = sum(len(one.objected) for one in found)
    prevented = sum(
        edge in before.failed
        for one, before in zip(found, alone, strict=True)
        for edge in one.objected
    )
    words = (
        f"Hanoi with nine faults, {name}: {reached} reached, {len(found) - reached} held, "
        f"{begun} operations begun, {failed} failed, {objected} objections"
    )
    yield Row(f"{words}; objections to what fails without it", prevented, "")


def _run(case: Case, supervisor: str) -> Outcome:
    dispatcher = open_run(
        read(samples_dir() / WITH_FAILURES),
        "hanoi",
        host="local",
        on_mismatch="adopt",
        supervisor=supervisor or None,
        forecast=SHOW if supervisor.startswith(("rules", "forecast")) else "",
    )
    try:
        events: list[Event] = list(dispatcher.open())
        due, injected = float("inf"), False
        while not dispatcher.finished:
            new = dispatcher.tick()
            events += new
            if not injected and any(isinstance(event, OperationStarted) for event in new):
                due, injected = dispatcher.time + AFTER, True
            if dispatcher.time >= due:
                dispatcher.inject(case.fault, by="a bench", **case.parameters)
                due = float("inf")
    finally:
        dispatcher.close()
    return _outcome(events)


def _outcome(events: list[Event]) -> Outcome:
    last = events[-1]
    assert isinstance(last, RunFinished)
    objected = [
        event.address or event.reason
        for event in events
        if isinstance(event, Commanded) and event.by != "a bench"
    ]
    return Outcome(
        last.reason,
        tuple(event.address for event in events if isinstance(event, OperationStarted)),
        tuple(
            event.address
            for event in events
            if isinstance(event, OperationEnded) and event.outcome != "returned"
        ),
        tuple(objected) or tuple(e.reason for e in events if isinstance(e, Held) and supervised(e)),
    )


def supervised(event: Held) -> bool:
    """Whether a hold is that of a supervisor who asked, and nobody was there."""
    return " asks about " in event.reason
