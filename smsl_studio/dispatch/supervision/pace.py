"""The effects of ask, pause, resume and step. Each returns why it was refused, or the empty
text.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.dispatch.supervision.row import PERSON
from smsl_studio.stop import restartable

if TYPE_CHECKING:
    from smsl_studio.blueprint.address import Address
    from smsl_studio.dispatch.drive.driver import Driver


def ask(driver: Driver, address: Address, *, by: str = PERSON, every_time: bool = False) -> str:
    """Carry out one operation after all people have agreed. A refusal has all reasons, and nothing
    has moved.

    ``every_time`` says that a script asks for it every time the run comes here, so the number is
    limited.
    """
    from smsl_studio.blueprint.along import Unavailable
    from smsl_studio.blueprint.joint import JointStep
    from smsl_studio.dispatch.drive.admission import refusal
    from smsl_studio.dispatch.execution.guards import asked

    run, hazard = driver.run, ""
    reasons: tuple[str, ...]
    if driver.carrier is not None:
        reasons = (f"{driver.carrier.step.asked} is being carried out",)
    elif not driver.starting.over:
        reasons = ("the run has not begun yet",)
    elif driver.phase == "running" and not driver.state.by_hand:
        reasons = ("the run is automatic, pause it first",)
    elif driver.desk.keeps:
        reasons = ("people are being asked where the procedure stands",)
    else:
        run.look()
        with restartable():
            if run.opened.guarded:
                driver.follower.pricing.ask()
            answer = asked(run, driver.course, address)
        if isinstance(answer, JointStep) and every_time:
            circling = driver.repeats.why_not(run.configuration, answer.asked)
            driver.repeats.count(run.configuration, answer.asked)
            answer = Unavailable(circling) if circling else answer
        if isinstance(answer, JointStep):
            refused = driver.admission.admit(answer, chosen=True)
            # A question that a pause has frozen is no longer what the run waits for.
            if not refused:
                driver.state.thaw()
            return refused
        reasons, hazard = answer.reasons, answer.hazard
    run.emit(refusal(run.time, address, reasons, hazard))
    return "; ".join(reasons)


def pause(driver: Driver, *, by: str = PERSON) -> str:
    """Pause now, or in the way that the running operation declares: after its end, or by aborting
    it.
    """
    state, carrier = driver.state, driver.carrier
    if state.pausing:
        return "it pauses already, as soon as the operation allows"
    if carrier is None or not carrier.moving or carrier.can_freeze:
        driver.now_paused()
        return ""
    state.pause_later()
    if carrier.bound.stop != "finish":
        carrier.abort(carrier.bound.stop, "it was paused and cannot be held")
    return ""


def resume(driver: Driver, *, by: str = PERSON) -> str:
    """Go on after a pause or a hold, after a check of state and route. A run by hand is automatic
    from now on.
    """
    from smsl_studio.dispatch.supervision.recheck import recheck
    from smsl_studio.runlog.events import Resumed

    state = driver.state
    if driver.phase == "ready":
        state.follow(route=True)
    state.resume()
    driver.run.emit(Resumed(t=driver.run.time))
    if driver.carrier is None:
        driver.course.drop_plan()
    driver.reviewer.trust()
    recheck(driver)
    return ""


def step(driver: Driver, *, by: str = PERSON) -> str:
    """Carry out one operation of the route, then wait again. It is refused while one is carried
    out.
    """
    from smsl_studio.dispatch.supervision.recheck import recheck

    if driver.phase == "running" and driver.carrier is not None:
        return f"{driver.carrier.step.asked} is being carried out; step is ignored until it ended"
    if driver.state.once:
        return "one operation is about to begin already"
    driver.state.step()
    driver.reviewer.trust()
    recheck(driver)
    return ""


def set_automatic(driver: Driver, automatic: bool, *, by: str = PERSON) -> str:
    """Let the run follow the route by itself, or let it wait for requests."""
    driver.state.follow(route=bool(automatic))
    route_asks = driver.starting.over and not driver.admission.chosen and not driver.desk.keeps
    if driver.state.by_hand and route_asks:
        driver.withdraw()
    return ""
