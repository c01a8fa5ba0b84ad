"""What each event changes in the state of a run: one step of the fold."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.runlog import events as run
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.fold import RunFold
from smsl_studio.runlog.moment import Entered, RunMoment, Sensed


def take(fold: RunFold, event: Event) -> None:
    """Apply one more event to the state of the run."""
    fold.index += 1
    fold.time = max(fold.time, event.t)
    change = _CHANGES.get(type(event))
    if change is not None:
        change(fold, event)


def after(before: RunMoment, event: Event) -> RunMoment:
    """The state of the run after one more event."""
    fold = RunFold.of(before)
    take(fold, event)
    return fold.moment()


def moment_after(events: Iterable[Event]) -> RunMoment:
    """Return the state of a run after its first events."""
    fold = RunFold()
    for event in events:
        take(fold, event)
    return fold.moment()


def _clear(fold: RunFold, t: float, good: bool = False) -> None:
    """Clear the operations that are being carried out. ``good`` says that they ended as they
    should.
    """
    if fold.history is not None:
        fold.history.end_all(fold.index, t, good)
    fold.started, fold.own, fold.stack = {}, {}, []
    fold.running, fold.running_since = "", None


def _enter(fold: RunFold, t: float, states: Mapping[str, str], by: Iterable[str]) -> None:
    """Set the new states of SBs, and the operations that led there."""
    how = {Address.split(text)[0]: text for text in by}
    fold.configuration.update(states)
    for branch in states:
        fold.entered[branch] = Entered(t, how.get(branch, ""))
    if fold.history is not None:
        fold.history.enter(fold.index, t, states)


def _run_started(fold: RunFold, event: run.RunStarted) -> None:
    _enter(fold, event.t, event.start, ())
    fold.world, fold.goals, fold.begun = event.world, event.goals, True


def _route_planned(fold: RunFold, event: run.RoutePlanned) -> None:
    fold.planned, fold.passed = event.operations, 0


def _operation_started(fold: RunFold, event: run.OperationStarted) -> None:
    if fold.planned[fold.passed : fold.passed + 1] == (event.address,):
        fold.passed += 1
    fold.started[event.address] = None
    if event.function:
        fold.own[event.address] = None
        fold.stack.append(event.address)
    fold.running, fold.running_since = event.address, event.t
    fold.held = None
    if fold.history is not None:
        fold.history.begin(fold.index, event.t, event.address, event.function)


def _operation_ended(fold: RunFold, event: run.OperationEnded) -> None:
    fold.own.pop(event.address, None)
    if fold.history is not None and event.outcome != "returned":
        fold.history.end(fold.index, event.t, event.address, good=False)


def _state_checked(fold: RunFold, event: run.StateChecked) -> None:
    _next(fold, event.t)


def _next(fold: RunFold, t: float) -> None:
    """Set the function that runs now: that of the newest operation whose function has not ended.
    The function of a base goes on without an event after its sub-SBs have moved.
    """
    while fold.stack and fold.stack[-1] not in fold.own:
        fold.stack.pop()
    fold.running = fold.stack[-1] if fold.stack else ""
    fold.running_since = t if fold.running else None


def _committed(fold: RunFold, event: run.Committed) -> None:
    if fold.history is not None:
        fold.history.commit(fold.index, event.t, event.operations)
    _enter(fold, event.t, event.configuration, event.operations)
    for address in event.operations:
        fold.started.pop(address, None)
    if fold.started:
        _next(fold, event.t)
    else:
        _clear(fold, event.t)
        fold.once = False
    fold.operations += len(event.operations)


def _relocalised(fold: RunFold, event: run.Relocalised) -> None:
    here = fold.configuration
    _enter(fold, event.t, {b: s for b, s in event.configuration.items() if here.get(b) != s}, ())
    _fail(fold, event.t)
    fold.held, fold.candidates = None, ()


def _fail(fold: RunFold, t: float) -> None:
    """End what is being carried out. If it was a single operation, the wish for it is done."""
    fold.once = fold.once and not fold.started
    _clear(fold, t)


def _mismatch(fold: RunFold, event: run.Mismatch) -> None:
    _fail(fold, event.t)
    fold.candidates = event.candidates


def _held(fold: RunFold, event: run.Held) -> None:
    _clear(fold, event.t)
    fold.held, fold.once, fold.paused = event, False, False


def _fact_changed(fold: RunFold, event: run.FactChanged) -> None:
    key = event.branch, event.digit
    fold.facts[key] = Sensed(event.value, event.reason, event.t)
    if fold.history is not None:
        fold.history.sense(event.t, key, event.value)


def _measured(fold: RunFold, event: run.Measured) -> None:
    if fold.history is not None:
        source = (event.branch, event.digit), event.source
        good = event.quality == "good"
        reason = event.reason or ("" if good else f"its reading is {event.quality}")
        fold.history.measure(event.t, source, event.value if good else None, reason)


def _risky(fold: RunFold, event: run.OperationRisky) -> None:
    _fail(fold, event.t)
    fold.risky[event.address] = event.reason


def _pruned(fold: RunFold, event: run.OperationPruned) -> None:
    fold.pruned[event.address] = event.reason


def _restored(fold: RunFold, event: run.OperationRestored) -> None:
    fold.pruned.pop(event.address, None)
    fold.risky.pop(event.address, None)


def _commanded(fold: RunFold, event: run.Commanded) -> None:
    """Apply the effects of commands that no other event tells."""
    if event.refused:
        return
    match event.command:
        case "step":
            fold.once, fold.paused, fold.frozen = True, False, False
        case "ask":
            # A question that a pause has frozen is no longer what the run waits for.
            fold.frozen = False
            fold.paused = fold.paused or (fold.held is not None and not fold.by_hand)
        case "set_automatic":
            fold.by_hand = event.value == "off"
        case "resume" if fold.phase == "ready":
            fold.by_hand = False
        case "full_map":
            fold.full_map = event.value == "on"


def _paused(fold: RunFold, event: run.Paused) -> None:
    fold.paused, fold.once = True, False
    fold.frozen = bool(fold.started or fold.tasks)


def _resumed(fold: RunFold, event: run.Resumed) -> None:
    fold.paused = fold.frozen = fold.once = False
    fold.held = None


def _latch(fold: RunFold, t: float) -> None:
    """Clear what was being carried out and what was asked for, because neither goes on by
    itself.
    """
    _clear(fold, t)
    fold.held, fold.paused, fold.frozen, fold.once = None, False, False, False
    fold.tasks = {}


def _stopped(fold: RunFold, event: run.RunStopped) -> None:
    _latch(fold, event.t)
    fold.stopped, fold.taken_over = event.by, ""


def _reset(fold: RunFold, event: run.RunReset) -> None:
    fold.stopped, fold.paused = "", True


def _taken_over(fold: RunFold, event: run.TakenOver) -> None:
    _latch(fold, event.t)
    fold.taken_over = event.by


def _given_back(fold: RunFold, event: run.GivenBack) -> None:
    fold.taken_over, fold.paused = "", not fold.by_hand


def _task_opened(fold: RunFold, event: run.TaskOpened) -> None:
    fold.tasks[event.task] = fold.asked[event.task] = event


def _task_closed(fold: RunFold, event: run.TaskClosed) -> None:
    fold.tasks.pop(event.task, None)


def _disturbed(fold: RunFold, event: run.Disturbed) -> None:
    for sensor in event.sensors:
        kinds = fold.disturbed.get(sensor, ())
        if event.kind == "none":
            fold.disturbed.pop(sensor, None)
        elif event.kind not in kinds:
            fold.disturbed[sensor] = (*kinds, event.kind)


def _finished(fold: RunFold, event: run.RunFinished) -> None:
    _clear(fold, event.t, good=event.reason == "goal_reached")
    fold.finished = event


_CHANGES: Mapping[type[Event], Callable[[RunFold, Any], None]] = MappingProxyType(
    {
        run.RunStarted: _run_started,
        run.RoutePlanned: _route_planned,
        run.OperationStarted: _operation_started,
        run.OperationEnded: _operation_ended,
        run.StateChecked: _state_checked,
        run.Committed: _committed,
        run.Relocalised: _relocalised,
        run.Mismatch: _mismatch,
        run.Held: _held,
        run.FactChanged: _fact_changed,
        run.Measured: _measured,
        run.OperationRisky: _risky,
        run.OperationPruned: _pruned,
        run.OperationRestored: _restored,
        run.Paused: _paused,
        run.Resumed: _resumed,
        run.Commanded: _commanded,
        run.RunStopped: _stopped,
        run.RunReset: _reset,
        run.TakenOver: _taken_over,
        run.GivenBack: _given_back,
        run.TaskOpened: _task_opened,
        run.TaskClosed: _task_closed,
        run.Disturbed: _disturbed,
        run.RunFinished: _finished,
    }
)
