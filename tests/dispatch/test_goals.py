"""Clauses 11, 12, 14: goals of roots and sub-SBs, several of each, and questions on the way."""

from __future__ import annotations

import json
from typing import Any

import pytest

from smsl_studio.blueprint.address import fact_text
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.dispatch.route.planner import Planner
from smsl_studio.host.local import LocalHost
from tests.dispatch.runs import Story, blueprint, branch, goals, sample, short


def on_table(name: str, **choices: Any) -> Story:
    made = sample(name)
    return Story(made, LocalHost(made, "table"), **choices).run()


def test_a_flat_run_has_one_start_and_one_commit_for_each_operation() -> None:
    story = on_table("hanoi", goals=["SB1/State_ccc"])
    assert story.end.reason == "goal_reached"
    assert story.end.operations == len(story.started) == len(story.commits) == 7
    assert {event.result for event in story.of("state_checked")} == {"true"}
    assert len(story.of("route_planned")) == 1


def test_the_papers_hierarchy_reaches_its_goal_with_the_sub_in_activating() -> None:
    story = on_table("hfsm")
    assert story.end.configuration == {"SB1": "State111", "SB2": "State1"}
    assert short(story.started) == ["Operation000", "Operation100B", "Operation0"]


def test_with_the_mixed_edge_avoided_it_goes_through_the_rise() -> None:
    story = on_table("hfsm", avoid=["SB1/State100/Operation100B"])
    assert "SB1/State100/Operation100A" in story.started
    assert story.commits[1] == ("SB2/State0/Operation0", "SB1/State100/Operation100A")
    assert story.end.configuration == {"SB1": "State111", "SB2": "State1"}


def test_it_goes_back_through_the_fall() -> None:
    story = on_table("hfsm", start={"SB1": "State110"}, goals=["SB1/State100"])
    assert story.commits == [("SB2/State1/Operation1", "SB1/State110/Operation110A")]
    assert story.end.reason == "goal_reached"


def test_three_levels_reach_and_every_edge_tells_its_address() -> None:
    story = on_table("three-levels")
    assert story.end.reason == "goal_reached"
    assert story.commits == [
        ("SURGERY/State000/PositionPatient",),
        ("REGISTRATION/State000/PlanLandmarks",),
        ("DIGITIZATION/State00/CalibratePointer",),
        ("DIGITIZATION/State10/TouchLandmarks", "REGISTRATION/State100/DigitizeLandmarks"),
        ("REGISTRATION/State110/Register", "SURGERY/State100/RegisterPatient"),
        ("SURGERY/State110/MoveTool",),
    ]
    assert sorted(story.started) == sorted(edge for group in story.commits for edge in group)


def test_clause_11_several_roots_go_to_their_activating_in_file_order() -> None:
    story = on_table("three-roots")
    reached = [event.goal for event in story.of("goal_reached")]
    assert reached == ["REGISTRATION/State111", "TOOLPLAN/State11", "ROBOT/State11"]
    assert story.end.reason == "goal_reached"


def test_clause_11_with_goals_only_the_named_roots_move() -> None:
    story = on_table("three-roots", goals=["TOOLPLAN/State11"])
    assert {address.partition("/")[0] for address in story.started} == {"TOOLPLAN"}
    assert story.end.configuration["ROBOT"] == "State00"


def test_clause_11_a_goal_that_holds_is_reached_with_no_operation() -> None:
    story = on_table("three-roots", goals=["TOOLPLAN/State00"])
    assert story.words[-2:] == ["goal_reached", "run_finished"]
    assert story.end.operations == 0
    assert story.started == []


def test_clause_11_a_goal_on_a_sub_moves_its_bases() -> None:
    story = on_table("registration-digitization", goals=["DIGITIZATION/State1"])
    assert story.end.reason == "goal_reached"
    story = on_table("three-levels", goals=["DIGITIZATION/State11"])
    assert story.end.configuration["REGISTRATION"] == "State110"


def test_clause_11_several_goals_bases_first_and_all_hold_at_the_end() -> None:
    wanted = ["DIGITIZATION/State10", "SURGERY/State100", "REGISTRATION/State100"]
    story = on_table("three-levels", goals=wanted)
    reached = [event.goal for event in story.of("goal_reached")]
    assert reached == [wanted[1], wanted[2], wanted[0]]
    assert story.end.reason == "goal_reached"
    assert story.end.configuration == {
        "SURGERY": "State100",
        "REGISTRATION": "State100",
        "DIGITIZATION": "State10",
    }


def test_clause_11_bases_come_first_also_where_the_file_has_them_last() -> None:
    made = blueprint(
        {
            "SUB": branch({"0": "a>2", "2": "b>1", "1": ""}, activating="1"),
            "BASE": branch({"00": "go>10", "10": ""}, subs={"SUB": 1}),
        }
    )
    story = Story(made, LocalHost(made, "table"), goals=["SUB/State2", "BASE/State10"]).run()
    assert short(story.started) == ["go", "a"]


def test_clause_11_where_one_goal_after_the_other_leads_nowhere_they_are_sought_together() -> None:
    """Going to the base's goal by the cheap edge leaves the sub where it cannot move any more."""
    made = blueprint(
        {
            "BASE": branch({"00": "go>10", "10": "", "01": ""}, subs={"SUB": 1}),
            "SUB": branch(
                {"0": "side>2, up>1", "1": "", "2": ""},
                activating="1",
                operations={"side": {"requires": {"BASE/0": "0"}}},
            ),
        }
    )
    story = Story(made, LocalHost(made, "table"), goals=["BASE/State10", "SUB/State2"]).run()
    assert story.end.reason == "goal_reached"
    assert short(story.started) == ["side", "go"]


def test_clause_11_a_goal_that_holds_at_the_start_is_left_where_another_needs_that() -> None:
    """D may leave B's ACTIVATING only with A, which must step aside for that and come back."""
    made = blueprint(
        {
            "A": branch(
                {"10": "aside>11", "11": "fall>01", "01": "back>00", "00": "rise>10"},
                subs={"B": 0},
            ),
            "D": branch(
                {"10": "fall>00", "00": "set>01", "01": "rise>11", "11": ""}, subs={"B": 0}
            ),
            "B": branch({"0": "up>1", "1": "down>0"}),
        }
    )
    start = {"A": "State10", "D": "State10", "B": "State1"}
    story = Story(made, start=start, goals=["A/State10", "D/State11"]).run()
    assert story.end.reason == "goal_reached"
    assert story.end.configuration == {"A": "State10", "D": "State11", "B": "State1"}
    assert short(story.started).count("aside") == 1


@pytest.mark.parametrize("sub", ["SUB", "S/U~B"])
def test_clause_11_a_sub_is_moved_for_what_an_edge_requires_of_it(sub: str) -> None:
    made = blueprint(
        {
            "BASE": branch(
                {"00": "go>10", "10": ""},
                subs={sub: 1},
                operations={"go": {"requires": {fact_text(sub, 0): "2"}}},
            ),
            sub: branch({"0": "side>2", "2": "up>1", "1": ""}, activating="1"),
        }
    )
    story = Story(made, LocalHost(made, "table")).run()
    assert story.end.reason == "goal_reached"
    assert short(story.started) == ["side", "go"]


def test_clause_12_ties_go_by_cost_then_number_then_names() -> None:
    made = blueprint(
        {
            "ONE": branch(
                {
                    "0": "z>1, y>2, x>3",
                    "1": "a>9",
                    "2": "a>9, b>9",
                    "3": "c>4",
                    "4": "c>9",
                    "9": "",
                },
                operations={"x": {"cost": 0}, "c": {"cost": 1}},
            )
        }
    )
    hierarchy = Hierarchy(made)
    legs = Planner(hierarchy).legs(start_configuration(hierarchy, {}), goals(made, "ONE/State9"))
    assert legs is not None
    assert [str(edge) for edge in legs[0].operations] == ["ONE/State0/y", "ONE/State2/a"]


def test_clause_12_costs_decide_between_bypass_and_sub_route() -> None:
    def route(cost: float) -> list[str]:
        made = blueprint(
            {
                "BASE": branch(
                    {"00": "up>10, load>10", "10": "on>11", "11": ""},
                    subs={"SUB": 0},
                    operations={"load": {"subs": "load", "cost": cost}},
                ),
                "SUB": branch({"0": "a>2", "2": "b>1", "1": ""}, activating="1"),
            }
        )
        story = Story(made, LocalHost(made, "table")).run()
        assert story.end.reason == "goal_reached"
        return short(story.started)

    assert route(1.5) == ["load", "on"]
    assert route(2.5) == ["up", "a", "b", "on"]


def test_clause_14_load_sets_the_subs_facts_on_the_table() -> None:
    story = on_table("registration-digitization")
    assert short(story.started) == ["UsePrevRegister"]
    assert story.end.configuration == {"REGISTRATION": "State111", "DIGITIZATION": "State1"}
    facts = {(e.branch, e.digit): e.value for e in story.of("fact_changed")}
    assert facts["DIGITIZATION", 0] == "1"


def test_registration_without_the_previous_one_plans_digitizes_registers() -> None:
    made = sample("registration")
    avoid = [
        str(edge.address) for edge in made["REGISTRATION"].edges() if edge.name == "Op_UsePrevReg"
    ]
    story = on_table("registration", avoid=avoid)
    assert story.end.configuration == {"REGISTRATION": "State_1111"}
    assert {"Op_PlanLandmarks", "Op_DigitizeLandmarks", "Op_Register"} <= set(short(story.started))


def test_a_plan_that_holds_is_not_made_again(monkeypatch: pytest.MonkeyPatch) -> None:
    count = 0
    plan = Planner.legs

    def counted(*args: Any) -> Any:
        nonlocal count
        count += 1
        return plan(*args)

    monkeypatch.setattr(Planner, "legs", counted)
    on_table("three-levels")
    assert count == 1


GUARDED = {
    "A": branch(
        {"10": "close>00", "00": "open>10, rise>01", "01": ""},
        initial="10",
        activating="01",
        subs={"B": 0, "C": 1},
    ),
    "B": branch({"0": "on>1", "1": "off>0"}, initial="0", activating="1"),
    "C": branch(
        {"00": "prepare>01", "01": "finish>11", "11": ""},
        initial="00",
        activating="11",
        operations={"prepare": {"requires": {"A/0": "1"}}},
    ),
}
"""C can be prepared only as long as A/0 is on, and it must be off before C may rise."""


def test_a_sub_is_asked_while_what_it_requires_still_holds() -> None:
    story = Story(blueprint(GUARDED), goals=["A/State01"]).run()
    assert story.end.reason == "goal_reached"
    assert short(story.started) == ["prepare", "close", "off", "rise", "finish"]


def test_an_operation_that_is_open_only_earlier_is_taken_where_it_is_cheaper() -> None:
    """``late`` can be asked at any time, and costs more than ``prepare``."""
    values = json.loads(json.dumps(GUARDED))
    values["C"]["State00"]["late"] = "State01"
    values["C"]["_operations"]["late"] = {"cost": 5}
    story = Story(blueprint(values), goals=["A/State01"]).run()
    assert short(story.started) == ["prepare", "close", "off", "rise", "finish"]
    assert story.of("route_planned")[0].cost == 3


def test_goals_on_two_subs_that_no_state_of_their_base_agrees_with_are_refused() -> None:
    story = Story(blueprint(GUARDED), goals=["B/State1", "C/State11"])
    assert story.end.reason == "refused"
    assert (
        "B/State1 and C/State11 cannot hold together: bases and subs cannot agree"
        in story.end.sentence
    )
    assert Story(blueprint(GUARDED), goals=["B/State1", "C/State01"]).phase == "running"


def test_goals_that_contradict_through_an_sb_between_them_are_refused() -> None:
    """C in ACTIVATING has B in ACTIVATING, since B has no other state for it, and A's goal not."""
    values = {
        "A": branch({"0": "up>1", "1": ""}, initial="0", activating="1", subs={"B": 0}),
        "B": branch({"0": "up>1", "1": ""}, initial="0", activating="1", subs={"C": 0}),
        "C": branch({"0": "up>1", "1": ""}, initial="0", activating="1"),
    }
    story = Story(blueprint(values), goals=["A/State0", "C/State1"])
    assert story.end.reason == "refused"
    assert "A/State0 and C/State1 cannot hold together" in story.end.sentence
