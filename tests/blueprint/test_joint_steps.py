"""Clauses 5, 6, 10 and 12: the effect of a joint step, what is committed together, and its cost."""

from __future__ import annotations

from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.along import Unavailable
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from tests.dispatch.runs import blueprint, branch

LINE = branch({"00": "a>10", "10": "b>11", "11": "c>10, d>01", "01": "e>00"}, activating="11")
"""A sub-SB with two steps up (a, b) and two down: by c (and no further) or d, e."""


def asked(
    made: Blueprint, address: str, start: dict[str, str] | None = None, **terms: Any
) -> JointStep | Unavailable:
    hierarchy = Hierarchy(made)
    stepper = Stepper(hierarchy, Terms(**terms))
    place = Address(*Address.split(address))
    configuration = start_configuration(hierarchy, {place.branch: place.state, **(start or {})})
    edge = stepper.edges.get(place)
    assert edge is not None
    return stepper.step(configuration, edge)


def step_of(made: Blueprint, address: str, **more: Any) -> JointStep:
    step = asked(made, address, **more)
    assert isinstance(step, JointStep), step
    return step


def names(step: JointStep) -> list[str]:
    return [edge.name for edge in step.edges]


def commits(step: JointStep) -> list[list[str]]:
    return [[edge.name for edge in action.commits] for action in step.actions]


def two(states: dict[str, str], **more: Any) -> Blueprint:
    return blueprint({"BASE": branch(states, subs={"SUB": 0}, **more), "SUB": LINE})


RISE = {"00": "up>10", "10": "down>00, fall>01", "01": "mix>10"}


def test_clause_5_a_rise_drives_its_sub_and_runs_no_function() -> None:
    step = step_of(two(RISE), "BASE/State00/up")
    assert [action.edge.name for action in step.actions] == ["a", "b"]
    assert names(step) == ["up", "a", "b"]
    assert step.after == {"BASE": "State10", "SUB": "State11"}


def test_clause_6_a_rise_commits_with_the_crossing_and_what_comes_before_commits_alone() -> None:
    assert commits(step_of(two(RISE), "BASE/State00/up")) == [["a"], ["b", "up"]]


def test_clause_6_after_the_crossing_of_a_fall_the_rest_commits_singly() -> None:
    step = step_of(two(RISE), "BASE/State10/down")
    assert commits(step) == [["d", "down"], ["e"]]
    assert [set(action.transit) for action in step.actions] == [{("BASE", 0)}, set()]


def test_clause_6_with_an_own_function_everything_after_the_crossing_is_pending_until_then() -> (
    None
):
    step = step_of(two(RISE), "BASE/State10/fall")
    assert [action.edge.name for action in step.actions] == ["d", "e", "fall"]
    assert commits(step) == [[], [], ["d", "e", "fall"]]
    assert all(action.transit == {("BASE", 0)} for action in step.actions)
    assert step.actions[-1].committed == {"SUB": "State00", "BASE": "State01"}


def test_clause_6_before_the_crossing_of_a_mixed_edge_the_sub_still_commits_alone() -> None:
    assert commits(step_of(two(RISE), "BASE/State01/mix")) == [["a"], [], ["b", "mix"]]


def test_clause_5_falls_come_first_then_rises_in_order_of_digit() -> None:
    made = blueprint(
        {
            "BASE": branch({"100": "go>011", "011": ""}, subs={"X": 1, "Y": 0, "Z": 2}),
            **{name: branch({"0": f"{name}up>1", "1": f"{name}down>0"}) for name in "XYZ"},
        }
    )
    step = step_of(made, "BASE/State100/go")
    assert names(step) == ["go", "Ydown", "Xup", "Zup"]
    assert commits(step) == [[], [], ["Ydown", "Xup", "Zup", "go"]]


def test_clause_6_where_the_last_crossing_is_a_fall_the_rest_of_its_route_commits_singly() -> None:
    made = blueprint(
        {
            "BASE": branch({"11": "go>00", "00": ""}, subs={"SUB": 1, "TOO": 0}),
            "SUB": LINE,
            "TOO": branch({"0": "r>1", "1": "s>0"}),
        }
    )
    step = step_of(made, "BASE/State11/go", start={"BASE": "State11"})
    assert names(step) == ["go", "s", "d", "e"]
    assert commits(step) == [[], ["s", "d", "go"], ["e"]]


def test_clause_5_a_function_bound_to_exactly_this_edge_runs_last_on_a_rise() -> None:
    made = two(RISE)
    exact = [Address("BASE", "State00", "up")]
    step = step_of(made, "BASE/State00/up", exact=exact)
    assert [action.edge.name for action in step.actions] == ["a", "b", "up"]
    assert commits(step) == [["a"], [], ["b", "up"]]
    assert step.cost == 3.0
    assert step_of(made, "BASE/State00/up").cost == 2.0


def test_clause_5_load_moves_no_sub_and_finds_them_where_the_function_left_them() -> None:
    made = two(RISE, operations={"mix": {"subs": "load"}})
    step = step_of(made, "BASE/State01/mix")
    assert [action.edge.name for action in step.actions] == ["mix"]
    assert step.after == {"SUB": "State11", "BASE": "State10"}
    assert step.cost == 1.0


def test_clause_5_load_reaches_the_lowest_level() -> None:
    notes = {"load": {"subs": "load"}}
    top = branch({"000": "load>110", "110": ""}, subs={"MID": 1}, operations=notes)
    mid = branch({"00": "go>01", "01": "on>11", "11": ""}, subs={"LOW": 1})
    made = blueprint({"TOP": top, "MID": mid, "LOW": LINE})
    step = step_of(made, "TOP/State000/load")
    assert step.after == {"MID": "State11", "LOW": "State11", "TOP": "State110"}


def test_clause_5_a_crossing_of_a_shared_sub_takes_along_every_other_base() -> None:
    shared = {
        "ONE": branch({"0": "up>1", "1": "down>0"}, subs={"SUB": 0}),
        "TWO": branch({"0": "rise>1", "1": ""}, subs={"SUB": 0}),
        "SUB": branch({"0": "go>1", "1": "back>0"}),
    }
    step = step_of(blueprint(shared), "ONE/State0/up")
    assert commits(step) == [["go", "rise", "up"]]
    back = asked(blueprint(shared), "ONE/State1/down", start={"TWO": "State1"})
    assert isinstance(back, Unavailable)
    assert "TWO/State1 has no fall of digit 0" in str(back)


def test_clause_10_a_crossing_asked_directly_takes_along_the_cheapest_pure_edge() -> None:
    made = two(
        {"00": "dear>10, cheap>10, also>10, mixed>11, load>10", "10": "down>00", "11": ""},
        operations={"dear": {"cost": 5}, "mixed": {"cost": 0}, "load": {"cost": 0, "subs": "load"}},
    )
    step = step_of(made, "SUB/State10/b")
    assert names(step) == ["b", "also"]
    assert commits(step) == [["b", "also"]]


def test_clause_10_other_sub_operations_are_free() -> None:
    step = step_of(two(RISE), "SUB/State00/a")
    assert (names(step), commits(step)) == (["a"], [["a"]])


def test_clause_10_without_a_pure_edge_of_every_base_it_is_refused() -> None:
    step = asked(two(RISE), "SUB/State10/b", start={"BASE": "State01"})
    assert isinstance(step, Unavailable)
    assert step.reasons[0] == "BASE/State01 has no rise of digit 0 for SUB to take along"


def test_clause_10_goes_up_through_every_level() -> None:
    made = blueprint(
        {
            "TOP": branch({"0": "top>1", "1": "untop>0"}, subs={"MID": 0}),
            "MID": branch({"0": "mid>1", "1": "unmid>0"}, subs={"LOW": 0}),
            "LOW": LINE,
        }
    )
    assert commits(step_of(made, "LOW/State10/b")) == [["b", "mid", "top"]]
    assert commits(step_of(made, "TOP/State0/top")) == [["a"], ["b", "mid", "top"]]


@pytest.mark.parametrize(
    ("terms", "reason"),
    [
        ({"shut": {Address("SUB", "State10", "b"): "avoided"}}, "SUB/State10/b is avoided"),
        ({"shut": {Address("BASE", "State00", "up"): "pruned"}}, "BASE/State00/up is pruned"),
        ({"bound": [Address("SUB", "State00", "a")]}, "no function is bound to SUB/State10/b"),
    ],
)
def test_clause_4_what_is_not_there_is_named_for_every_edge_of_the_step(
    terms: dict[str, Any], reason: str
) -> None:
    step = asked(two(RISE), "BASE/State00/up", **terms)
    assert isinstance(step, Unavailable)
    assert reason in " ".join(step.reasons)


def test_clause_4_a_sub_goes_another_way_where_an_edge_is_shut() -> None:
    shut = {Address("SUB", "State11", "d"): "avoided"}
    assert names(step_of(two(RISE), "BASE/State10/down")) == ["down", "d", "e"]
    around = branch(
        {"00": "a>10", "10": "b>11, z>00", "11": "c>10, d>01", "01": "e>00"}, activating="11"
    )
    made = blueprint({"BASE": branch(RISE, subs={"SUB": 0}), "SUB": around})
    assert names(step_of(made, "BASE/State10/down", shut=shut)) == ["down", "c", "z"]


def test_clause_12_a_mixed_edge_costs_its_sub_routes_and_itself() -> None:
    notes = {"mix": {"cost": 4}, "up": {"cost": 9}}
    made = two(RISE, operations=notes)
    assert step_of(made, "BASE/State01/mix").cost == 6.0
    assert step_of(made, "BASE/State00/up").cost == 2.0


def test_a_step_is_asked_for_once_and_kept() -> None:
    hierarchy = Hierarchy(two(RISE))
    stepper = Stepper(hierarchy)
    edge = stepper.edges.get(Address("BASE", "State00", "up"))
    assert edge is not None
    start = start_configuration(hierarchy, {})
    assert stepper.step(start, edge) is stepper.step(dict(start), edge)
