"""The events of a live run, one line each."""

from __future__ import annotations

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.picture.account_words import told
from smsl_studio.runlog import events as run


def sentence(event: run.Event) -> str:
    """Return an event as one line."""
    match event:
        case run.RunStarted():
            start = ", ".join(f"{b} in {s}" for b, s in event.start.items())
            return f"Started in the {event.world} world, seed {event.seed}: {start}"
        case run.RoutePlanned():
            return f"Route to {event.goal}: {len(event.operations)} operations, cost {event.cost:g}"
        case run.OperationStarted():
            return f"{event.address} to {event.target} started"
        case run.OperationEnded():
            return f"{event.address} {event.outcome.replace('_', ' ')} {event.message}".rstrip()
        case run.StateChecked():
            why = "; ".join((*event.misses, *event.unknown))
            return f"{event.address} checks {event.result}{': ' + why if why else ''}"
        case run.Committed():
            now = ", ".join(f"{b} in {s}" for b, s in event.configuration.items())
            return f"{', '.join(event.operations)} committed: {now}"
        case run.OperationRefused():
            return f"{event.address} refused: {'; '.join(event.reasons)}"
        case run.OperationRisky():
            return f"{event.address} is risky now: {event.reason}"
        case run.Mismatch():
            return f"Facts and flags differ: {', '.join(event.facts)}"
        case run.Held():
            return f"Held: {event.reason}"
        case run.GoalReached():
            return f"Goal {event.goal} reached"
        case run.RunFinished():
            return f"Finished, {event.reason.replace('_', ' ')}: {event.sentence}"
        case _:
            by = getattr(event, "by", "")
            return f"{told(event, COMMANDS).what}{f'  ({by})' if by else ''}"
