"""What people, agents and scripts do to a run, what follows from it, and what they are asked."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.address import split_fact
from smsl_studio.runlog import events as run
from smsl_studio.runlog.command_word import CommandWord
from smsl_studio.runlog.grammar.memory import Asked, Memory, parts

LATCHED = ("stopped", "taken_over")


def commanded(said: Memory, event: run.Commanded) -> Iterator[str]:
    """It is carried out only in a run state that does not refuse it."""
    phase, known = said.fold.phase, said.commands.get(event.command)
    if known is None:
        yield f"there is no command {event.command!r}"
    elif (
        not event.refused
        and phase in known.refused
        and (not said.may_go_on or "running" in known.refused)
    ):
        word, state = event.command.replace("_", " "), phase.replace("_", " ")
        yield f"{word} is carried out in a run that is {state}"
    yield from _unclear(event, known)


def _unclear(event: run.Commanded, known: CommandWord | None) -> Iterator[str]:
    """What a command is about, and what it says of it."""
    word = event.command.replace("_", " ")
    named = len(parts(event.address)) == 3
    if not event.by:
        yield f"{word} is said by nobody"
    if known is not None and known.must_name:
        if not (named or event.refused):
            yield f"{word} names no operation"
    elif event.address and not (named and known is not None and known.may_name):
        yield f"{word} names an operation"
    silent = event.command == "answer" or event.refused
    says = known is not None and known.has_value
    if bool(event.value) != says and not (silent and not event.value):
        yield f"{word} says {event.value or 'nothing'!r}"


def paused(said: Memory, event: run.Paused) -> Iterator[str]:
    """It went on until now."""
    if not said.wanted_pause:
        yield "a run is paused, and nobody wanted that"
    if said.fold.phase not in ("ready", "running", "waiting", "idle", "paused"):
        yield f"a run is paused that is {said.fold.phase.replace('_', ' ')} already"


def resumed(said: Memory, event: run.Resumed) -> Iterator[str]:
    """Somebody resumed it."""
    if not said.caused("resume"):
        yield "the run goes on, and nobody said so"


def stopped(said: Memory, event: run.RunStopped) -> Iterator[str]:
    """Somebody stopped it, and who did is named."""
    if not said.caused("stop", event.by):
        yield f"the run is stopped by {event.by}, who did not say so"


def reset(said: Memory, event: run.RunReset) -> Iterator[str]:
    """Somebody unlatched what was stopped."""
    if not said.fold.stopped:
        yield "a run is reset that was not stopped"
    if not said.caused("reset", event.by):
        yield f"the run is reset by {event.by}, who did not say so"


def taken_over(said: Memory, event: run.TakenOver) -> Iterator[str]:
    """Somebody took it over, and who did is named."""
    if not said.caused("take_over", event.by):
        yield f"the run is taken over by {event.by}, who did not say so"


def given_back(said: Memory, event: run.GivenBack) -> Iterator[str]:
    """Somebody accepted where the scene has it."""
    if not said.fold.taken_over:
        yield "a run is given back that nobody has taken over"
    if not said.caused("accept", event.by):
        yield f"the run is given back by {event.by}, who did not say so"
    if not said.is_configuration(event.configuration):
        yield "the run is given back in what is no configuration of it"


def disturbed(said: Memory, event: run.Disturbed) -> Iterator[str]:
    """Somebody disturbs sensors."""
    wanted = f"{event.target} {event.kind}"
    if not said.caused("disturb") or said.cause is None or said.cause.value != wanted:
        yield f"{event.target} is disturbed, and nobody said so"


def fault_injected(said: Memory, event: run.FaultInjected) -> Iterator[str]:
    """Somebody has something go wrong."""
    if not said.caused("inject") or said.cause is None or said.cause.value != event.fault:
        yield f"{event.fault} goes wrong, and nobody said so"


KINDS = ("operation", "confirm", "supervise", "fact", "start")
"""What people are asked for."""

# tasks ------------------------------------------------------------------------------------------


def task_opened(said: Memory, event: run.TaskOpened) -> Iterator[str]:
    """A new question, with options, for somebody, in time."""
    if event.task in said.names:
        yield f"{event.task} is opened for the second time"
    if len(parts(event.address)) != 3 and event.kind in ("operation", "confirm", "supervise"):
        yield f"{event.task} is about no operation"
    elif event.kind == "fact" and split_fact(event.address) is None:
        yield f"{event.task} is about no fact"
    elif event.kind not in KINDS:
        yield f"a person is not asked for {event.kind!r}"
    if not event.options or len(set(event.options)) < len(event.options):
        yield f"{event.task} has no options, or one of them twice"
    if event.persons < 1 or event.deadline < event.t:
        yield f"{event.task} is nobody's, or too late before it begins"


def task_escalated(said: Memory, event: run.TaskEscalated) -> Iterator[str]:
    """Another role is asked, once."""
    asked = said.tasks.get(event.task)
    if asked is None or asked.escalated:
        yield f"{event.task} is escalated; it is not open, or it was escalated before"


def task_answered(said: Memory, event: run.TaskAnswered) -> Iterator[str]:
    """Somebody has said something; it counts where the task is open and they are not the same."""
    cause = said.cause
    if cause is None or cause.command != "answer" or cause.by != event.by or cause.t != event.t:
        yield f"{event.by} answers {event.task} without having said anything"
    elif cause.value not in ("", event.task) or cause.refused != event.refused:
        yield f"{event.by} answers {event.task}, and said something else"
    if event.refused:
        return
    asked = said.tasks.get(event.task)
    if asked is None:
        yield f"{event.task} is answered; it is not open"
    elif event.by in asked.answered:
        yield f"{event.by} answers {event.task} for the second time"
    elif event.t >= asked.opened.deadline:
        yield f"{event.task} is answered too late, and it counts"


def task_closed(said: Memory, event: run.TaskClosed) -> Iterator[str]:
    """It ends as its answers have it, or because time ran out, or because nobody needs it."""
    asked = said.tasks.get(event.task)
    if asked is None:
        yield f"{event.task} is closed; it is not open"
    elif event.outcome not in _OUTCOMES:
        yield f"a task cannot end {event.outcome!r}"
    elif not _OUTCOMES[event.outcome](asked, event):
        yield f"{event.task} is {event.outcome.replace('_', ' ')}, and its answers say otherwise"


def _all_in(asked: Asked, event: run.TaskClosed) -> bool:
    """Whether everybody who was needed has answered, and each is told with an option."""
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
