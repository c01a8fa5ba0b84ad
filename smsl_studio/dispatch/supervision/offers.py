"""What a person may do about a run that does not go on by itself, each with a sentence."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from smsl_studio.dispatch.status import Offer
from smsl_studio.dispatch.trouble import NO_ROUTE

if TYPE_CHECKING:
    from smsl_studio.dispatch.driver import Driver


def offers(driver: Driver) -> tuple[Offer, ...]:
    """The offers of the run state, the most promising first; none where the run goes on."""
    if driver.ended is not None:
        return ()
    state, phase = driver.state, driver.phase
    if phase == "stopped":
        return (
            Offer("reset", "", "Unlatch the stop. The run is paused then."),
            Offer("end", "", "End the run here."),
        )
    if phase == "taken_over":
        return tuple(_taken_over(driver))
    if state.held is not None and phase in ("no_route", "fault_hold"):
        return tuple(_held(driver))
    if driver.carrier is not None and state.too_late is not None:
        words = f"Stop {state.too_late}, for which a veto came too late."
        return (Offer("stop", "", words),)
    return ()


def _taken_over(driver: Driver) -> Iterator[Offer]:
    offered = driver.state.offered
    if offered is not None:
        yield Offer("accept", "", f"Accept {_states(offered)}, where every state check is true.")
    yield Offer("give_back", "", "Ask the scene where the procedure stands.")
    yield Offer("stop", "", "Brake and latch.")


def _held(driver: Driver) -> Iterator[Offer]:
    held, course, found = driver.state.held, driver.course, driver.trouble.candidates
    assert held is not None
    if held.kind != NO_ROUTE and len(found) == 1:
        yield Offer("adopt", "", f"Go on from {_states(found[0])}, which the scene agrees with.")
    for address in held.blocking:
        if address in course.closed:
            words = f"Let {address} be used again. It is {course.closed[address]}."
            yield Offer("restore", str(address), words)
    for one in driver.outlook.known()[0]:
        if one.risky and one.permitted:
            words = f"Try {one.address} again. It failed: {course.risky[one.address]}."
            yield Offer("ask", str(one.address), words)
    yield Offer("resume", "", "Read the scene again and go on from there.")
    yield Offer("take_over", "", "Take over, and give back when it stands where it should.")
    yield Offer("end", "", "End the run here.")


def _states(configuration: Mapping[str, str]) -> str:
    return ", ".join(f"{name}/{state}" for name, state in configuration.items())
