"""Checking again before a run goes on: the scene decides, and people for what only they know."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from smsl_studio.dispatch.carrier import Carrier
from smsl_studio.dispatch.effects import moved_by
from smsl_studio.dispatch.people.needed import all_theirs, in_checks
from smsl_studio.dispatch.recovery import stands
from smsl_studio.dispatch.safeguards import lost_critical, lost_terms
from smsl_studio.dispatch.words import all_words

if TYPE_CHECKING:
    from smsl_studio.dispatch.driver import Driver


def recheck(driver: Driver) -> None:
    """Whoever lets the run go on has state and route checked again; the scene decides."""
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
        informed(driver, lambda: driver.hold(driver.trouble.relocalise()))
        return
    run.look()
    if not stands(run, run.configuration):
        informed(driver, lambda: _read_again(driver))


def informed(driver: Driver, then: Callable[[], None]) -> None:
    """Do it once people were asked for those facts of the active states that are unknown and
    theirs to say; at once where there are none, or nobody is there."""
    run = driver.run
    run.look()
    facts = in_checks(run, run.checks(run.configuration))
    if not facts or driver.desk.ask(facts, lambda _: then(), keep=True):
        then()


def lost(driver: Driver) -> bool:
    """Hold where a critical fact is false or unknown; whether that is so.

    It holds at once, whatever people are being asked. Only where all that is lost is theirs to say
    they are asked first, or may finish what they are asked already.
    """
    run = driver.run
    if not driver.starting.told or not lost_critical(run):
        return False

    def hold() -> None:
        facts = lost_critical(run)
        driver.hold(driver.trouble.lost(facts) if facts else None)

    theirs = all_theirs(run, lost_terms(run))
    if theirs and driver.desk.keeps:
        return False
    driver.withdraw()
    if theirs:
        informed(driver, hold)
    else:
        run.look()
        hold()
    return True


def _recheck_others(driver: Driver, carrier: Carrier) -> None:
    """An operation that was held goes on only where all that it does not move is as it was, and
    what it rests on is known."""
    run = driver.run
    run.look()
    carrier.watch()
    moved = {name for edge in carrier.step.edges for name in moved_by(run, edge)}
    words = all_words(run.blueprint, (term for term in run.broken() if term.fact[0] not in moved))
    if words:
        carrier.abort("hold", f"while it was held, {'; '.join(words)}")


def _read_again(driver: Driver) -> None:
    if not stands(driver.run, driver.run.configuration):
        driver.hold(driver.trouble.relocalise())
