"""Carries out the commands of one tick in their order, and answers each.

The row of a command has the run states that refuse it. In all other states its effect answers: with
the empty text if it was carried out, or with the reason if not.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from smsl_studio.dispatch.supervision.row import Command, in_order
from smsl_studio.errors import HostError
from smsl_studio.runlog.events import Commanded

if TYPE_CHECKING:
    from smsl_studio.dispatch.drive.driver import Driver


def obey(driver: Driver, commands: list[Command]) -> None:
    """Carry out the commands of one tick, which are in order of rank, and remove them from the
    list.

    Each is answered by one event, which comes before its effects. If the host dies, the other
    commands are answered first. A command that is called off (see ``stop``) stays in the list.
    """
    done: list[Command] = []
    gone: HostError | None = None
    while commands:
        command = commands[0]
        at = driver.run.mark
        try:
            refused = (
                f"the world is gone: {gone.sentence}" if gone else _why_not(driver, command, done)
            )
            if not refused:
                command = meant(driver, command)
                refused = command.row.effect(driver, **command.said, by=command.by)
        except HostError as error:
            gone, refused = error, f"the world is gone: {error.sentence}"
        del commands[0]
        if not refused or command.row.stands:
            done.append(command)
        driver.run.tell_before(at, _told(driver, command, refused))
    if gone is not None:
        raise gone


def refuse(driver: Driver, commands: Sequence[Command], reason: str) -> None:
    """Refuse commands that cannot be carried out any more, with this reason."""
    for command in in_order(commands):
        driver.run.emit(_told(driver, command, reason))


def _why_not(driver: Driver, command: Command, done: Sequence[Command]) -> str:
    if driver.ended is not None:
        return "the run is over"
    row = command.row
    words = row.why_refused(driver.phase, driver.state.taken_over)
    if words:
        return words
    back = (one.row for one in done if one.row.holds_back and one.row.rank < row.rank)
    first = next(back, None)
    if first is not None and row.sets_going:
        return f"{first.word.replace('_', ' ')} came at the same tick and counts more"
    return ""


def meant(driver: Driver, command: Command) -> Command:
    """Return the command with its operation. If it names none, the row finds it, because the record
    must name it.
    """
    if command.row.about is None or command.address is not None:
        return command
    return replace(command, said={**command.said, "address": command.row.about(driver)})


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
