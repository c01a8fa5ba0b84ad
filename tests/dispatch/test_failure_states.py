"""Routes never lead into a failure state, and a run in a failure state recovers first."""

from __future__ import annotations

from typing import Any

import pytest

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.dispatch.route.planner import WITHOUT_FAILURE, Planner
from tests.dispatch.runs import Story, blueprint, branch, goals, short

GRIP: dict[str, Any] = {"facts": {"0": {"name": "Grip", "failure": ["x"]}}}


def grip(edges: dict[str, str], **more: Any) -> Any:
    """One SB of a fact that fails as x; states are named by it and a counter."""
    return {"SB1": branch(edges, **{**GRIP, **more})}


def test_a_route_goes_round_a_failure_state_even_where_that_costs_more() -> None:
    values = grip({"a0": "drop>x0, on>a1", "a1": "on>a2", "a2": "on>b0", "x0": "lift>b0", "b0": ""})
    story = Story(blueprint(values)).run()
    assert short(story.started) == ["on", "on", "on"]


def test_where_only_a_failure_state_leads_on_there_is_no_route() -> None:
    values = grip({"a0": "drop>x0", "x0": "lift>b0", "b0": ""})
    story = Story(blueprint(values)).run()
    assert story.started == []
    assert story.end.reason == "no_route"


def test_a_person_may_ask_for_what_no_route_does() -> None:
    values = grip({"a0": "drop>x0", "x0": "lift>b0", "b0": ""})
    story = Story(blueprint(values), automatic=False).ask("drop")
    assert story.configuration == {"SB1": "Statex0"}


def test_out_of_a_failure_the_nearest_state_without_comes_first() -> None:
    values = grip(
        {"x0": "far>b0, near>x1", "x1": "lift>a0", "a0": "on>b0", "b0": ""},
        operations={"far": {"cost": 5}},
    )
    story = Story(blueprint(values), start={"SB1": "Statex0"}).run()
    assert [(e.goal, short(e.operations)) for e in story.of("route_planned")] == [
        (WITHOUT_FAILURE, ["near", "lift"]),
        ("SB1/Stateb0", ["on"]),
    ]
    assert story.end.reason == "goal_reached"


def test_the_nearest_that_leads_nowhere_is_passed_over() -> None:
    values = grip({"x0": "near>c0, far>x1", "x1": "lift>b0", "c0": "", "b0": ""})
    story = Story(blueprint(values), start={"SB1": "Statex0"}).run()
    assert short(story.started) == ["far", "lift"]


def test_a_sub_that_failed_is_brought_out_of_it_before_its_base_goes_on() -> None:
    values = {
        "SB1": branch({"00": "on>10", "10": "use>11", "11": ""}, subs={"SB2": 1}),
        "SB2": branch({"a0": "close>b0", "x0": "open>a0", "b0": ""}, **GRIP),
    }
    made = blueprint(values)
    start = {"SB1": "State00", "SB2": "Statex0"}
    legs = Planner(Hierarchy(made)).legs(start, goals(made, "SB1/State11"))
    assert legs is not None
    assert [leg.aim for leg in legs] == [WITHOUT_FAILURE, "SB1/State11"]
    assert [edge.operation for leg in legs for edge in leg.operations] == [
        "open",
        "on",
        "use",
        "close",
    ]


def test_a_goal_that_holds_takes_no_operation_though_something_failed() -> None:
    values = {
        "SB1": branch({"0": "on>1", "1": "off>0"}, subs={"SB2": 0}),
        "SB2": branch({"a0": "close>b0", "x0": "open>a0", "b0": ""}, **GRIP),
    }
    made = blueprint(values)
    start = {"SB1": "State0", "SB2": "Statex0"}
    assert Planner(Hierarchy(made)).legs(start, goals(made, "SB1/State0")) == ()


@pytest.mark.parametrize("failure", [[], ["y"]])
def test_what_is_declared_no_failure_is_a_state_like_any_other(failure: list[str]) -> None:
    values = grip(
        {"a0": "drop>x0, on>a1", "a1": "on>b0", "x0": "lift>b0", "b0": ""},
        facts={"0": {"failure": failure}},
    )
    story = Story(blueprint(values)).run()
    assert short(story.started) == ["drop", "lift"]
