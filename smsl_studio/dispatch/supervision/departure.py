"""The departure of the person who attended a run: if the run waits for somebody, it ends."""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.dispatch.route.planner import holds

if TYPE_CHECKING:
    from smsl_studio.dispatch.drive.driver import Driver


def leave(driver: Driver) -> None:
    """Note that nobody attends the run any more. If it waits for somebody, it ends.

    If it waits at its goals, they are checked once more, and the result decides how it ends.
    """
    if driver.phase == "waiting":
        driver.desk.settled()
    driver.nobody_attends()
    held, phase = driver.state.held, driver.phase
    if held is not None and phase in ("no_route", "fault_hold"):
        driver.finish(held.ends, held.reason)
    elif phase == "stopped":
        driver.finish("stopped", driver.sentence)
    elif phase in ("ready", "paused") and _at_goals(driver):
        driver.state.follow(route=True)
        driver.state.resume()
        driver.arrival.close()
    elif phase == "waiting" and not driver.starting.told:
        driver.finish("refused", f"The start is not known, and {driver.desk.nobody}.")
    elif phase == "waiting":
        _finish(driver, f"The run is waiting, and {driver.desk.nobody}.")
    elif phase in ("ready", "paused", "taken_over"):
        words = phase.replace("_", " ").replace("ready", "waiting to be asked")
        _finish(driver, f"The run is {words}, and nobody is there to go on with it.")


def _finish(driver: Driver, sentence: str) -> None:
    """End a run that waits. A frozen operation is cancelled and braked first."""
    if driver.carrier is not None:
        driver.carrier.cut("nobody is there to go on with it")
        driver.run.drop_pending()
    driver.finish("held", sentence)


def _at_goals(driver: Driver) -> bool:
    """Return whether the run is at all its goals, and nothing is open that could change this."""
    if driver.carrier is not None or driver.desk.busy:
        return False
    return holds(driver.run.configuration, driver.course.goals)
