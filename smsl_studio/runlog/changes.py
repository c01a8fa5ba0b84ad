"""What each event changes in how a run stands: one step of the fold that tells a run again."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.runlog import events as run
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.retold import Entered, Retold, Sensed

Changes = dict[str, Any]


def after(before: Retold, event: Event) -> Retold:
    """How the run stands after one more event."""
    changes = _CHANGES.get(type(event), _nothing)(before, event)
    return replace(before, index=before.index + 1, time=max(before.time, event.t), **changes)


_CLEARED: Mapping[str, Any] = MappingProxyType(
    {"started": (), "own": (), "running": "", "running_since": None}
)
"""Nothing is carried out any more."""


def _nothing(before: Retold, event: Event) -> Changes:
    return {}


def _entered(before: Retold, t: float, states: Mapping[str, str], by: Sequence[str]) -> Changes:
    """SBs came into states, by these operations."""
    how = {Address.split(text)[0]: text for text in by}
    came = {branch: Entered(t, how.get(branch, "")) for branch in states}
    return {
        "configuration": {**before.configuration, **states},
        "entered": {**before.entered, **came},
    }


def _run_started(before: Retold, event: run.RunStarted) -> Changes:
    return {
        **_entered(before, event.t, event.start, ()),
        "goals": event.goals,
        "begun": True,
    }


def _operation_started(before: Retold, event: run.OperationStarted) -> Changes:
    route = before.route[1:] if before.route[:1] == (event.address,) else before.route
    return {
        "started": (*before.started, event.address),
        "own": (*before.own, event.address) if event.function else before.own,
        "running": event.address,
        "running_since": event.t,
        "route": route,
        "held": None,
        "check": None,
    }


def _operation_ended(before: Retold, event: run.OperationEnded) -> Changes:
    return {"own": tuple(one for one in before.own if one != event.address)}


def _state_checked(before: Retold, event: run.StateChecked) -> Changes:
    return {"check": event, **_next(before.own, event.t)}


def _next(own: Sequence[str], t: float) -> Changes:
    """A base's function runs when its subs have moved, which no event of its own tells."""
    return (
        {"running": own[-1], "running_since": t} if own else {"running": "", "running_since": None}
    )


def _committed(before: Retold, event: run.Committed) -> Changes:
    left = tuple(one for one in before.started if one not in event.operations)
    return {
        **_entered(before, event.t, event.configuration, event.operations),
        **({"started": left, **_next(before.own, event.t)} if left else _CLEARED),
        "operations": before.operations + len(event.operations),
        "once": before.once and bool(left),
    }


def _relocalised(before: Retold, event: run.Relocalised) -> Changes:
    moved = {b: s for b, s in event.configuration.items() if before.configuration.get(b) != s}
    return {
        **_entered(before, event.t, moved, ()),
        **_CLEARED,
        "held": None,
        "candidates": (),
        "once": before.once and not before.started,
    }


def _mismatch(before: Retold, event: run.Mismatch) -> Changes:
    return {**_CLEARED, "candidates": event.candidates}


def _held(before: Retold, event: run.Held) -> Changes:
    return {**_CLEARED, "held": event, "once": False, "paused": False}


def _fact_changed(before: Retold, event: run.FactChanged) -> Changes:
    sensed = Sensed(event.value, event.reason, event.t)
    return {"facts": {**before.facts, (event.branch, event.digit): sensed}}


def _restored(before: Retold, event: run.OperationRestored) -> Changes:
    return {
        "pruned": _without(before.pruned, event.address),
        "risky": _without(before.risky, event.address),
    }


def _commanded(before: Retold, event: run.Commanded) -> Changes:
    """What commands do that nothing else tells of."""
    if event.refused:
        return {}
    match event.command:
        case "step":
            return {"once": True, "paused": False, "frozen": False}
        case "ask":
            return {"paused": before.paused or (before.held is not None and not before.by_hand)}
        case "set_automatic":
            return {"by_hand": event.value == "off"}
        case "resume" if before.phase == "ready":
            return {"by_hand": False}
        case "full_map":
            return {"full_map": event.value == "on"}
        case _:
            return {}


_LATCHED: Mapping[str, Any] = MappingProxyType(
    {**_CLEARED, "held": None, "paused": False, "frozen": False, "once": False, "tasks": {}}
)


def _reset(before: Retold, event: run.RunReset) -> Changes:
    return {"stopped": "", "paused": True}


def _task_closed(before: Retold, event: run.TaskClosed) -> Changes:
    return {"tasks": {name: task for name, task in before.tasks.items() if name != event.task}}


def _disturbed(before: Retold, event: run.Disturbed) -> Changes:
    if event.kind == "none":
        return {"disturbed": _without(before.disturbed, event.target)}
    return {"disturbed": {**before.disturbed, event.target: event.kind}}


def _without(values: Mapping[str, str], name: str) -> Mapping[str, str]:
    return {key: value for key, value in values.items() if key != name}


_CHANGES: Mapping[type[Event], Callable[[Retold, Any], Changes]] = MappingProxyType(
    {
        run.RunStarted: _run_started,
        run.RoutePlanned: lambda before, event: {"route": event.operations},
        run.OperationStarted: _operation_started,
        run.OperationEnded: _operation_ended,
        run.StateChecked: _state_checked,
        run.Committed: _committed,
        run.Relocalised: _relocalised,
        run.Mismatch: _mismatch,
        run.Held: _held,
        run.FactChanged: _fact_changed,
        run.OperationRisky: lambda before, event: {
            **_CLEARED,
            "risky": {**before.risky, event.address: event.reason},
        },
        run.OperationPruned: lambda before, event: {
            "pruned": {**before.pruned, event.address: event.reason}
        },
        run.OperationRestored: _restored,
        run.Paused: lambda before, event: {
            "paused": True,
            "once": False,
            "frozen": bool(before.started or before.tasks),
        },
        run.Resumed: lambda before, event: {
            "paused": False,
            "frozen": False,
            "once": False,
            "held": None,
        },
        run.Commanded: _commanded,
        run.RunStopped: lambda before, event: {
            **_LATCHED,
            "stopped": event.by,
            "taken_over": "",
        },
        run.RunReset: _reset,
        run.TakenOver: lambda before, event: {**_LATCHED, "taken_over": event.by},
        run.GivenBack: lambda before, event: {"taken_over": "", "paused": not before.by_hand},
        run.TaskOpened: lambda before, event: {"tasks": {**before.tasks, event.task: event}},
        run.TaskClosed: _task_closed,
        run.Disturbed: _disturbed,
        run.FaultInjected: lambda before, event: {"faults": (*before.faults, event.fault)},
        run.RunFinished: lambda before, event: {**_CLEARED, "finished": event},
    }
)
