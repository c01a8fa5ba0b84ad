"""The state of required facts in a run, as the canvas shows it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import Reading, Scene
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus, Possible
from smsl_studio.front.views.guard_standings import held_back, standings
from tests.front.views import statuses
from tests.stories.person import sample

MOVE = Address("ROBOT", "State10", "MoveToTarget")
THERE = {"REGISTRATION": "State111", "DIGITIZATION": "State1", "TOOLPLAN": "State11"}


def _status(readings: Mapping[tuple[str, int], Reading], **states: str) -> DispatchStatus:
    possible = Possible(MOVE, "State11", False, ("why",), 1.0, on_route=False)
    configuration = {**THERE, "ROBOT": "State10", **states}
    scene = Scene(readings, 1.0)
    return statuses.status(
        configuration, phase="ready", time=1.0, scene=scene, possible=(possible,)
    )


def _rooms() -> Blueprint:
    return sample("three-roots.json")


def _sensed(value: str | None, reason: str = "") -> Reading:
    return Reading(value, sensed=True, reason=reason)


def test_all_that_is_needed_holds() -> None:
    status = _status({("REGISTRATION", 2): _sensed("1")})
    how, words = standings(_rooms(), "ROBOT", status)[MOVE]
    assert how == "true"
    assert words == (
        "needs Registered of REGISTRATION to be 1: it is; needs Entry chosen of TOOLPLAN to be 1: "
        "it is; needs Target chosen of TOOLPLAN to be 1: it is"
    )
    assert held_back({MOVE: (how, words)}, status) == frozenset()


def test_one_that_is_unknown_holds_the_operation_back() -> None:
    status = _status({("REGISTRATION", 2): _sensed(None, "no reading for 1.2 s")})
    found = standings(_rooms(), "ROBOT", status)
    assert found[MOVE][0] == "unknown"
    assert "it is unknown, no reading for 1.2 s" in found[MOVE][1]
    assert held_back(found, status) == {MOVE}
    elsewhere = replace(status, possible=())
    assert held_back(found, elsewhere) == frozenset()


def test_one_that_does_not_hold_is_said_before_one_that_is_unknown() -> None:
    status = _status({("REGISTRATION", 2): _sensed(None, "stale")}, TOOLPLAN="State01")
    found = standings(_rooms(), "ROBOT", status)
    assert found[MOVE][0] == "false"
    assert "Entry chosen of TOOLPLAN to be 1: it is 0" in found[MOVE][1]
    assert held_back(found, status) == frozenset()


def test_an_sb_that_needs_nothing_has_no_guards() -> None:
    assert standings(_rooms(), "TOOLPLAN", _status({})) == {}
