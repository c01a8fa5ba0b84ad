"""The table of commands: all commands to a run, one row each.

Scripts, the window, accounts, the page ``docs/supervision.md`` and the tests read these rows. A new
command needs a row here and its effect. A command waits for the next tick, where one event answers
it. ``by`` is the name of the person who gives it, for the record.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from types import MappingProxyType

from smsl_studio.dispatch.supervision import latches, pace, terms, trials
from smsl_studio.dispatch.supervision.row import (
    AMOUNT,
    DISTURBANCE,
    EDGE,
    FAULT,
    PAUSE,
    SENSED,
    STEP,
    STOP,
    SWITCH,
    TAKE_OVER,
    TASK,
    TERMS,
    TEXT,
    Argument,
    Command,
    CommandMethod,
    CommandRow,
)

OPEN = ("ready", "running", "paused", "waiting", "no_route", "taken_over", "fault_hold", "stopped")
"""The run states in which commands are taken."""

_STOPPED = "the run is stopped, reset it first"
_TAKEN = "{by} has taken over, automation is locked out until it is given back"
_ASKED = "people are being asked, it goes on when they have answered"
_HOLDS = "the run holds already"
_NOT_TAKEN = "nobody has taken over"
_LOCKED = {"taken_over": _TAKEN, "stopped": _STOPPED}
_HELD = ("no_route", "fault_hold")
_EDGE = {"address": Argument(EDGE)}


def _all_but(words: str, *phases: str) -> Mapping[str, str]:
    return {phase: words for phase in OPEN if phase not in phases}


class Commands:
    """All commands to a run. Every row is a method, with the parameters of its effect.

    ``docs/supervision.md`` says what each command does in each run state.
    """

    @abstractmethod
    def take(self, command: Command) -> None:
        """Keep a command for the next tick."""

    # pace ---------------------------------------------------------------------------------------

    ask = CommandMethod(
        "ask",
        pace.ask,
        arguments=_EDGE,
        refused={**_LOCKED, "waiting": _ASKED},
        useless=("running", "middle"),
        sets_going=True,
        supervisors=True,
        sentence="Asked for {address}",
        explains=("operation_refused",),
        label="Carry out",
        verb="Carry out {name}",
        question="Carry out {name} now?",
        offer="Try {address} again. It failed: {why}.",
    )
    pause = CommandMethod(
        "pause",
        pace.pause,
        rank=PAUSE,
        refused={**_LOCKED, "paused": "it is paused already", "no_route": _HOLDS,
                 "fault_hold": _HOLDS},
        holds_back=True,
        stands=True,
        supervisors=True,
        sentence="Asked for a pause",
        explains=("paused",),
        label="Pause",
        key="F6",
        icon="pause",
    )  # fmt: skip
    resume = CommandMethod(
        "resume",
        pace.resume,
        refused={**_LOCKED, "running": "it runs already", "waiting": _ASKED},
        sets_going=True,
        sentence="Let the run go on",
        owes="resumed",
        explains=("resumed",),
        label="Resume",
        key="F5",
        icon="play",
        offer="Read the scene again and go on from there.",
        offered=_HELD,
    )
    step = CommandMethod(
        "step",
        pace.step,
        rank=STEP,
        refused={**_LOCKED, "waiting": _ASKED},
        useless=("middle",),
        sets_going=True,
        holds_back=True,
        sentence="Asked for one operation",
        explains=("paused",),
        label="Step",
        key="F10",
        icon="step",
    )
    set_automatic = CommandMethod(
        "set_automatic",
        pace.set_automatic,
        arguments={"automatic": Argument(SWITCH)},
        script_words={"by_hand": {"automatic": False}, "automatic": {"automatic": True}},
        value="{automatic}",
        refused=_LOCKED,
        sets_going=True,
        sentences={
            "on": "Let the run follow its route by itself",
            "off": "Took the run by hand",
        },
    )

    # about edges --------------------------------------------------------------------------------

    veto = CommandMethod(
        "veto",
        terms.veto,
        arguments={"address": Argument(EDGE, needed=False),
                   "reason": Argument(TEXT, needed=False, scripted=False)},
        about=terms.next_edge,
        rank=TERMS,
        refused=_LOCKED,
        useless=("middle", "no_route"),
        supervisors=True,
        sentence="Vetoed {address}",
        label="Veto once",
        key="V",
        icon="close",
        tip="Have the operation that is next, or chosen, skipped once",
        verb="Veto {name}",
        question="Veto {name} once?",
        consequence="It is skipped once, and another route is looked for.",
    )  # fmt: skip
    prune = CommandMethod(
        "prune",
        terms.prune,
        arguments={**_EDGE, "reason": Argument(TEXT)},
        rank=TERMS,
        supervisors=True,
        sentence="Shut {address} out",
        owes="operation_pruned",
        explains=("operation_pruned",),
        label="Prune…",
        key="P",
        icon="scissors",
        tip="Shut an operation out until it is restored, with a reason",
        verb="Prune {name}",
        consequence="It stays shut out until it is restored. Why?",
    )
    restore = CommandMethod(
        "restore",
        terms.restore,
        arguments=_EDGE,
        rank=TERMS,
        sentence="Allowed {address} again",
        owes="operation_restored",
        explains=("operation_restored",),
        label="Restore",
        icon="check",
        verb="Restore {name}",
        offer="Let {address} be used again. It is {why}.",
    )
    set_cost = CommandMethod(
        "set_cost",
        terms.set_cost,
        arguments={**_EDGE, "cost": Argument(AMOUNT)},
        value="{cost}",
        rank=TERMS,
        sentence="Priced {address} at {value}",
        explains=("costs_changed",),
    )

    # latches ------------------------------------------------------------------------------------

    take_over = CommandMethod(
        "take_over",
        latches.take_over,
        rank=TAKE_OVER,
        refused={"taken_over": "{by} has taken over already", "stopped": _STOPPED},
        holds_back=True,
        stands=True,
        sentence="Took over",
        owes="taken_over",
        label="Take over",
        key="T",
        icon="hand",
        tip="Lock the automation out, or have it go on from the state that is located",
        consequence="The automation is locked out and only observes, until you give back.",
        offer="Take over, and give back when it stands where it should.",
        offered=_HELD,
    )
    give_back = CommandMethod(
        "give_back",
        latches.give_back,
        refused=_all_but(_NOT_TAKEN, "taken_over"),
        sets_going=True,
        sentence="Gave the run back",
        label="Give back",
        key="T",
        icon="hand",
        consequence="The scene is read. Exactly one state must check true, and you accept it.",
        offer="Ask the scene where the procedure stands.",
        offered=("taken_over",),
    )
    accept = CommandMethod(
        "accept",
        latches.accept,
        refused=_all_but(_NOT_TAKEN, "taken_over"),
        sets_going=True,
        sentence="Accepted where the scene says it stands",
        owes="given_back",
        label="Accept the located state",
        icon="check",
        tip="Go on from the state that was located",
        verb="Accept this state",
        consequence="The run goes on from here, paused. What was interrupted is never resumed.",
        offer="Accept {states}, where every state check is true.",
    )
    adopt = CommandMethod(
        "adopt",
        latches.adopt,
        refused=_all_but("the run does not hold on a mismatch", "fault_hold"),
        sets_going=True,
        sentence="Took the configuration that the scene agrees with",
        owes="relocalised",
        label="Adopt",
        offer="Go on from {states}, which the scene agrees with.",
    )
    stop = CommandMethod(
        "stop",
        latches.stop,
        rank=STOP,
        refused={"stopped": "it is stopped already"},
        holds_back=True,
        stands=True,
        sentence="Stopped the run",
        owes="stopped",
        explains=("run_finished",),
        label="Stop",
        key="F8",
        icon="stop",
        offer="Brake and latch.",
        offered=("taken_over",),
    )
    reset = CommandMethod(
        "reset",
        latches.reset,
        refused=_all_but("the run is not stopped", "stopped"),
        sets_going=True,
        sentence="Unlatched the stop",
        owes="reset",
        label="Reset",
        tip="Unlatch a stop, to paused",
        consequence="It unlatches the stop, to paused; nothing moves until you say so",
        offer="Unlatch the stop. The run is paused then, and Resume reads the scene again.",
        offered=("stopped",),
    )
    end = CommandMethod(
        "end",
        latches.end,
        refused=_all_but(
            "only a run that is stopped or holds can be ended, stop it first",
            "stopped", "no_route", "fault_hold",
        ),
        sentence="Ended the run",
        owes="run_finished",
        explains=("run_finished",),
        label="End run",
        tip="End the run for good; what moves is stopped first",
        consequence="It ends the run for good; its record is closed",
        offer="End the run here.",
        offered=("stopped", *_HELD),
    )  # fmt: skip

    # people, view, trials -----------------------------------------------------------------------

    answer = CommandMethod(
        "answer",
        trials.answer,
        arguments={"option": Argument(TEXT), "kind": Argument(TASK, needed=False),
                   "address": Argument(TEXT, needed=False), "role": Argument(TEXT, needed=False)},
        value="{task}",
        useless=tuple(phase for phase in (*OPEN, "middle") if phase != "waiting"),
        sentence="Answered {value}",
        owes="task_answered",
    )  # fmt: skip
    full_map = CommandMethod(
        "full_map",
        trials.full_map,
        arguments={"on": Argument(SWITCH)},
        value="{on}",
        sentence="Turned the full map {value}",
        label="Show full map, logged",
        icon="map",
        tip="Every state of the State Branch; that it was looked at is recorded",
    )
    disturb = CommandMethod(
        "disturb",
        trials.disturb,
        arguments={"target": Argument(SENSED), "kind": Argument(DISTURBANCE)},
        free=True,
        value="{target} {kind}",
        rank=FAULT,
        sentence="Disturbed sensors: {value}",
        owes="disturbed",
        explains=("disturbed",),
    )
    inject = CommandMethod(
        "inject",
        trials.inject,
        arguments={"fault": Argument(TEXT)},
        free=True,
        value="{fault}",
        rank=FAULT,
        sentence="Had something go wrong: {value}",
        owes="fault_injected",
        explains=("fault_injected",),
    )


COMMANDS: Mapping[str, CommandRow] = MappingProxyType(
    {word: row for word, row in vars(Commands).items() if isinstance(row, CommandRow)}
)
"""All commands by their words, in the order of the table."""
