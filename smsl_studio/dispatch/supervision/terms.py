"""The effects of veto, prune, restore and set_cost. They change routes, and nothing moves."""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.supervision.row import PERSON
from smsl_studio.errors import AddressError, UsageError
from smsl_studio.stop import restartable

if TYPE_CHECKING:
    from smsl_studio.dispatch.drive.driver import Driver


def veto(
    driver: Driver, address: Address | None = None, *, reason: str = "", by: str = PERSON
) -> str:
    """Skip the next edge once, or this edge out of an active state. It is too late if the edge has
    begun.
    """
    carrier = driver.carrier
    here = dict(driver.run.configuration)
    if carrier is not None:
        here.update(carrier.step.after)
        begun = [edge.address for edge in carrier.step.edges]
        if address is None or address in begun:
            driver.state.come_too_late(carrier.step.asked.address)
            whole = carrier.step.asked.address
            part = f", and {address} is part of it" if address not in (None, whole) else ""
            return f"too late, {whole} is being carried out{part}; a stop ends it"
    if address is None:
        return "there is no next operation"
    if unknown := _unknown(driver, address):
        return unknown
    if address.state != here[address.branch]:
        return f"{address} is not next; a prune shuts it out until it is restored"
    driver.course.veto(address, here)
    driver.withdraw()
    return ""


def prune(driver: Driver, address: Address, reason: str, *, by: str = PERSON) -> str:
    """Exclude an edge. If it is being carried out, it is aborted."""
    from smsl_studio.runlog.events import OperationPruned

    run, carrier = driver.run, driver.carrier
    if unknown := _unknown(driver, address):
        return unknown
    driver.course.prune(address, reason)
    run.emit(OperationPruned(t=run.time, address=str(address), reason=reason))
    if carrier is not None and address in carrier.uncommitted:
        driver.state.thaw()
        carrier.abort("hold", f"{address} was pruned: {reason}")
    driver.withdraw()
    return ""


def restore(driver: Driver, address: Address, *, by: str = PERSON) -> str:
    """Let a pruned, avoided, vetoed or risky edge be used again."""
    from smsl_studio.runlog.events import OperationRestored

    run = driver.run
    if not driver.course.restore(address):
        return f"{address} is not shut out"
    run.emit(OperationRestored(t=run.time, address=str(address)))
    return ""


def set_cost(driver: Driver, address: Address, cost: float, *, by: str = PERSON) -> str:
    """Give an edge another cost. The route is planned again before the next operation."""
    from smsl_studio.runlog.events import CostsChanged

    run = driver.run
    if unknown := _unknown(driver, address):
        return unknown
    try:
        changed = driver.course.set_cost(address, float(cost))
    except UsageError as error:
        return error.sentence
    if changed:
        run.emit(CostsChanged(t=run.time, costs={str(a): c for a, c in changed.items()}))
    return ""


def next_edge(driver: Driver) -> Address | None:
    """Return the edge of a veto that names none. None in the middle of an operation."""
    if driver.carrier is not None:
        return None
    with restartable():
        return driver.next_edge()


def _unknown(driver: Driver, address: Address) -> str:
    try:
        driver.run.blueprint.resolve(address)
    except AddressError as error:
        return error.sentence
    return "" if address.operation else f"{address} is no operation"
