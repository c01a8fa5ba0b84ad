"""The rules for commands, their effects and tasks for people. Each yields a sentence for each
fault.
"""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.address import split_fact
from smsl_studio.runlog import events as run
from smsl_studio.runlog.command_word import CommandWord
from smsl_studio.runlog.grammar.memory import Asked, Memory, parts
from smsl_studio.runlog.regulation import AGREES, COMPARISONS, DIFFERS, FORECASTS, RIGHT

LATCHED = ("stopped", "taken_over")


def commanded(memory: Memory, event: run.Commanded) -> Iterator[str]:
    """Check that the command exists and may be carried out in this run state."""
    phase, known = memory.fold.phase, memory.commands.get(event.command)
    if known is None:
        yield f"there is no command {event.command!r}"
    elif (
        not event.refused
        and phase in known.refused
        and (not memory.may_go_on or "running" in known.refused)
    ):
        word, state = event.command.replace("_", " "), phase.replace("_", " ")
        yield f"{word} is carried out in a run that is {state}"
    yield from _unclear(event, known)


def _unclear(event: run.Commanded, known: CommandWord | None) -> Iterator[str]:
    """Yield what is wrong with the name, the operation or the value of a command."""
    word = event.command.replace("_", " ")
    named = len(parts(event.address)) == 3
    if not event.by:
        yield f"{word} names no person"
    if known is not None and known.must_name:
        if not (named or event.refused):
            yield f"{word} names no operation"
    elif event.address and not (named and known is not None and known.may_name):
        yield f"{word} names an operation"
    silent = event.command == "answer" or event.refused
    says = known is not None and known.has_value
    if bool(event.value) != says and not (silent and not event.value):
        yield f"{word} says {event.value or 'nothing'!r}"


def risk_estimated(memory: Memory, event: run.RiskEstimated) -> Iterator[str]:
    """Check that a risk is in range, and of an operation."""
    if len(parts(event.address)) != 3 or not 0 <= event.risk <= 1:
        yield f"{event.address!r} has no risk of {event.risk:g}"


def forecast(memory: Memory, event: run.ForecastTold) -> Iterator[str]:
    """Check that a forecast is of an operation and of facts, and that only a forecast that was made
    is compared.
    """
    where, verdict = event.address, event.verdict
    if len(parts(where)) != 3 or verdict not in (*FORECASTS, *COMPARISONS):
        yield f"{where!r} has no forecast that says {verdict!r}"
    elif any(split_fact(key) is None for key in event.facts):
        yield f"the forecast of {where} is about no fact"
    elif event.facts and verdict not in (AGREES, DIFFERS):
        yield f"the forecast of {where} says {verdict!r}, and which facts will change"
    elif verdict in COMPARISONS and where not in memory.foreseen:
        yield f"{where} is compared with a forecast that was not made"
    elif bool(event.reason) == (verdict in (AGREES, RIGHT)):
        yield f"the forecast of {where} says {verdict!r} and {event.reason or 'no reason'!r}"
    elif verdict in (AGREES, DIFFERS):
        memory.foreseen.add(where)


def paused(memory: Memory, event: run.Paused) -> Iterator[str]:
    """Check that somebody wanted a pause, and that the run could be paused."""
    if not (memory.wanted_pause or memory.below_holds):
        yield "a run is paused, but nothing asked for a pause"
    if memory.fold.phase not in ("ready", "running", "waiting", "idle", "paused"):
        yield f"a run is paused that is {memory.fold.phase.replace('_', ' ')} already"


def resumed(memory: Memory, event: run.Resumed) -> Iterator[str]:
    """Check that somebody has resumed the run."""
    if not memory.caused("resume"):
        yield "the run is resumed without a command"


def stopped(memory: Memory, event: run.RunStopped) -> Iterator[str]:
    """Check that the named person has stopped the run."""
    if not memory.caused("stop", event.by):
        yield f"the run is stopped by {event.by}, who did not command it"


def reset(memory: Memory, event: run.RunReset) -> Iterator[str]:
    """Check that the run was stopped, and that the named person has reset it."""
    if not memory.fold.stopped:
        yield "a run is reset that was not stopped"
    if not memory.caused("reset", event.by):
        yield f"the run is reset by {event.by}, who did not command it"


def taken_over(memory: Memory, event: run.TakenOver) -> Iterator[str]:
    """Check that the named person has taken the run over."""
    if not memory.caused("take_over", event.by):
        yield f"the run is taken over by {event.by}, who did not command it"


def given_back(memory: Memory, event: run.GivenBack) -> Iterator[str]:
    """Check that the run was taken over, and that the named person has accepted its
    configuration.
    """
    if not memory.fold.taken_over:
        yield "a run is given back, but nobody had taken it over"
    if not memory.caused("accept", event.by):
        yield f"the run is given back by {event.by}, who did not command it"
    if not memory.is_configuration(event.configuration):
        yield "the run is given back in a configuration that it cannot have"


def disturbed(memory: Memory, event: run.Disturbed) -> Iterator[str]:
    """Check that somebody has commanded this disturbance."""
    wanted = f"{event.target} {event.kind}"
    if not memory.caused("disturb") or memory.cause is None or memory.cause.value != wanted:
        yield f"{event.target} is disturbed without a command"


def fault_injected(memory: Memory, event: run.FaultInjected) -> Iterator[str]:
    """Check that somebody has commanded this fault."""
    if not memory.caused("inject") or memory.cause is None or memory.cause.value != event.fault:
        yield f"{event.fault} is injected without a command"


KINDS = ("operation", "confirm", "supervise", "fact", "start", "generate")
"""The kinds of questions to people."""
OF_EDGES = ("operation", "confirm", "supervise", "generate")
"""Those that are about an operation."""

# tasks ------------------------------------------------------------------------------------------


def task_opened(memory: Memory, event: run.TaskOpened) -> Iterator[str]:
    """Check that the task is new and has a subject, options, persons and a deadline in the
    future.
    """
    if event.task in memory.names:
        yield f"{event.task} is opened for the second time"
    if len(parts(event.address)) != 3 and event.kind in OF_EDGES:
        yield f"{event.task} is about no operation"
    elif event.kind == "fact" and split_fact(event.address) is None:
        yield f"{event.task} is about no fact"
    elif event.kind not in KINDS:
        yield f"a person is not asked for {event.kind!r}"
    if not event.options or len(set(event.options)) < len(event.options):
        yield f"{event.task} has no options, or one of them twice"
    if event.persons < 1 or event.deadline < event.t:
        yield f"{event.task} asks for no person, or its deadline is before its beginning"


def task_escalated(memory: Memory, event: run.TaskEscalated) -> Iterator[str]:
    """Check that the task is open and was not escalated before."""
    asked = memory.tasks.get(event.task)
    if asked is None or asked.escalated:
        yield f"{event.task} is escalated; it is not open, or it was escalated before"


def task_answered(memory: Memory, event: run.TaskAnswered) -> Iterator[str]:
    """Check that the person has given this answer. It counts only if the task is open and the
    person has not answered before.
    """
    cause = memory.cause
    if cause is None or cause.command != "answer" or cause.by != event.by or cause.t != event.t:
        yield f"{event.by} answers {event.task} without a command"
    elif cause.value not in ("", event.task) or cause.refused != event.refused:
        yield f"{event.by} answers {event.task}, but the command was another"
    if event.refused:
        return
    asked = memory.tasks.get(event.task)
    if asked is None:
        yield f"{event.task} is answered; it is not open"
    elif event.by in asked.answered:
        yield f"{event.by} answers {event.task} for the second time"
    elif event.t >= asked.opened.deadline:
        yield f"{event.task} is answered too late, and it counts"


def task_closed(memory: Memory, event: run.TaskClosed) -> Iterator[str]:
    """Check that the outcome agrees with the answers, the deadline, or that nobody needs the
    task.
    """
    asked = memory.tasks.get(event.task)
    if asked is None:
        yield f"{event.task} is closed; it is not open"
    elif event.outcome not in _OUTCOMES:
        yield f"a task cannot end {event.outcome!r}"
    elif not _OUTCOMES[event.outcome](asked, event):
        yield f"{event.task} is {event.outcome.replace('_', ' ')}, and its answers say otherwise"


def _all_in(asked: Asked, event: run.TaskClosed) -> bool:
    """Return whether all persons have answered, each with one of the options."""
    named = sorted(event.answers) == sorted(asked.answered)
    known = set(event.answers.values()) <= set(asked.opened.options)
    return named and known and len(asked.answered) == asked.opened.persons


def _is_answered(asked: Asked, event: run.TaskClosed) -> bool:
    return _all_in(asked, event) and set(event.answers.values()) == {event.answer}


def _is_disagreed(asked: Asked, event: run.TaskClosed) -> bool:
    differ = len(set(event.answers.values())) > 1
    return _all_in(asked, event) and differ and not event.answer


def _is_late(asked: Asked, event: run.TaskClosed) -> bool:
    return not event.answer and not event.answers and event.t >= asked.opened.deadline - 1e-6


def _is_withdrawn(asked: Asked, event: run.TaskClosed) -> bool:
    return not event.answer and not event.answers


_OUTCOMES = {
    "answered": _is_answered,
    "disagreed": _is_disagreed,
    "timed_out": _is_late,
    "withdrawn": _is_withdrawn,
}
