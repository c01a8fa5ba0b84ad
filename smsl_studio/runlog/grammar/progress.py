"""The changes of the automaton's state after a possible event."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from smsl_studio.runlog import events as run
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.grammar.memory import Asked, Begun, Memory, parts
from smsl_studio.runlog.grammar.regulation import LATCHED

QUIET = (run.FactChanged, run.CostsChanged, run.GoalReached)
"""The events that may come between the last change and the arrival at the goals."""


def follow(memory: Memory, event: Event) -> None:
    """Take an event into the memory, before the fold takes it."""
    if memory.owed == event.event:
        memory.owed = ""
    if not isinstance(event, QUIET):
        memory.busy = event.t
    if not isinstance(event, run.StateChecked):
        memory.checked = {}
    change = _CHANGES.get(type(event))
    if change is not None:
        change(memory, event)


def _run_started(memory: Memory, event: run.RunStarted) -> None:
    memory.unchecked = dict(event.start)
    named = ((goal, parts(goal)) for goal in event.goals)
    memory.goal_of = {branch: (goal, state) for goal, (branch, state) in named}
    _stand(memory, event.start)
    _moved(memory, event.start)


def _stand(memory: Memory, configuration: Mapping[str, str]) -> None:
    for branch, state in configuration.items():
        memory.evidence.stand(branch, state)


def _fact_changed(memory: Memory, event: run.FactChanged) -> None:
    branch = event.branch
    memory.evidence.tell(branch, event.digit, event.value)
    if branch in memory.fold.configuration:
        memory.evidence.stand(branch, memory.fold.configuration[branch])


def _state_checked(memory: Memory, event: run.StateChecked) -> None:
    branch, state = parts(event.address)
    if event.result == "true":
        memory.evidence.learn(branch, state)
    if memory.unchecked:
        del memory.unchecked[branch]
    elif event.result == "true":
        memory.checked[branch] = memory.pending[branch] = state
        newest = memory.newest.get(branch)
        if newest is not None:
            newest.done |= newest.target == state
        memory.unproved.pop(branch, None)
        memory.proved.add(branch)
        _owe_bases(memory, branch)
    else:
        memory.failing = memory.blames = True


def _owe_bases(memory: Memory, sub: str) -> None:
    """Remember the bases whose operations end with this crossing of a sub-SB.

    Such an operation runs no function and changes only digits that sub-SBs expand. The target
    states of these operations are checked next.
    """
    expansion = memory.expansion
    for base in expansion.bases_of(sub):
        one = memory.newest.get(base)
        if one is None or one.done or one.is_carried:
            continue
        if not memory.evidence.are_alike(base, one.source, one.target):
            continue
        if not any(expansion.apart(base, one.target, memory.stands)):
            memory.unproved[base] = one.target


def _operation_started(memory: Memory, event: run.OperationStarted) -> None:
    branch, source, _ = parts(event.address)
    known = memory.known.function(*parts(event.address))
    one = Begun(branch, source, event.target, event.function, must_end=bool(known), since=event.t)
    if event.address in memory.begun:
        one.times += memory.begun[event.address].times
    memory.rests = False
    memory.chosen |= memory.asked == event.address
    memory.begun[event.address] = memory.newest[branch] = one
    memory.acting = memory.stepped = True
    memory.asked = ""


def _operation_ended(memory: Memory, event: run.OperationEnded) -> None:
    memory.begun[event.address].outcome = event.outcome
    memory.acting = False
    memory.failing = event.outcome != "returned"
    one = memory.begun[event.address]
    memory.blames = event.outcome in ("failed", "raised") and not one.person
    memory.ended, memory.proved = event, set()
    memory.unproved = {one.branch: one.target} if event.outcome == "returned" else {}


def _committed(memory: Memory, event: run.Committed) -> None:
    for address in dict.fromkeys(event.operations):
        one = memory.begun.pop(address)
        if memory.newest.get(one.branch) is one:
            del memory.newest[one.branch]
    memory.committed, memory.proved = event.t, set()
    if not memory.begun and all(map(memory.expansion.is_alone, event.configuration)):
        # The step is complete. So nobody has asked for the next step yet.
        memory.chosen, memory.committed = False, None
    for branch, state in event.configuration.items():
        if memory.pending.get(branch) == state:
            del memory.pending[branch]
    _moved(memory, event.configuration)
    _stand(memory, event.configuration)


def _moved(memory: Memory, configuration: Mapping[str, str]) -> None:
    """Note which SBs are at their goals now, and which have left a goal that was told."""
    for branch, now in configuration.items():
        goal, state = memory.goal_of.get(branch, ("", ""))
        (memory.standing.add if now == state else memory.standing.discard)(branch)
        if goal in memory.reached:
            (memory.away.discard if now == state else memory.away.add)(branch)


def _relocalised(memory: Memory, event: run.Relocalised) -> None:
    memory.risk = None
    _moved(memory, event.configuration)
    _stand(memory, event.configuration)
    memory.end_step()


def _ends_step(memory: Memory, event: Event) -> None:
    memory.end_step()


def _held(memory: Memory, event: run.Held) -> None:
    endangered = event.kind == "hazard" and memory.endangered
    again = memory.fold.held is not None and not memory.let_go and not endangered
    risky = isinstance(memory.last, run.OperationRisky)
    # A hazard holds a run that somebody has taken over, too.
    latched = memory.fold.phase in LATCHED and not (endangered and memory.fold.taken_over)
    memory.doomed = memory.acting or latched or again or risky
    memory.let_go = memory.endangered = False
    memory.risk = None
    memory.end_step()


def _hazard_met(memory: Memory, event: run.HazardMet) -> None:
    memory.endangered = True


def _latched(memory: Memory, event: Event) -> None:
    memory.end_step()
    memory.asked = ""


def _paused(memory: Memory, event: run.Paused) -> None:
    memory.rests |= memory.committed == event.t and not memory.begun
    memory.committed = None
    memory.wanted_pause = False


def _risky(memory: Memory, event: run.OperationRisky) -> None:
    memory.blames, memory.risk = False, event


def _route_planned(memory: Memory, event: Event) -> None:
    memory.stepped = memory.chosen = memory.rests = False
    memory.asked = ""


def _goal_reached(memory: Memory, event: run.GoalReached) -> None:
    memory.reached[event.goal] = None
    memory.stepped = False


def _commanded(memory: Memory, event: run.Commanded) -> None:
    memory.cause = event
    if event.refused:
        return
    memory.owed = memory.commands[event.command].owes
    memory.let_go = True
    memory.wanted_pause |= event.command in ("pause", "step")
    if event.command == "ask" and memory.fold.phase != "running":
        memory.asked, memory.rests = event.address, False


def _costs_changed(memory: Memory, event: run.CostsChanged) -> None:
    memory.known.reprice(event.costs)
    for address, reason in event.closed.items():
        (memory.guarded.add if reason else memory.guarded.discard)(address)


def _pruned(memory: Memory, event: run.OperationPruned) -> None:
    memory.shut.add(event.address)


def _restored(memory: Memory, event: run.OperationRestored) -> None:
    memory.shut.discard(event.address)


def _task_opened(memory: Memory, event: run.TaskOpened) -> None:
    memory.tasks[event.task] = Asked(event)
    memory.names.add(event.task)
    if event.kind == "operation" and event.address in memory.begun:
        memory.begun[event.address].person = True


def _task_escalated(memory: Memory, event: run.TaskEscalated) -> None:
    memory.tasks[event.task].escalated = True


def _task_answered(memory: Memory, event: run.TaskAnswered) -> None:
    if not event.refused:
        memory.tasks[event.task].answered[event.by] = None


def _task_closed(memory: Memory, event: run.TaskClosed) -> None:
    asked = memory.tasks.pop(event.task)
    memory.let_go = True
    memory.declined |= asked.opened.kind == "start" and event.outcome == "answered"
    memory.allowed = (asked.opened.address if asked.opened.kind == "generate" else "", event.t)


def _edge_generated(memory: Memory, event: run.EdgeGenerated) -> None:
    branch, state, operation = parts(event.address)
    memory.known.make((branch, state, operation), event.function)


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
        run.HazardMet: _hazard_met,
        run.Paused: _paused,
        run.OperationRisky: _risky,
        run.RunStopped: _latched,
        run.TakenOver: _latched,
        run.FactChanged: _fact_changed,
        run.RoutePlanned: _route_planned,
        run.GoalReached: _goal_reached,
        run.Commanded: _commanded,
        run.CostsChanged: _costs_changed,
        run.OperationPruned: _pruned,
        run.OperationRestored: _restored,
        run.TaskOpened: _task_opened,
        run.TaskEscalated: _task_escalated,
        run.TaskAnswered: _task_answered,
        run.TaskClosed: _task_closed,
        run.EdgeGenerated: _edge_generated,
    }
)
