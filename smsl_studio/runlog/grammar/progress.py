"""What an event that was possible changes in what the automaton remembers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from smsl_studio.runlog import events as run
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.grammar.memory import Asked, Begun, Memory, parts
from smsl_studio.runlog.grammar.regulation import LATCHED

QUIET = (run.FactChanged, run.CostsChanged, run.GoalReached)
"""What is told between the tick before a look at the goals and their arrival."""


def follow(said: Memory, event: Event) -> None:
    """Remember an event, before the fold has taken it."""
    if said.owed == event.event:
        said.owed = ""
    if not isinstance(event, QUIET):
        said.busy = event.t
    if not isinstance(event, run.StateChecked):
        said.checked = {}
    change = _CHANGES.get(type(event))
    if change is not None:
        change(said, event)


def _run_started(said: Memory, event: run.RunStarted) -> None:
    said.unchecked = dict(event.start)
    named = ((goal, parts(goal)) for goal in event.goals)
    said.goal_of = {branch: (goal, state) for goal, (branch, state) in named}
    _stand(said, event.start)
    _moved(said, event.start)


def _stand(said: Memory, configuration: Mapping[str, str]) -> None:
    for branch, state in configuration.items():
        said.evidence.stand(branch, state)


def _fact_changed(said: Memory, event: run.FactChanged) -> None:
    branch = event.branch
    said.evidence.tell(branch, event.digit, event.value)
    if branch in said.fold.configuration:
        said.evidence.stand(branch, said.fold.configuration[branch])


def _state_checked(said: Memory, event: run.StateChecked) -> None:
    branch, state = parts(event.address)
    if event.result == "true":
        said.evidence.learn(branch, state)
    if said.unchecked:
        del said.unchecked[branch]
    elif event.result == "true":
        said.checked[branch] = said.pending[branch] = state
        newest = said.newest.get(branch)
        if newest is not None:
            newest.done |= newest.target == state
    else:
        said.failing = said.blames = True


def _operation_started(said: Memory, event: run.OperationStarted) -> None:
    branch, source, _ = parts(event.address)
    one = Begun(branch, source, event.target, event.function, since=event.t)
    said.rests = False
    said.chosen |= said.asked == event.address
    said.begun[event.address] = said.newest[branch] = one
    said.acting = said.stepped = True
    said.asked = ""


def _operation_ended(said: Memory, event: run.OperationEnded) -> None:
    said.begun[event.address].outcome = event.outcome
    said.acting = False
    said.failing = event.outcome != "returned"
    one = said.begun[event.address]
    said.blames = event.outcome in ("failed", "raised") and not one.person


def _committed(said: Memory, event: run.Committed) -> None:
    for address in event.operations:
        one = said.begun.pop(address)
        if said.newest.get(one.branch) is one:
            del said.newest[one.branch]
    said.committed = event.t
    for branch, state in event.configuration.items():
        if said.pending.get(branch) == state:
            del said.pending[branch]
    _moved(said, event.configuration)
    _stand(said, event.configuration)


def _moved(said: Memory, configuration: Mapping[str, str]) -> None:
    """SBs stand elsewhere: which of them have left a goal that was told."""
    for branch, now in configuration.items():
        goal, state = said.goal_of.get(branch, ("", ""))
        (said.standing.add if now == state else said.standing.discard)(branch)
        if goal in said.reached:
            (said.away.discard if now == state else said.away.add)(branch)


def _relocalised(said: Memory, event: run.Relocalised) -> None:
    _moved(said, event.configuration)
    _stand(said, event.configuration)
    said.end_step()


def _ends_step(said: Memory, event: Event) -> None:
    said.end_step()


def _held(said: Memory, event: run.Held) -> None:
    again = said.fold.held is not None and not said.let_go
    risky = isinstance(said.last, run.OperationRisky)
    said.doomed = said.acting or said.fold.phase in LATCHED or again or risky
    said.let_go = False
    said.end_step()


def _latched(said: Memory, event: Event) -> None:
    said.end_step()
    said.asked = ""


def _paused(said: Memory, event: run.Paused) -> None:
    said.rests |= said.committed == event.t and not said.begun
    said.committed = None
    said.wanted_pause = False


def _risky(said: Memory, event: run.OperationRisky) -> None:
    said.blames = False


def _route_planned(said: Memory, event: Event) -> None:
    said.stepped = said.chosen = said.rests = False
    said.asked = ""


def _goal_reached(said: Memory, event: run.GoalReached) -> None:
    said.reached[event.goal] = None
    said.stepped = False


def _commanded(said: Memory, event: run.Commanded) -> None:
    said.cause = event
    if event.refused:
        return
    said.owed = said.commands[event.command].owes
    said.let_go = True
    said.wanted_pause |= event.command in ("pause", "step")
    if event.command == "ask" and said.fold.phase != "running":
        said.asked, said.rests = event.address, False


def _pruned(said: Memory, event: run.OperationPruned) -> None:
    said.shut.add(event.address)


def _restored(said: Memory, event: run.OperationRestored) -> None:
    said.shut.discard(event.address)


def _task_opened(said: Memory, event: run.TaskOpened) -> None:
    said.tasks[event.task] = Asked(event)
    said.names.add(event.task)
    if event.kind == "operation" and event.address in said.begun:
        said.begun[event.address].person = True


def _task_escalated(said: Memory, event: run.TaskEscalated) -> None:
    said.tasks[event.task].escalated = True


def _task_answered(said: Memory, event: run.TaskAnswered) -> None:
    if not event.refused:
        said.tasks[event.task].answered[event.by] = None


def _task_closed(said: Memory, event: run.TaskClosed) -> None:
    asked = said.tasks.pop(event.task)
    said.let_go = True
    said.declined |= asked.opened.kind == "start" and event.outcome == "answered"


_CHANGES: Mapping[type[Event], Callable[[Memory, Any], None]] = MappingProxyType(
    {
        run.RunStarted: _run_started,
        run.StateChecked: _state_checked,
        run.OperationStarted: _operation_started,
        run.OperationEnded: _operation_ended,
        run.Committed: _committed,
        run.Relocalised: _relocalised,
        run.Mismatch: _ends_step,
        run.Held: _held,
        run.Paused: _paused,
        run.OperationRisky: _risky,
        run.RunStopped: _latched,
        run.TakenOver: _latched,
        run.FactChanged: _fact_changed,
        run.RoutePlanned: _route_planned,
        run.GoalReached: _goal_reached,
        run.Commanded: _commanded,
        run.OperationPruned: _pruned,
        run.OperationRestored: _restored,
        run.TaskOpened: _task_opened,
        run.TaskEscalated: _task_escalated,
        run.TaskAnswered: _task_answered,
        run.TaskClosed: _task_closed,
    }
)
