"""The offers to a person for a run that does not go on by itself, each with a sentence."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from smsl_studio.blueprint.hazards import named
from smsl_studio.dispatch.execution.hazard_guard import met
from smsl_studio.dispatch.execution.status import Offer
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.runlog.phase import NO_ROUTE

if TYPE_CHECKING:
    from smsl_studio.dispatch.drive.driver import Driver


def offers(driver: Driver) -> tuple[Offer, ...]:
    """Return the offers in this run state, the most useful first. Empty if the run goes on."""
    if driver.ended is not None:
        return ()
    state, phase = driver.state, driver.phase
    always = tuple(_offer(row.word) for row in COMMANDS.values() if phase in row.offered)
    if phase == "taken_over" and state.offered is not None:
        return _offer("accept", states=_states(state.offered)), *always
    if state.held is not None and phase in ("no_route", "fault_hold"):
        return *_held(driver), *always
    if not always and driver.carrier is not None and state.too_late is not None:
        words = f"Stop {state.too_late}, for which a veto came too late."
        return (Offer("stop", "", words),)
    return always


def _held(driver: Driver) -> Iterator[Offer]:
    """Yield the offers about a configuration or an operation that a held run names."""
    held, course, found = driver.state.held, driver.course, driver.trouble.candidates
    assert held is not None
    if held.kind != NO_ROUTE and len(found) == 1:
        yield _offer("adopt", states=_states(found[0]))
    for address in held.blocking:
        if address in course.closed:
            yield _offer("restore", str(address), why=course.closed[address])
    hazards = met(driver.run)
    for one in driver.follower.outlook.known()[0]:
        if one.risky and one.permitted:
            yield _offer("ask", str(one.address), why=course.risky[one.address])
        elif hazards and one.permitted:
            words = f"Carry out {one.address}. It leaves {named(hazards)}."
            yield Offer("ask", str(one.address), words)


def _offer(word: str, address: str = "", **words: str) -> Offer:
    """Return an offer with the sentence of the command's row."""
    return Offer(word, address, COMMANDS[word].offer.format(address=address, **words))


def _states(configuration: Mapping[str, str]) -> str:
    return ", ".join(f"{name}/{state}" for name, state in configuration.items())
