"""Nested sub-SBs multiply the work of planning: it is counted over all levels, and limited."""

from __future__ import annotations

from typing import Any

import pytest

from smsl_studio import front
from smsl_studio.blueprint import allowance
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.along import Unavailable
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.search import PlanSearch
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.dispatch.route.planner import Planner
from smsl_studio.errors import PlanningError
from smsl_studio.front.starts import start_for_edge
from smsl_studio.runlog.events import EdgeSwept
from smsl_studio.stop import StopListener, Stopped, heeding
from tests.bombs.test_work import steps
from tests.dispatch.runs import blueprint, goals

TOO_MANY = "too many ways"
UP_DOWN_UP = {
    "State_00": {"a": "State_10"},
    "State_10": {"b": "State_0x"},
    "State_0x": {"c": "State_1x"},
    "State_1x": {"e": "State_0y"},
    "State_0y": {"f": "State_11"},
    "State_11": {"g": "State_00"},
}
SQUARE = {
    "State_00": {"u": "State_10", "v": "State_01"},
    "State_10": {"w": "State_11", "x": "State_00"},
    "State_01": {"y": "State_11", "z": "State_00"},
    "State_11": {"d": "State_00"},
}


def nested(levels: int, table: dict[str, Any] = UP_DOWN_UP) -> dict[str, Any]:
    """SBs one below the other; each but the last needs its sub three times on, twice off."""
    header = {"NUM_FACTS": 2, "INITIAL": "State_00", "ACTIVATING": "State_11"}
    below = [{"SUB_SBS": {f"L{at + 1}": 0}} for at in range(levels - 1)]
    return {
        f"L{at}": {"HEADER": {**header, **more}, **table} for at, more in enumerate([*below, {}])
    }


def requiring(levels: int) -> dict[str, Any]:
    """An operation of the topmost SB requires a fact of each SB of such a chain but the first."""
    made = nested(levels + 1, SQUARE)
    made["L0"] = {
        "HEADER": made["L0"]["HEADER"],
        "_operations": {"fin": {"requires": {f"L{at}/0": "1" for at in range(2, levels + 1)}}},
        "State_00": {"o": "State_10"},
        "State_10": {"fin": "State_11", "back": "State_00"},
        "State_11": {},
    }
    return made


def plan(raw: dict[str, Any]) -> object:
    made = blueprint(raw)
    hierarchy = Hierarchy(made)
    return Planner(hierarchy).legs(start_configuration(hierarchy, {}), goals(made, "L0/State_11"))


def test_one_more_level_is_three_times_the_operations_and_no_more_work_than_that() -> None:
    work = [steps(lambda n=n: plan(nested(n))) for n in (4, 5, 6)]  # type: ignore[misc]
    assert work[2] <= 4 * work[1]


def test_what_each_level_asks_for_is_searched_once_for_all_who_ask_alike() -> None:
    assert plan(requiring(5)) is not None
    assert steps(lambda: plan(requiring(7))) < 6 * steps(lambda: plan(requiring(5)))


def test_a_plan_has_one_allowance_for_all_its_levels(monkeypatch: pytest.MonkeyPatch) -> None:
    made = blueprint(requiring(6))
    hierarchy = Hierarchy(made)
    planner = Planner(hierarchy)
    question = start_configuration(hierarchy, {}), goals(made, "L0/State_11")
    planner.legs(*question)
    needed = planner.stepper.allowance.spent

    monkeypatch.setattr(allowance, "PER_EDGE", 0)
    monkeypatch.setattr(allowance, "MOST_WORK", needed)
    assert Planner(hierarchy).legs(*question) is not None
    monkeypatch.setattr(allowance, "MOST_WORK", needed - 1)
    refused = Planner(hierarchy)
    for _ in range(2):
        with pytest.raises(PlanningError, match=TOO_MANY) as no:
            refused.legs(*question)
        assert "fewer levels" in no.value.advice


@pytest.mark.parametrize("short", [0, 1])
def test_it_is_refused_or_found_whatever_was_asked_and_called_off_before(
    monkeypatch: pytest.MonkeyPatch, short: int
) -> None:
    made = blueprint(requiring(5))
    hierarchy = Hierarchy(made)
    start, wanted = start_configuration(hierarchy, {}), goals(made, "L0/State_11")
    fresh = Planner(hierarchy)
    legs = fresh.legs(start, wanted)
    monkeypatch.setattr(allowance, "PER_EDGE", 0)
    monkeypatch.setattr(allowance, "MOST_WORK", fresh.stepper.allowance.spent - short)

    planner, called_off, found = Planner(hierarchy), 0, None
    while True:
        try:
            with heeding(StopListener(3 + called_off // 4).heed):
                for name in hierarchy.order:
                    for edge in planner.stepper.edges.out(name, start[name]):
                        planner.stepper.step(start, edge)
                found = planner.legs(start, wanted)
            break
        except Stopped:
            called_off += 1
        except PlanningError:
            break
    assert called_off > 3
    assert found == (None if short else legs)


def test_a_joint_step_has_only_so_many_operations(monkeypatch: pytest.MonkeyPatch) -> None:
    made = blueprint(nested(4))
    hierarchy = Hierarchy(made)
    stepper, start = Stepper(hierarchy), start_configuration(hierarchy, {})
    (edge,) = stepper.edges.out("L0", "State_00")
    found = stepper.step(start, edge)
    assert isinstance(found, JointStep)
    count = len(found.edges)
    monkeypatch.setattr(allowance, "MOST_CARRIED", count)
    assert Stepper(hierarchy).step(start, edge) == found

    monkeypatch.setattr(allowance, "MOST_CARRIED", count - 1)
    refused = Stepper(hierarchy).step(start, edge)
    assert isinstance(refused, Unavailable)
    assert f"more than {count - 1} operations" in refused.reasons[0]
    with pytest.raises(PlanningError, match="L0/State_00/a would take more than"):
        plan(nested(4))


def test_run_and_sweep_say_that_planning_was_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(allowance, "MOST_WORK", 0)
    monkeypatch.setattr(allowance, "PER_EDGE", 1)
    made = blueprint(nested(4))

    run = front.run(made, "table")
    assert run.reason == "held"
    assert TOO_MANY in run.sentence
    *edges, _ = front.sweep(made)
    told = {edge.address: edge.sentence for edge in edges if isinstance(edge, EdgeSwept)}
    assert TOO_MANY in told["L0/State_00/a"]
    assert not told["L3/State_00/a"]


def test_all_starts_that_are_tried_have_one_allowance(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(allowance, "MOST_WORK", 0)
    monkeypatch.setattr(allowance, "PER_EDGE", 1)
    searches: list[object] = []
    found = PlanSearch.found

    def noted(search: PlanSearch[Any]) -> object:
        searches.append(search)
        return found(search)

    monkeypatch.setattr(PlanSearch, "found", noted)
    hierarchy = Hierarchy(blueprint(nested(4)))
    start = start_for_edge(hierarchy, Address("L0", "State_00", "a"))
    assert start is not None
    assert start["L0"] == "State_00"
    assert len(searches) < 5
