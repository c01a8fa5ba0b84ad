"""What a scrubber marks: where a run held, where something went wrong, where it committed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from smsl_studio.runlog import events as run
from smsl_studio.runlog.events import Event

HELD, FAULT, PERSON, COMMIT = "held", "fault", "person", "commit"
KINDS = (COMMIT, PERSON, FAULT, HELD)
"""The gravest last, so that it is painted over the others."""


def kind_of(event: Event) -> str:
    """How an event is marked; empty for not at all."""
    match event:
        case run.Held() | run.RunStopped():
            return HELD
        case run.RunFinished():
            return COMMIT if event.reason == "goal_reached" else HELD
        case run.Mismatch() | run.OperationRisky() | run.FaultInjected() | run.Disturbed():
            return FAULT
        case run.OperationEnded() if event.outcome != "returned":
            return FAULT
        case run.Commanded() | run.TaskOpened() | run.TaskClosed():
            return PERSON
        case run.Committed():
            return COMMIT
        case _:
            return ""


def marks_of(events: Sequence[Event]) -> Iterator[tuple[float, str]]:
    """(simulated s, kind) of every event that is marked, in order of time."""
    for event in events:
        kind = kind_of(event)
        if kind:
            yield event.t, kind
