"""The marks of events on a time bar: holds, faults, people and commits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from smsl_studio.runlog import events as run
from smsl_studio.runlog.events import Event

HELD, FAULT, PERSON, COMMIT = "held", "fault", "person", "commit"
KINDS = (COMMIT, PERSON, FAULT, HELD)
"""The most serious kind comes last, so it is painted over the others."""


def kind_of(event: Event) -> str:
    """Return the kind of an event's mark, or the empty text for none."""
    match event:
        case run.Held() | run.RunStopped():
            return HELD
        case run.RunFinished():
            return COMMIT if event.reason == "goal_reached" else HELD
        case run.Mismatch() | run.OperationRisky() | run.FaultInjected() | run.Disturbed():
            return FAULT
        case run.HazardMet():
            return FAULT
        case run.OperationEnded() if event.outcome != "returned":
            return FAULT
        case run.Commanded() | run.TaskOpened() | run.TaskClosed() | run.EdgeGenerated():
            return PERSON
        case run.Committed():
            return COMMIT
        case _:
            return ""


def marks_of(events: Sequence[Event]) -> Iterator[tuple[float, str]]:
    """Yield the simulated time (s) and the kind of every marked event, in order of time."""
    for event in events:
        kind = kind_of(event)
        if kind:
            yield event.t, kind
