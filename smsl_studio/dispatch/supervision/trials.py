"""Trying what happens when things go wrong, and what is shown to whom."""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.dispatch.supervision.command import Command
from smsl_studio.errors import HostError, StudioError
from smsl_studio.runlog.events import Disturbed, FaultInjected

if TYPE_CHECKING:
    from smsl_studio.dispatch.driver import Driver


def disturb(driver: Driver, command: Command) -> str:
    """Switch a disturbance of sensors on or off."""
    run, said = driver.run, command.parameters
    try:
        met = run.host.disturb(said["target"], said["kind"], **said["with"])
    except HostError:
        raise
    except StudioError as error:
        return _words(error)
    parameters = {name: str(value) for name, value in said["with"].items()}
    target, kind = said["target"], said["kind"]
    run.emit(Disturbed(t=run.time, target=target, kind=kind, parameters=parameters, sensors=met))
    return ""


def inject(driver: Driver, command: Command) -> str:
    """Have something go wrong in the world."""
    run = driver.run
    try:
        run.host.inject(command.value, **command.parameters)
    except HostError:
        raise
    except StudioError as error:
        return _words(error)
    parameters = {name: str(value) for name, value in command.parameters.items()}
    run.emit(FaultInjected(t=run.time, fault=command.value, parameters=parameters))
    return ""


def full_map(driver: Driver, command: Command) -> str:
    """Show the whole map, or no longer."""
    driver.state.full_map = command.value == "on"
    return ""


def answer(driver: Driver, command: Command) -> str:
    """A person answers a task, in a role; the desk says why it does not count."""
    said = command.parameters
    return driver.desk.answer(command.value, said["option"], said["role"], command.by)


def _words(error: StudioError) -> str:
    return f"{error.sentence}. {error.advice}".removesuffix(". ")
