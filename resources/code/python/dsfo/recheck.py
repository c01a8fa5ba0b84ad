"""The check before a run goes on: the scene decides."""

from __future__ import annotations

from .carrier import Carrier
from .driver import Driver


def recheck(driver: Driver) -> None:
    """Check state and route before the run goes on."""
    run, held, carrier = driver.run, driver.state.held, driver.carrier
    if carrier is not None:
        _recheck_others(driver, carrier)
    elif driver.desk.busy:
        run.look()
    elif held is not None:
        driver.loops.forget()
        driver.course.lift_vetoes(held.skipped)
        driver.release()
        driver.informed(lambda: _locate(driver))
    else:
        run.look()
        if not driver.endangered() and not run.stands(run.configuration):
            driver.informed(lambda: _read_again(driver))


def _recheck_others(driver: Driver, carrier: Carrier) -> None:
    """Abort a frozen operation if a fact that it does not move has changed."""
    run = driver.run
    run.look()
    carrier.watch()
    moved = {name for edge in carrier.step.edges for name in run.moved_by(edge)}
    words = run.words([term for term in run.broken() if term.fact[0] not in moved])
    if words:
        carrier.abort(f"while it was held, {'; '.join(words)}")


def _locate(driver: Driver) -> None:
    if not driver.endangered():
        driver.hold(driver.trouble.relocalise())


def _read_again(driver: Driver) -> None:
    if not driver.endangered() and not driver.run.stands(driver.run.configuration):
        driver.hold(driver.trouble.relocalise())
