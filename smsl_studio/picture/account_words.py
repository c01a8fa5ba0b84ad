"""The words of an account: the kind of each event, its sentence, and who caused it."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from types import MappingProxyType
from typing import Any

from smsl_studio.blueprint.address import fact_text
from smsl_studio.picture import account_regulation as regulating
from smsl_studio.picture.account_regulation import LONGEST, listed, states
from smsl_studio.runlog import events as run
from smsl_studio.runlog.command_word import CommandWords
from smsl_studio.runlog.decoder import event_of
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.names import NAMELESS, HeaderNames

BELIEVED, SENSED, DECIDED, DONE, ASKED = "believed", "sensed", "decided", "done", "asked"
_KINDS: Mapping[type[Event], str] = MappingProxyType(
    {
        run.RunStarted: BELIEVED,
        run.Committed: BELIEVED,
        run.Relocalised: BELIEVED,
        run.GoalReached: BELIEVED,
        run.FactChanged: SENSED,
        run.StateChecked: SENSED,
        run.Mismatch: SENSED,
        run.HazardMet: SENSED,
        run.LeftOut: BELIEVED,
        run.OperationStarted: DONE,
        run.OperationEnded: DONE,
        run.Disturbed: DONE,
        run.Within: DONE,
        run.FaultInjected: DONE,
        run.TaskOpened: ASKED,
        run.TaskEscalated: ASKED,
        run.TaskAnswered: ASKED,
        run.TaskClosed: ASKED,
        run.GivenBack: BELIEVED,
    }
)
"""An event that is not listed here is a decision."""
BY_HAND = "done by "
"""The first words of the message if a person carried out an operation."""
NOBODY = "nobody has answered yet"
"""The reason of an unknown fact that only a person can tell. No sensor has reported anything."""

_BAD = (
    run.HazardMet,
    run.LeftOut,
    run.Mismatch,
    run.OperationRisky,
    run.OperationRefused,
    run.Held,
    run.RunStopped,
    run.TakenOver,
    run.FaultInjected,
)


@dataclass(frozen=True, slots=True)
class AccountLine:
    """One line of the account."""

    kind: str
    what: str
    by: str
    bad: bool


def told(
    event: Event,
    commands: CommandWords,
    world: str = "",
    cause: str = "",
    names: HeaderNames = NAMELESS,
) -> AccountLine:
    """Return the line of an event. An event without a sentence of its own is told by its fields.

    ``commands`` are the commands that the log may contain. ``cause`` names who gave the command
    that the event answers (see ``Causes``). ``names`` has the names that people use.
    """
    kind = _KINDS.get(type(event), DECIDED)
    named = event if isinstance(event, run.FactChanged) else names.told_in(event)
    if isinstance(named, run.FactChanged):
        words = _fact(named, names)
    elif isinstance(named, run.Commanded):
        words = regulating.commanded(named, commands)
    else:
        words = _WORDS.get(type(event), _plainly)(named)
    return AccountLine(kind, words, cause or _by(event, kind, world), _is_bad(event))


def vanished(more: int, what: str) -> str:
    """Return a line with the number of events that are left out, or the empty text if there are
    none.
    """
    if more <= 0:
        return ""
    return f"<p>And {more:,} more {what}{'' if more == 1 else 's'}, which the log has.</p>"


def _by(event: Event, kind: str, world: str) -> str:
    """Return who caused an event: the name in the event, or else the part of the program."""
    if isinstance(event, run.TaskClosed):
        return ", ".join(event.answers) or "dispatcher"
    by = getattr(event, "by", "")
    if by:
        role = getattr(event, "role", "")
        return f"{by}, {role}" if role else str(by)
    if isinstance(event, run.OperationStarted) and not event.function:
        return "dispatcher"
    if isinstance(event, run.OperationStarted | run.OperationEnded):
        return "library function"
    if isinstance(event, run.FactChanged) and event.reason == NOBODY:
        return "nobody"
    if isinstance(event, run.FactChanged):
        return f"sensors of {world}" if world else "sensors"
    return "dispatcher" if kind != SENSED else "state check"


def _is_bad(event: Event) -> bool:
    if isinstance(event, run.StateChecked):
        return event.result != "true"
    if isinstance(event, run.OperationEnded):
        return event.outcome != "returned"
    if isinstance(event, run.RunFinished):
        return event.reason != "goal_reached"
    if isinstance(event, run.TaskClosed):
        return event.outcome != "answered"
    if isinstance(event, run.Commanded | run.TaskAnswered):
        return bool(event.refused)
    return isinstance(event, _BAD)


def _started(event: run.RunStarted) -> str:
    return f"The run begins in {states(event.start)}; it is to reach {', '.join(event.goals)}"


def _route(event: run.RoutePlanned) -> str:
    shown = ", ".join(event.operations[:LONGEST])
    more = f" and {len(event.operations) - LONGEST:,} more" * (len(event.operations) > LONGEST)
    return f"Route to {event.goal}, cost {event.cost:g}: {shown or 'no operation'}{more}"


def _operation(event: run.OperationStarted) -> str:
    how = f" by {event.function}" if event.function else "; no function of its own"
    return f"{event.address} to {event.target} is carried out{how}"


def _ended(event: run.OperationEnded) -> str:
    message = (event.message,) * bool(event.message)
    if event.message.startswith(BY_HAND):
        return listed(f"{event.address} was done by hand", message)
    return listed(f"The function of {event.address} {event.outcome}", message)


def _checked(event: run.StateChecked) -> str:
    words = listed(f"State check of {event.address} is {event.result}", event.misses)
    return words + (f"; unknown: {'; '.join(event.unknown)}" if event.unknown else "")


def _fact(event: run.FactChanged, names: HeaderNames) -> str:
    fact = fact_text(event.branch, event.digit)
    reads = "is unknown" if event.value is None else f"reads {names.value(fact, event.value)}"
    why = f" ({event.reason})" if event.reason else ""
    return f"{names.fact(event.branch, event.digit)} of {event.branch} {reads}{why}"


def measured_words(event: run.Measured) -> str:
    """Return what a source has measured, or why it has no measure."""
    said = f"measures {event.value}" if event.value is not None else "measures nothing"
    why = f" ({event.reason})" if event.reason else ""
    quality = "" if event.quality == "good" else f", {event.quality}"
    return f"{event.source} of {fact_text(event.branch, event.digit)} {said}{quality}{why}"


def _committed(event: run.Committed) -> str:
    return f"{', '.join(event.operations)} became true: {states(event.configuration)}"


def _within(event: run.Within) -> str:
    """Return what the blueprint that an operation runs tells, one level down."""
    try:
        told = event_of(json.loads(event.told))
    except (ValueError, TypeError, AttributeError, RecursionError):
        return f"{event.operation} tells something that no run tells"
    if isinstance(told, run.Within):
        return f"{event.operation} tells something that no run tells"
    if isinstance(told, run.FactChanged):
        said = _fact(told, NAMELESS)
    else:
        said = _WORDS.get(type(told), _plainly)(told)
    return f"Within {event.operation}: {said}"


def _mismatch(event: run.Mismatch) -> str:
    words = listed("Sensed facts and beliefs differ", event.facts)
    fitting = " or ".join(states(one) for one in event.candidates) or "no configuration"
    return f"{words}. The scene agrees with {fitting}"


def _plainly(event: Event) -> str:
    said = ", ".join(
        f"{item.name} {getattr(event, item.name)}" for item in fields(event) if item.name != "t"
    )
    return f"{event.event.replace('_', ' ')}: {said}" if said else event.event.replace("_", " ")


_WORDS: Mapping[type[Event], Callable[[Any], str]] = MappingProxyType(
    {
        run.RunStarted: _started,
        run.Measured: measured_words,
        run.RoutePlanned: _route,
        run.SubsBypassed: lambda e: f"{e.sentence} ({e.address})",
        run.OperationStarted: _operation,
        run.OperationEnded: _ended,
        run.StateChecked: _checked,
        run.Committed: _committed,
        run.Mismatch: _mismatch,
        run.OperationRefused: lambda e: listed(f"{e.address} was refused", e.reasons),
        run.Within: _within,
        run.OperationRisky: lambda e: f"{e.address} is tagged risky: {e.reason}",
        run.OperationPruned: lambda e: f"{e.address} was shut out: {e.reason}",
        run.OperationRestored: lambda e: f"{e.address} may be used again",
        run.Relocalised: lambda e: f"The scene was read again: {states(e.configuration)}",
        run.HazardMet: lambda e: (
            f"The hazard {e.name} is met: {', '.join(f'{f} is {v}' for f, v in e.facts.items())}"
        ),
        run.LeftOut: lambda e: f"The run begins without {e.address}: {e.sentence}",
        run.Held: lambda e: listed(f"The run holds: {e.reason}", e.details),
        run.Paused: lambda e: "The run was paused",
        run.Resumed: lambda e: "The run goes on",
        run.GoalReached: lambda e: f"The goal {e.goal} holds",
        **regulating.WORDS,
        run.RunFinished: lambda e: f"The run ended ({e.reason}): {e.sentence}",
    }
)
