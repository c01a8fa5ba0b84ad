"""Decisions: each tells its effect beforehand; a disabled one tells why."""

from __future__ import annotations

import pytest

from smsl_studio.dispatch.execution.status import Offer
from smsl_studio.front.views.partial import OperationCard, partial_view
from smsl_studio.studio.running import decisions
from tests.front.views.statuses import at, possible, sample, status

SAMPLE = sample("registration-digitization.json")
HERE = {"REGISTRATION": "State110", "DIGITIZATION": "State1"}
REGISTERED = "REGISTRATION/State110/Registered"


def _card(**said: object) -> OperationCard:
    found = status(HERE, possible=(possible(REGISTERED, "State111", **said),))
    view = partial_view(SAMPLE, found, "REGISTRATION")
    assert view is not None
    card = view.card(at(REGISTERED))
    assert card is not None
    return card


def test_a_permitted_operation_can_be_asked_for() -> None:
    decision = decisions.choose(_card())
    assert (decision.command, decision.verb) == ("ask", "Carry out Registered")
    assert decision.detail == "It leads to State111. Cost 1.0."


@pytest.mark.parametrize("word", ["pruned", "risky"])
def test_an_excluded_operation_can_be_restored(word: str) -> None:
    card = _card(permitted=False, reasons=("drill is blunt",), **{word: True})
    decision = decisions.choose(card)
    assert (decision.command, decision.verb) == ("restore", "Restore Registered")
    assert decision.detail == "Drill is blunt."


def test_what_is_refused_says_why_and_offers_nothing() -> None:
    decision = decisions.choose(_card(permitted=False, reasons=("clamp is open",)))
    assert (decision.command, decision.verb) == ("", "")
    assert decision.detail == "Clamp is open."


def test_a_veto_of_what_already_moves_comes_too_late() -> None:
    moving = status(HERE, phase="running", running=at(REGISTERED))
    assert decisions.veto(at(REGISTERED), moving).verb == ""
    assert decisions.veto(at(REGISTERED), status(HERE)).verb == "Veto Registered"


def test_pruning_asks_for_a_reason() -> None:
    assert decisions.prune(at(REGISTERED), status(HERE)).reasoned


def test_the_next_route_after_a_veto_with_its_length_and_cost() -> None:
    route = (at(REGISTERED),)
    way = (at("REGISTRATION/State110/ClearLandmarks"), at("REGISTRATION/State000/UsePrevRegister"))
    said = decisions.detour_words(SAMPLE, status(HERE, route=route, detour=way), route[0])
    assert said == (
        "If you veto, the next route is ClearLandmarks, then UsePrevRegister from State000. "
        "1 operation longer, cost 2.0."
    )
    none = decisions.detour_words(SAMPLE, status(HERE, route=route, detour=None), route[0])
    assert none == "If you veto, no other route leads to the goal: the run holds."
    assert decisions.detour_words(SAMPLE, status(HERE), None) == ""


def test_a_veto_that_changes_no_route_promises_no_other_route() -> None:
    way = (at("REGISTRATION/State110/ClearLandmarks"),)
    here = status(HERE, route=(at(REGISTERED),), detour=way)
    assert decisions.detour_words(SAMPLE, here, way[0]) == ""
    moving = status(HERE, phase="running", carrying=at(REGISTERED), route=here.route, detour=way)
    assert decisions.detour_words(SAMPLE, moving, at(REGISTERED)) == ""


def test_a_run_that_holds_always_has_a_way_out() -> None:
    for phase in ("stopped", "fault_hold", "no_route"):
        assert decisions.offers(status(HERE, phase=phase))[-1].command == "end"
    given = (Offer("restore", REGISTERED, "Let it be used again"), Offer("stop", "", "Brake"))
    found = decisions.offers(status(HERE, phase="no_route", offers=given))
    assert [offer.command for offer in found] == ["restore", "end"]
    assert decisions.offered(found[0]).verb == "Restore Registered"
