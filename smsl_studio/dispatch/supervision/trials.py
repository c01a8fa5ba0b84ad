"""The effects of trials (disturbances and faults), of the full map, and of answers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.dispatch.supervision.row import PERSON
from smsl_studio.errors import HostError, StudioError

if TYPE_CHECKING:
    from smsl_studio.dispatch.drive.driver import Driver


def disturb(
    driver: Driver, /, target: str, kind: str, *, by: str = PERSON, **parameters: float | str
) -> str:
    """Disturb a sensor, or all sensors of a fact (``SB/digit``), from now on. ``none`` ends it."""
    from smsl_studio.runlog.events import Disturbed

    run = driver.run
    try:
        met = run.host.disturb(target, kind, **parameters)
    except HostError:
        raise
    except StudioError as error:
        return _words(error)
    run.senses.distrust()
    told = {name: str(value) for name, value in parameters.items()}
    run.emit(Disturbed(t=run.time, target=target, kind=kind, parameters=told, sensors=met))
    return ""


def inject(driver: Driver, /, fault: str, *, by: str = PERSON, **parameters: float | str) -> str:
    """Cause a fault in the world. ``fault`` is the name that its plugin registered."""
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
    """Show the whole map to the supervisor, or only the partial view."""
    driver.state.show_map(bool(on))
    return ""


def answer(driver: Driver, task: str, option: str, role: str = "", *, by: str = PERSON) -> str:
    """Answer a task in a role. The answer is hidden until all answers are given."""
    return driver.desk.answer(task, option, role, by)


def _words(error: StudioError) -> str:
    return f"{error.sentence}. {error.advice}".removesuffix(". ")
