"""The command table: what is refused in which run state, and who carries out the rest.

Whatever is not refused here is answered by its function: the empty text where it was done, else
why not.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from smsl_studio.dispatch.supervision import latches, terms, trials
from smsl_studio.dispatch.supervision import pace as moving
from smsl_studio.dispatch.supervision.command import (
    HOLDS_BACK,
    RANKS,
    SETS_GOING,
    STANDS,
    Command,
    in_order,
)
from smsl_studio.errors import HostError
from smsl_studio.runlog.events import Commanded
from smsl_studio.stop import restartable

if TYPE_CHECKING:
    from smsl_studio.dispatch.driver import Driver

DO: Mapping[str, Callable[[Driver, Command], str]] = {
    "ask": moving.ask,
    "pause": moving.pause,
    "resume": moving.resume,
    "step": moving.step,
    "set_automatic": moving.set_automatic,
    "veto": terms.veto,
    "prune": terms.prune,
    "restore": terms.restore,
    "set_cost": terms.set_cost,
    "stop": latches.stop,
    "reset": latches.reset,
    "end": latches.end,
    "take_over": latches.take_over,
    "give_back": latches.give_back,
    "accept": latches.accept,
    "adopt": latches.adopt,
    "answer": trials.answer,
    "disturb": trials.disturb,
    "inject": trials.inject,
    "full_map": trials.full_map,
}

STOPPED = "the run is stopped, reset it first"
TAKEN = "{by} has taken over, automation is locked out until it is given back"
ASKED = "people are being asked, it goes on when they have answered"
HOLDS = "the run holds already"
STOP_FIRST = "only a run that is stopped or holds can be ended, stop it first"
OPEN = ("ready", "running", "paused", "waiting", "no_route", "taken_over", "fault_hold", "stopped")


def _all_but(words: str, *phases: str) -> Mapping[str, str]:
    return {phase: words for phase in OPEN if phase not in phases}


_LOCKED = {"taken_over": TAKEN, "stopped": STOPPED}

REFUSED: Mapping[str, Mapping[str, str]] = {
    "ask": {**_LOCKED, "waiting": ASKED},
    "pause": {**_LOCKED, "paused": "it is paused already", "no_route": HOLDS, "fault_hold": HOLDS},
    "resume": {**_LOCKED, "running": "it runs already", "waiting": ASKED},
    "step": {**_LOCKED, "waiting": ASKED},
    "set_automatic": _LOCKED,
    "veto": _LOCKED,
    "stop": {"stopped": "it is stopped already"},
    "take_over": {"taken_over": "{by} has taken over already", "stopped": STOPPED},
    "reset": _all_but("the run is not stopped", "stopped"),
    "end": {**_all_but(STOP_FIRST, "stopped", "no_route", "fault_hold")},
    "give_back": _all_but("nobody has taken over", "taken_over"),
    "accept": _all_but("nobody has taken over", "taken_over"),
    "adopt": _all_but("the run does not hold on a mismatch", "fault_hold"),
}
"""By command and run state. ``{by}`` is who has taken over."""


def obey(driver: Driver, commands: list[Command]) -> None:
    """Carry out the commands of one tick, which are in order of rank, and take them off the list.

    Each is answered by one event, which stands before its effects. Where the host dies meanwhile,
    all are answered first. Where one is called off (see ``stop``), it is still on the list.
    """
    done: list[str] = []
    gone: HostError | None = None
    while commands:
        command = commands[0]
        events = driver.run.events
        at = len(events)
        try:
            refused = (
                f"the world is gone: {gone.sentence}" if gone else _why_not(driver, command, done)
            )
            if not refused:
                command = meant(driver, command)
                refused = DO[command.word](driver, command)
        except HostError as error:
            gone, refused = error, f"the world is gone: {error.sentence}"
        del commands[0]
        if not refused or command.word in STANDS:
            done.append(command.word)
        events.insert(at, _told(driver, command, refused))
    if gone is not None:
        raise gone


def refuse(driver: Driver, commands: Sequence[Command], reason: str) -> None:
    """Answer commands that nothing can be done about any more."""
    for command in in_order(commands):
        driver.run.emit(_told(driver, command, reason))


def why_refused(word: str, phase: str, by: str) -> str:
    """Why a run state refuses a command, whatever is said with it; ``by`` has taken over."""
    words = REFUSED.get(word, {}).get(phase, "")
    return words.format(by=by[:1].upper() + by[1:])


def _why_not(driver: Driver, command: Command, done: Sequence[str]) -> str:
    if driver.ended is not None:
        return "the run is over"
    words = why_refused(command.word, driver.phase, driver.state.taken_over)
    if words:
        return words
    first = next((w for w in done if w in HOLDS_BACK and RANKS[w] < command.rank), "")
    if first and command.word in SETS_GOING:
        return f"{first.replace('_', ' ')} came at the same tick and counts more"
    return ""


def meant(driver: Driver, command: Command) -> Command:
    """The command with what it is about, where that was left open: the record must name it."""
    if command.word != "veto" or command.address is not None or driver.carrier is not None:
        return command
    with restartable():
        return replace(command, address=driver.next_edge())


def _told(driver: Driver, command: Command, refused: str) -> Commanded:
    return Commanded(
        t=driver.run.time,
        command=command.word,
        by=command.by,
        address=str(command.address or ""),
        value=command.value,
        reason=command.reason,
        refused=refused,
    )
