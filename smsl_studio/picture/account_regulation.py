"""The words of an account for commands, tasks, disturbances and faults.

The words of a command stand in its row of the table, which the caller passes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from smsl_studio.runlog import events as run
from smsl_studio.runlog.command_word import CommandWords
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.regulation import COMPARISONS, NONE

LONGEST = 40
"""The largest number of operations or prices in one line. The log has all of them."""


def states(configuration: Mapping[str, str]) -> str:
    """Return a configuration as one line."""
    return ", ".join(f"{branch}/{state}" for branch, state in configuration.items())


def listed(words: str, details: tuple[str, ...]) -> str:
    """Return a sentence, with its details after a colon."""
    return f"{words}: {'; '.join(details)}" if details else words


def commanded(event: run.Commanded, commands: CommandWords) -> str:
    """Return the sentence of a command from its row. A command without a row is told by its
    name.
    """
    known = commands.get(event.command)
    address = event.address or "the next operation"
    said = known.told(address, event.value) if known is not None else ""
    words = said or f"Commanded {event.command.replace('_', ' ')}"
    why = f" ({event.reason})" if event.reason else ""
    return f"{words}{why}{f', which was refused: {event.refused}' if event.refused else ''}"


def _opened(event: run.TaskOpened) -> str:
    who = event.role or "anybody"
    many = f", {event.persons} different people" if event.persons > 1 else ""
    about = f" about {event.address}" if event.address else ""
    return (
        f"Asked{about} ({event.task}), whose task it is: {who}{many}, until {event.deadline:g} s: "
        f"{event.question} {' / '.join(event.options)}"
    )


def _answered(event: run.TaskAnswered) -> str:
    if event.refused:
        return f"An answer to {event.task} does not count: {event.refused}"
    return f"{event.task} has an answer, which stays hidden until all are in"


def _closed(event: run.TaskClosed) -> str:
    said = "; ".join(f"{by}: {answer}" for by, answer in event.answers.items())
    ends = {
        "answered": f"{event.task} was answered with {event.answer}",
        "disagreed": f"The answers to {event.task} differ, so nothing is done",
        "timed_out": f"Nobody answered {event.task} in time, which is no yes",
        "withdrawn": f"{event.task} is not asked any more",
    }
    return ends.get(event.outcome, f"{event.task} ended ({event.outcome})") + (
        f" ({said})" if said else ""
    )


def _disturbed(event: run.Disturbed) -> str:
    if event.kind == "none":
        return f"{event.target} is disturbed no more"
    with_ = ", ".join(f"{name} {value}" for name, value in event.parameters.items())
    which = f" ({', '.join(event.sensors)})" if event.sensors else ""
    return f"{event.target}{which} is disturbed: {event.kind}{f', {with_}' if with_ else ''}"


def _injected(event: run.FaultInjected) -> str:
    with_ = ", ".join(f"{name} {value}" for name, value in event.parameters.items())
    return f"Something goes wrong on purpose: {event.fault}{f' ({with_})' if with_ else ''}"


def _reset(event: run.RunReset) -> str:
    words = "The stop was unlatched; the run is paused"
    return listed(f"{words}. Unknown until sensed anew", event.unknown) if event.unknown else words


def _risk(event: run.RiskEstimated) -> str:
    words = ", ".join(event.reasons[:LONGEST])
    return f"{event.address} has a risk of {event.risk:.0%}: {words}"


def _forecast(event: run.ForecastTold) -> str:
    if event.verdict == NONE:
        return f"{event.address} has no forecast: {event.reason}"
    was = "was " if event.verdict in COMPARISONS else ""
    words = f"The forecast of {event.address} {was}{event.verdict}"
    return f"{words}: {event.reason}" if event.reason else words


def _costs(event: run.CostsChanged) -> str:
    prices = [f"{name} {cost:g}" for name, cost in [*event.costs.items()][:LONGEST]]
    words = [f"Costs changed: {', '.join(prices)}"] if prices else []
    for name, reason in [*event.closed.items()][:LONGEST]:
        words.append(f"{name} is not available: {reason}" if reason else f"{name} is available")
    return "; ".join((*words, *event.faults))


WORDS: Mapping[type[Event], Callable[[Any], str]] = MappingProxyType(
    {
        run.RiskEstimated: _risk,
        run.ForecastTold: _forecast,
        run.EdgeGenerated: lambda e: (
            f"{e.address} to {e.target} counts in this run, as {e.provider} has proposed it"
        ),
        run.TakenOver: lambda e: "Automation is locked out; the dispatcher only observes",
        run.GivenBack: lambda e: f"Given back in {states(e.configuration)}",
        run.RunStopped: lambda e: "The run is stopped and braked",
        run.RunReset: _reset,
        run.TaskOpened: _opened,
        run.TaskEscalated: lambda e: f"Half the time of {e.task} has passed: {e.role} is asked too",
        run.TaskAnswered: _answered,
        run.TaskClosed: _closed,
        run.Disturbed: _disturbed,
        run.FaultInjected: _injected,
        run.CostsChanged: _costs,
    }
)
