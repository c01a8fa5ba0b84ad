"""Trying what happens when things go wrong, and what is shown to whom."""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.dispatch.supervision.row import PERSON
from smsl_studio.errors import HostError, StudioError

if TYPE_CHECKING:
    from smsl_studio.dispatch.drive.driver import Driver


def disturb(
    driver: Driver, /, target: str, kind: str, *, by: str = PERSON, **parameters: float | str
) -> str:
    """Disturb a sensor, or all of one fact (``SB/digit``), from now on; ``none`` ends it."""
    from smsl_studio.runlog.events import Disturbed

    run = driver.run
    try:
        met = run.host.disturb(target, kind, **parameters)
    except HostError:
        raise
    except StudioError as error:
        return _words(error)
    told = {name: str(value) for name, value in parameters.items()}
    run.emit(Disturbed(t=run.time, target=target, kind=kind, parameters=told, sensors=met))
    return ""


def inject(driver: Driver, /, fault: str, *, by: str = PERSON, **parameters: float | str) -> str:
    """Have something go wrong in the world, by the name that its plugin gave it."""
    from smsl_studio.runlog.events import FaultInjected

    run = driver.run
    try:
        run.host.inject(fault, **parameters)
    except HostError:
        raise
    except StudioError as error:
        return _words(error)
    told = {name: str(value) for name, value in parameters.items()}
    run.emit(FaultInjected(t=run.time, fault=fault, parameters=told))
    return ""


def full_map(driver: Driver, on: bool, *, by: str = PERSON) -> str:
    """Show a supervisor the whole map instead of the neighbours, or no longer."""
    driver.state.show_map(bool(on))
    return ""


def answer(driver: Driver, task: str, option: str, role: str = "", *, by: str = PERSON) -> str:
    """Answer a task, in a role; what was answered stays hidden until all have."""
    return driver.desk.answer(task, option, role, by)


def _words(error: StudioError) -> str:
    return f"{error.sentence}. {error.advice}".removesuffix(". ")
