"""The automaton: whether an event may follow the events before it in a log, and if not, why.

``TABLE`` has a row for each event: in which part of a log it may stand, and the rule that says what
is wrong with it. ``_always`` has the rules for all events. The blueprint is not read, so only the
order of events is judged, and whether they agree with each other and with the header.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.runlog import events as run
from smsl_studio.runlog.changes import take
from smsl_studio.runlog.command_word import CommandWords
from smsl_studio.runlog.decoder import event_of
from smsl_studio.runlog.events import PROCEDURE, Event
from smsl_studio.runlog.grammar import bounds, generation, operations, regulation, scene
from smsl_studio.runlog.grammar.header import misshapen
from smsl_studio.runlog.grammar.memory import Memory
from smsl_studio.runlog.grammar.progress import follow

Json = Any
NO_END = "the log ends, and the run that it tells of does not"


class EventRow(NamedTuple):
    """Where an event may stand, and its rule.

    ``wrong`` yields a sentence for each fault of the event. ``before`` says that it may also stand
    before ``run_started``, while people are asked about the start. ``starting`` says that it may
    stand between ``run_started`` and the last state check of the start.
    """

    wrong: Callable[[Memory, Any], Iterator[str]]
    before: bool = True
    starting: bool = False


def _judged_below(memory: Memory, event: run.Within) -> Iterator[str]:
    """Yield nothing: ``Grammar`` judges what an operation runs, with a grammar of its own."""
    yield from ()


TABLE: Mapping[type[Event], EventRow] = MappingProxyType(
    {
        run.RunStarted: EventRow(bounds.run_started),
        run.LeftOut: EventRow(bounds.left_out, before=False, starting=True),
        run.FactChanged: EventRow(scene.fact_changed, starting=True),
        run.Measured: EventRow(scene.measured, starting=True),
        run.StateChecked: EventRow(operations.state_checked, before=False, starting=True),
        run.RoutePlanned: EventRow(operations.route_planned, before=False),
        run.SubsBypassed: EventRow(operations.subs_bypassed, before=False),
        run.OperationStarted: EventRow(operations.operation_started, before=False),
        run.OperationEnded: EventRow(operations.operation_ended, before=False),
        run.Committed: EventRow(operations.committed, before=False),
        run.OperationRefused: EventRow(operations.operation_refused),
        run.OperationRisky: EventRow(operations.operation_risky, before=False),
        run.OperationPruned: EventRow(operations.operation_shut_out),
        run.OperationRestored: EventRow(operations.operation_restored),
        run.CostsChanged: EventRow(operations.costs_changed),
        run.Mismatch: EventRow(scene.mismatch),
        run.Relocalised: EventRow(scene.relocalised),
        run.GoalReached: EventRow(scene.goal_reached, before=False),
        run.HazardMet: EventRow(scene.hazard_met, before=False),
        run.Held: EventRow(scene.held),
        run.RiskEstimated: EventRow(regulation.risk_estimated, before=False),
        run.ForecastTold: EventRow(regulation.forecast, before=False),
        run.EdgeGenerated: EventRow(generation.edge_generated, before=False),
        run.Commanded: EventRow(regulation.commanded),
        run.Paused: EventRow(regulation.paused),
        run.Resumed: EventRow(regulation.resumed),
        run.RunStopped: EventRow(regulation.stopped),
        run.RunReset: EventRow(regulation.reset),
        run.TakenOver: EventRow(regulation.taken_over),
        run.GivenBack: EventRow(regulation.given_back),
        run.Disturbed: EventRow(regulation.disturbed),
        run.FaultInjected: EventRow(regulation.fault_injected),
        run.TaskOpened: EventRow(regulation.task_opened),
        run.TaskEscalated: EventRow(regulation.task_escalated),
        run.TaskAnswered: EventRow(regulation.task_answered),
        run.TaskClosed: EventRow(regulation.task_closed),
        run.Within: EventRow(_judged_below, before=False),
        run.RunFinished: EventRow(bounds.run_finished),
    }
)
"""The rows of all events of a run. Events of a sweep have none."""


class Grammar:
    """Checks the events of one log. ``commands`` are the commands that it may contain.

    ``follow`` takes the next event. After it has rejected one event, it accepts all others, because
    nothing after the first fault can be judged.
    """

    def __init__(self, header: Mapping[str, Json], commands: CommandWords) -> None:
        self._memory = Memory(header, commands)
        self._over = False
        self._below: dict[str, Grammar] = {}
        """The grammar of what each operation runs one level down, by its address."""

    def follow(self, event: Event) -> str:
        """Return why the next event is impossible, as a sentence without its full stop, or the
        empty text if it is possible.
        """
        if self._over:
            return ""
        memory = self._memory
        memory.now = event.t
        if isinstance(event, run.Within):
            why = self._within(event)
            self._over = bool(why)
            take(memory.fold, event)
            return why
        if isinstance(event, run.Measured):
            why = next(_measured(memory, event), "")
            self._over = bool(why)
            take(memory.fold, event)
            return why
        why = next(_wrong(memory, event), "") or self._ended_below(event)
        if why:
            self._over = True
            return why
        follow(memory, event)
        take(memory.fold, event)
        memory.last = event
        return ""

    @property
    def reason(self) -> str:
        """The reason for which the run has ended. Empty if it has not."""
        finished = self._memory.fold.finished
        return "" if finished is None else finished.reason

    def _within(self, event: run.Within) -> str:
        """Return why an event of what an operation runs is impossible."""
        memory, address = self._memory, event.operation
        one = memory.begun.get(address)
        if one is None or one.outcome or not one.function.startswith(PROCEDURE):
            return f"{address} tells of what it runs, but it does not run a blueprint now"
        if event.t < memory.fold.time:
            return f"the time goes back from {memory.fold.time:g} s to {event.t:g} s"
        try:
            told = event_of(json.loads(event.told))
        except (ValueError, TypeError, AttributeError, RecursionError) as error:
            return f"what {address} runs tells no event: {error}"
        if told.t != event.t or told.line() != event.told or isinstance(told, run.Within):
            return f"what {address} runs tells another time or another line than a run writes"
        if address not in self._below:
            self._below[address] = Grammar(_header_below(memory.header, told), memory.commands)
        below = self._below[address]
        why = below.follow(told)
        memory.below_holds = below.holds
        return f"what {address} runs is impossible: {why}" if why else ""

    @property
    def holds(self) -> bool:
        """Whether the run holds."""
        return self._memory.fold.phase == "fault_hold"

    def _ended_below(self, event: Event) -> str:
        """Return why an operation cannot end so, because of what it runs."""
        if not isinstance(event, run.OperationEnded):
            return ""
        one, below = self._memory.begun.get(event.address), self._below.pop(event.address, None)
        if one is None or not one.function.startswith(PROCEDURE) or event.outcome != "returned":
            return ""
        if below is None or below.reason != "goal_reached":
            return f"{event.address} has returned, but what it runs has not reached its goal"
        return ""

    def end(self) -> str:
        """Return why the log cannot end here, or the empty text if it can."""
        return "" if self._over or self._memory.fold.finished is not None else NO_END


def _header_below(header: Mapping[str, Json], told: Event) -> Mapping[str, Json]:
    """Return the header of what an operation runs. Its first event says where it begins."""
    start = told.start if isinstance(told, run.RunStarted) else {}
    return {
        **{key: header[key] for key in ("world", "seed", "on_mismatch") if key in header},
        "start": [str(Address(branch, state)) for branch, state in start.items()],
        "goals": list(told.goals) if isinstance(told, run.RunStarted) else [],
        "by_hand": False,
        "attended": True,
        "avoid": [],
    }


def _wrong(memory: Memory, event: Event) -> Iterator[str]:
    row = TABLE.get(type(event))
    if row is None:
        yield f"a run does not tell of {event.event}"
        return
    yield from _always(memory, event, row)
    yield from row.wrong(memory, event)


def _measured(memory: Memory, event: run.Measured) -> Iterator[str]:
    """Yield the reasons why nothing can be measured here. Measures may stand between any two
    events of the run, and change nothing in what may follow.
    """
    if memory.last is None:
        yield from misshapen(memory.header)
    yield from _in_time(memory, event)
    yield from scene.measured(memory, event)


def _in_time(memory: Memory, event: Event) -> Iterator[str]:
    """Yield the reasons why an event cannot come at its time."""
    fold, word = memory.fold, event.event.replace("_", " ")
    if fold.finished is not None:
        yield f"{word} comes after the end of the run"
    if event.t < fold.time:
        yield f"the time goes back from {fold.time:g} s to {event.t:g} s"
    if event.t > fold.time and _at_once(memory):
        yield f"time passes until {event.t:g} s, but nothing in the run takes time"


def _always(memory: Memory, event: Event, row: EventRow) -> Iterator[str]:
    """Yield the reasons why an event of any kind cannot stand here."""
    fold, last, word = memory.fold, memory.last, event.event.replace("_", " ")
    if last is None:
        yield from misshapen(memory.header)
    yield from _in_time(memory, event)
    if not fold.begun and not row.before:
        yield f"{word} comes before the beginning of the run"
    if memory.unchecked and not row.starting:
        branch, state = next(iter(memory.unchecked.items()))
        yield f"the run goes on before {branch}/{state}, where it begins, was checked"
    if isinstance(last, run.GivenBack) and not isinstance(event, run.Relocalised):
        yield "the run was given back, and is not located"
    if isinstance(last, run.GoalReached) and fold.phase == "paused" and not _arrives(event):
        yield "a paused run reaches a goal and goes on"
    if isinstance(last, run.OperationRisky) and not isinstance(event, _LOOKS):
        yield f"{last.address} is risky, and the scene is not looked at"
    if isinstance(last, run.Mismatch) and not isinstance(event, _SETTLES):
        yield "the scene and the believed facts differ, but the run goes on"
    if memory.doomed and not (isinstance(event, run.RunFinished) and event.reason == "failed"):
        yield "the run holds in the middle of an operation, or while it is latched, and goes on"
    if memory.owed and memory.owed != event.event and _overdue(memory, event):
        assert memory.cause is not None
        yield f"{memory.cause.command.replace('_', ' ')} was carried out, but had no effect"


_LOOKS = (run.OperationRisky, run.FactChanged, run.HazardMet, run.Mismatch, run.Relocalised,
          run.TaskOpened, run.Held)  # fmt: skip
"""The events that may follow a failure."""
_SETTLES = (run.Held, run.Relocalised, run.TaskClosed)
"""The events that may follow a mismatch. Open questions to people are closed first."""


def _at_once(memory: Memory) -> bool:
    """Return whether a run must go on without time passing: it is running, nothing is carried out,
    nobody is asked, and no SB stands at a goal that would be checked.
    """
    fold = memory.fold
    if not fold.begun or memory.unchecked or fold.phase != "running":
        return False
    return not (memory.begun or memory.standing or memory.tasks)


def _arrives(event: Event) -> bool:
    """Return whether an event says that the run reaches a goal, or ends at its goals."""
    return isinstance(event, run.GoalReached | run.RunFinished) and (
        not isinstance(event, run.RunFinished) or event.reason == "goal_reached"
    )


def _overdue(memory: Memory, event: Event) -> bool:
    """Return whether the event that a command must cause can no longer come."""
    assert memory.cause is not None
    if event.t > memory.cause.t or isinstance(event, run.RunFinished):
        return True
    # The end of a run comes after the answers to all other commands of this time.
    ending = memory.owed == run.RunFinished.event
    return isinstance(event, run.Commanded) and not (ending and event.refused)
