"""Run events in the words of an account: of which kind they are, what they say, who did it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from types import MappingProxyType
from typing import Any

from smsl_studio.runlog import events as run
from smsl_studio.runlog.events import Event

BELIEVED, SENSED, DECIDED, DONE = "believed", "sensed", "decided", "done"
_KINDS: Mapping[type[Event], str] = MappingProxyType(
    {
        run.RunStarted: BELIEVED,
        run.Committed: BELIEVED,
        run.Relocalised: BELIEVED,
        run.GoalReached: BELIEVED,
        run.FactChanged: SENSED,
        run.StateChecked: SENSED,
        run.Mismatch: SENSED,
        run.OperationStarted: DONE,
        run.OperationEnded: DONE,
    }
)
"""What is not listed was decided."""

_PEOPLE = (run.OperationPruned, run.OperationRestored, run.Paused, run.Resumed)
_BAD = (run.Mismatch, run.OperationRisky, run.OperationRefused, run.Held)
_LONGEST = 40
"""So many names of a route stand in its line; all of them are listed beside it."""


@dataclass(frozen=True, slots=True)
class Told:
    """One line of the account."""

    kind: str
    what: str
    by: str
    bad: bool


def told(event: Event, world: str = "") -> Told:
    """An event as the account has it; an event without words of its own is told by its fields."""
    write = _WORDS.get(type(event), _plainly)
    kind = _KINDS.get(type(event), DECIDED)
    return Told(kind, write(event), _by(event, kind, world), _is_bad(event))


def vanished(more: int, what: str) -> str:
    """A line for what is not told one by one; empty where nothing was left out."""
    if more <= 0:
        return ""
    return f"<p>And {more:,} more {what}{'' if more == 1 else 's'}, which the log has.</p>"


def _by(event: Event, kind: str, world: str) -> str:
    if isinstance(event, run.OperationStarted | run.OperationEnded):
        return "library function"
    if isinstance(event, run.FactChanged):
        return f"sensors of {world}" if world else "sensors"
    if isinstance(event, _PEOPLE):
        return "person"
    if isinstance(event, run.RunFinished) and event.reason == "stopped":
        return "person"
    return "dispatcher" if kind != SENSED else "state check"


def _is_bad(event: Event) -> bool:
    if isinstance(event, run.StateChecked):
        return event.result != "true"
    if isinstance(event, run.OperationEnded):
        return event.outcome != "returned"
    if isinstance(event, run.RunFinished):
        return event.reason != "goal_reached"
    return isinstance(event, _BAD)


def _states(configuration: Mapping[str, str]) -> str:
    return ", ".join(f"{branch}/{state}" for branch, state in configuration.items())


def _with(words: str, details: tuple[str, ...]) -> str:
    return f"{words}: {'; '.join(details)}" if details else words


def _started(event: run.RunStarted) -> str:
    return f"The run begins in {_states(event.start)}; it is to reach {', '.join(event.goals)}"


def _route(event: run.RoutePlanned) -> str:
    shown = ", ".join(event.operations[:_LONGEST])
    more = f" and {len(event.operations) - _LONGEST:,} more" * (len(event.operations) > _LONGEST)
    return f"Route to {event.goal}, cost {event.cost:g}: {shown or 'no operation'}{more}"


def _operation(event: run.OperationStarted) -> str:
    how = f" by {event.function}" if event.function else "; no function of its own"
    return f"{event.address} to {event.target} is carried out{how}"


def _ended(event: run.OperationEnded) -> str:
    return _with(
        f"The function of {event.address} {event.outcome}", (event.message,) * bool(event.message)
    )


def _checked(event: run.StateChecked) -> str:
    words = _with(f"State check of {event.address} is {event.result}", event.misses)
    return words + (f"; unknown: {'; '.join(event.unknown)}" if event.unknown else "")


def _fact(event: run.FactChanged) -> str:
    reads = "is unknown" if event.value is None else f"reads {event.value}"
    why = f" ({event.reason})" if event.reason else ""
    return f"Fact {event.digit} of {event.branch} {reads}{why}"


def _committed(event: run.Committed) -> str:
    return f"{', '.join(event.operations)} became true: {_states(event.configuration)}"


def _mismatch(event: run.Mismatch) -> str:
    words = _with("Sensed facts and beliefs differ", event.facts)
    fitting = " or ".join(_states(one) for one in event.candidates) or "no configuration"
    return f"{words}. The scene agrees with {fitting}"


def _plainly(event: Event) -> str:
    said = ", ".join(
        f"{item.name} {getattr(event, item.name)}" for item in fields(event) if item.name != "t"
    )
    return f"{event.event.replace('_', ' ')}: {said}" if said else event.event.replace("_", " ")


_WORDS: Mapping[type[Event], Callable[[Any], str]] = MappingProxyType(
    {
        run.RunStarted: _started,
        run.RoutePlanned: _route,
        run.OperationStarted: _operation,
        run.OperationEnded: _ended,
        run.StateChecked: _checked,
        run.FactChanged: _fact,
        run.Committed: _committed,
        run.Mismatch: _mismatch,
        run.OperationRefused: lambda e: _with(f"{e.address} was refused", e.reasons),
        run.OperationRisky: lambda e: f"{e.address} is tagged risky: {e.reason}",
        run.OperationPruned: lambda e: f"{e.address} was shut out: {e.reason}",
        run.OperationRestored: lambda e: f"{e.address} may be used again",
        run.Relocalised: lambda e: f"The scene was read again: {_states(e.configuration)}",
        run.Held: lambda e: _with(f"The run holds: {e.reason}", e.details),
        run.Paused: lambda e: "The run was paused",
        run.Resumed: lambda e: "The run goes on",
        run.GoalReached: lambda e: f"The goal {e.goal} holds",
        run.RunFinished: lambda e: f"The run ended ({e.reason}): {e.sentence}",
    }
)
