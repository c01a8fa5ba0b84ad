"""The effects of commands about pace, edges, people and trials."""

from __future__ import annotations

from typing import Any

from .admission import tell_refusal
from .driver import Driver
from .elements import parts
from .errors import Unavailable, UsageError
from .faults import inject_fault
from .joint import JointStep
from .recheck import recheck

# pace --------------------------------------------------------------------------------------------


def ask(driver: Driver, *, by: str, address: str, every_time: bool = False) -> str:
    """Carry out one operation after all guards have agreed. ``every_time`` says that a script asks
    for it every time the run comes here, so the number is limited.
    """
    run, hazard = driver.run, ""
    if driver.carrier is not None:
        reasons = [f"{driver.carrier.step.asked} is being carried out"]
    elif not driver.over:
        reasons = ["the run has not begun yet"]
    elif driver.phase == "running" and not driver.state.by_hand:
        reasons = ["the run is automatic, pause it first"]
    elif driver.desk.keeps:
        reasons = ["people are being asked where the procedure stands"]
    else:
        run.look()
        step = _asked(driver, address)
        if isinstance(step, JointStep) and every_time:
            circling = driver.repeats.why_not(run.configuration, step.asked)
            driver.repeats.count(run.configuration, step.asked)
            step = Unavailable(circling) if circling else step
        if isinstance(step, JointStep):
            refused = driver.admission.admit(step, chosen=True)
            if not refused:
                driver.state.frozen = False
            return refused
        reasons, hazard = list(step.reasons), step.hazard
    tell_refusal(run, address, reasons, hazard)
    return "; ".join(reasons)


def _asked(driver: Driver, address: str) -> JointStep | Unavailable:
    branch, state, name = parts(address)
    active = driver.run.configuration[branch]
    if active != state:
        return Unavailable(f"{branch} is in {active}, not in {state}")
    edge = driver.course.edge(branch, state, name)
    return driver.course.asked(driver.run.configuration, edge)


def pause(driver: Driver, *, by: str) -> str:
    """Pause now, or as the running operation declares: after its end, or by aborting it."""
    state, carrier = driver.state, driver.carrier
    if state.pausing:
        return "it pauses already, as soon as the operation allows"
    if carrier is None or not carrier.moving or carrier.can_freeze:
        driver.now_paused()
        return ""
    state.pausing = True
    if carrier.edge.terms.stop != "finish":
        carrier.abort("it was paused and cannot be held")
    return ""


def resume(driver: Driver, *, by: str) -> str:
    """Go on after a pause or a hold. A run by hand is automatic from now on."""
    if driver.phase == "ready":
        driver.state.by_hand = False
    driver.state.resume()
    driver.run.tell("resumed")
    if driver.carrier is None:
        driver.course.drop_plan()
    driver.reviewer.trust()
    recheck(driver)
    return ""


def step(driver: Driver, *, by: str) -> str:
    """Carry out one operation of the route, then wait again."""
    if driver.phase == "running" and driver.carrier is not None:
        return f"{driver.carrier.step.asked} is being carried out; step is ignored until it ended"
    if driver.state.once:
        return "one operation is about to begin already"
    driver.state.step()
    driver.reviewer.trust()
    recheck(driver)
    return ""


def set_automatic(driver: Driver, *, by: str, automatic: bool) -> str:
    """Let the run follow its route by itself, or let it wait for requests."""
    driver.state.by_hand = not automatic
    route_asks = driver.over and not driver.admission.chosen and not driver.desk.keeps
    if driver.state.by_hand and route_asks:
        driver.withdraw()
    return ""


# edges -------------------------------------------------------------------------------------------


def next_edge(driver: Driver) -> str:
    """Return the operation that people are asked about, else the next one of the route."""
    if driver.carrier is not None:
        return ""
    if driver.admission.proposed and driver.desk.busy and not driver.desk.keeps:
        return driver.admission.proposed
    return driver.course.next_operation(driver.run.configuration)


def veto(driver: Driver, *, by: str, address: str = "", reason: str = "") -> str:
    """Skip an edge once. It is too late if the edge has begun."""
    carrier, here = driver.carrier, dict(driver.run.configuration)
    if carrier is not None:
        here.update(carrier.step.after)
        if not address or address in [edge.address for edge in carrier.step.edges]:
            whole = carrier.step.asked.address
            part = f", and {address} is part of it" if address not in ("", whole) else ""
            return f"too late, {whole} is being carried out{part}; a stop ends it"
    if not address:
        return "there is no next operation"
    branch, state, _ = parts(address)
    if state != here[branch]:
        return f"{address} is not next; a prune shuts it out until it is restored"
    driver.course.veto(address, here)
    driver.withdraw()
    return ""


def prune(driver: Driver, *, by: str, address: str, reason: str) -> str:
    """Exclude an edge. If it is being carried out, it is aborted."""
    carrier = driver.carrier
    driver.course.prune(address, reason)
    driver.run.tell("operation_pruned", address=address, reason=reason)
    if carrier is not None and address in carrier.uncommitted:
        driver.state.frozen = False
        carrier.abort(f"{address} was pruned: {reason}")
    driver.withdraw()
    return ""


def restore(driver: Driver, *, by: str, address: str) -> str:
    """Let a pruned, avoided, vetoed or risky edge be used again."""
    if not driver.course.restore(address):
        return f"{address} is not shut out"
    driver.run.tell("operation_restored", address=address)
    return ""


def set_cost(driver: Driver, *, by: str, address: str, cost: float) -> str:
    """Give an edge another cost. The route is planned again before the next operation."""
    branch, state, name = parts(address)
    declared = driver.run.blueprint[branch].operation(state, name).cost
    if driver.course.set_cost(address, float(cost), declared):
        driver.run.tell("costs_changed", costs={address: float(cost)}, faults=[])
    return ""


# people, view, trials ----------------------------------------------------------------------------


def answer(driver: Driver, *, by: str, task: str, option: str, role: str = "") -> str:
    """Answer a task in a role."""
    return driver.desk.answer(task, option, role, by)


def full_map(driver: Driver, *, by: str, on: bool) -> str:
    """Note that somebody looks at the whole map. There is nothing to show here."""
    return ""


def disturb(driver: Driver, *, by: str, target: str, kind: str, **parameters: Any) -> str:
    """Disturb sensors from now on. The kind ``none`` ends it."""
    try:
        sensors = driver.run.senses.disturb(target, kind, parameters)
    except UsageError as error:
        return f"{error.sentence}. {error.advice}".removesuffix(". ")
    told = {name: str(value) for name, value in parameters.items()}
    driver.run.tell("disturbed", target=target, kind=kind, parameters=told, sensors=sensors)
    return ""


def inject(driver: Driver, *, by: str, fault: str, **parameters: str) -> str:
    """Cause a fault in the table world."""
    try:
        inject_fault(driver.run.host.world, driver.run.blueprint, fault, parameters)
    except UsageError as error:
        return f"{error.sentence}. {error.advice}".removesuffix(". ")
    told = {name: str(value) for name, value in parameters.items()}
    driver.run.tell("fault_injected", fault=fault, parameters=told)
    return ""
