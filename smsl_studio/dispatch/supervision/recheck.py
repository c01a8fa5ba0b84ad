"""The check before a run goes on: the scene decides, and people tell the facts that only they
know.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.dispatch.execution.carrier import Carrier
from smsl_studio.dispatch.execution.effects import moved_by
from smsl_studio.dispatch.execution.recovery import stands
from smsl_studio.dispatch.execution.words import all_words

if TYPE_CHECKING:
    from smsl_studio.dispatch.drive.driver import Driver


def recheck(driver: Driver) -> None:
    """Check state and route before the run goes on. The scene decides."""
    run, held, carrier = driver.run, driver.state.held, driver.carrier
    if carrier is not None:
        _recheck_others(driver, carrier)
        return
    if driver.desk.busy:
        run.look()
        return
    if held is not None:
        driver.loops.forget()
        driver.course.lift_vetoes(held.skipped)
        driver.release()
        driver.integrity.informed(lambda: _locate(driver))
        return
    run.look()
    if driver.endangered():
        return
    if not stands(run, run.configuration):
        driver.integrity.informed(lambda: _read_again(driver))


def _recheck_others(driver: Driver, carrier: Carrier) -> None:
    """Abort a frozen operation if a fact that it does not move has changed, or if a fact that it
    needs is lost.
    """
    run = driver.run
    run.look()
    carrier.watch()
    moved = {name for edge in carrier.step.edges for name in moved_by(run, edge)}
    words = all_words(run.blueprint, (term for term in run.broken() if term.fact[0] not in moved))
    if words:
        carrier.abort("hold", f"while it was held, {'; '.join(words)}")


def _locate(driver: Driver) -> None:
    if not driver.endangered():
        driver.hold(driver.trouble.relocalise())


def _read_again(driver: Driver) -> None:
    if driver.endangered():
        return
    if not stands(driver.run, driver.run.configuration):
        driver.hold(driver.trouble.relocalise())
