"""What is said about edges: veto, prune, restore, cost. Nothing moves by it; routes change."""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.supervision.command import Command
from smsl_studio.errors import AddressError, UsageError
from smsl_studio.runlog.events import CostsChanged, OperationPruned, OperationRestored

if TYPE_CHECKING:
    from smsl_studio.dispatch.driver import Driver


def veto(driver: Driver, command: Command) -> str:
    """The next edge, or this one out of an active state, is skipped once; too late once it has
    begun."""
    carrier, address = driver.carrier, command.address
    here = dict(driver.run.configuration)
    if carrier is not None:
        here.update(carrier.step.after)
        begun = [edge.address for edge in carrier.step.edges]
        if address is None or address in begun:
            driver.state.too_late = carrier.step.asked.address
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


def prune(driver: Driver, command: Command) -> str:
    """Shut an edge out; if it is being carried out, stop it."""
    address, run, carrier = command.address, driver.run, driver.carrier
    assert address is not None
    if unknown := _unknown(driver, address):
        return unknown
    driver.course.prune(address, command.reason)
    run.emit(OperationPruned(t=run.time, address=str(address), reason=command.reason))
    if carrier is not None and address in carrier.uncommitted:
        driver.state.frozen = False
        carrier.abort("hold", f"{address} was pruned: {command.reason}")
    driver.withdraw()
    return ""


def restore(driver: Driver, command: Command) -> str:
    """Let a pruned, avoided, vetoed or risky edge be used again."""
    address, run = command.address, driver.run
    assert address is not None
    if not driver.course.restore(address):
        return f"{address} is not shut out"
    run.emit(OperationRestored(t=run.time, address=str(address)))
    return ""


def set_cost(driver: Driver, command: Command) -> str:
    """Price an edge anew; the route is found again at the next operation."""
    address, run, cost = command.address, driver.run, float(command.value)
    assert address is not None
    if unknown := _unknown(driver, address):
        return unknown
    try:
        changed = driver.course.set_cost(address, cost)
    except UsageError as error:
        return error.sentence
    if changed:
        run.emit(CostsChanged(t=run.time, costs={str(a): c for a, c in changed.items()}))
    return ""


def _unknown(driver: Driver, address: Address) -> str:
    try:
        driver.run.blueprint.resolve(address)
    except AddressError as error:
        return error.sentence
    return "" if address.operation else f"{address} is no operation"
