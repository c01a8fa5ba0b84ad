"""The course of a run: vetoes, changed costs, what-if questions, and why there is no route."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.dispatch.route.course import Course
from smsl_studio.errors import UsageError
from smsl_studio.host.local import LocalHost
from tests.dispatch.runs import blueprint, branch, goals

LADDER = branch({"a": "up>b, over>c", "b": "up>d", "c": "up>d, skip>e", "d": "up>e", "e": ""})
HERE = {"SB1": "Statea"}


def course(values: Any = LADDER, shut: Mapping[str, str] | None = None, *to: str) -> Course:
    made = blueprint(values if "HEADER" not in values else {"SB1": values})
    host = LocalHost(made, "table")
    opened = host.open({name: branch.initial for name, branch in made.branches.items()})
    closed = {made.resolve(text): reason for text, reason in (shut or {}).items()}
    return Course(Hierarchy(made), goals(made, *(to or ("SB1/Statee",))), opened.bound, closed)


def at(text: str) -> Address:
    state, _, operation = text.partition("/")
    return Address("SB1", f"State{state}", operation)


def way(of: Course, here: Mapping[str, str] = HERE) -> list[str]:
    step, _ = of.next_step(here)
    return [str(edge.address) for edge in step.edges] + [*map(str, of.ahead)] if step else []


def test_a_vetoed_edge_is_skipped_until_the_run_stands_elsewhere() -> None:
    run = course()
    assert way(run) == ["SB1/Statea/over", "SB1/Statec/skip"]
    run.veto(at("a/over"), HERE)
    assert way(run) == ["SB1/Statea/up", "SB1/Stateb/up", "SB1/Stated/up"]
    run.next_step({"SB1": "Stateb"})
    assert not run.vetoed
    assert way(run) == ["SB1/Statea/over", "SB1/Statec/skip"]


def test_a_person_may_ask_for_a_vetoed_edge() -> None:
    run = course()
    run.veto(at("a/over"), HERE)
    edge = run.edge(at("a/over"))
    assert edge is not None
    assert run.asked(HERE, edge) == course().asked(HERE, edge)


def test_a_cost_that_is_said_changes_the_way_at_once() -> None:
    run = course()
    way(run)
    assert run.set_cost(at("c/skip"), 4) == {at("c/skip"): 4.0}
    assert way(run) == ["SB1/Statea/over", "SB1/Statec/up", "SB1/Stated/up"]
    assert run.set_cost(at("c/skip"), 1) == {at("c/skip"): 1.0}
    assert len(way(run)) == 2
    assert run.set_cost(at("c/skip"), 1) == {}


def test_what_a_person_says_wins_over_a_cost_function() -> None:
    run = course()
    run.set_cost(at("c/skip"), 9)
    assert run.adapt({at("c/skip"): 0.5, at("c/up"): 2}) == {at("c/up"): 2.0}
    assert run.prices.of(at("c/skip")) == 9
    assert run.adapt({at("c/up"): None}) == {at("c/up"): 1.0}


@pytest.mark.parametrize("cost", [-1, float("nan"), float("inf"), 2e12, True])
def test_what_is_no_cost_is_refused(cost: float) -> None:
    with pytest.raises(UsageError, match="is no cost of SB1/Statea/up"):
        course().set_cost(at("a/up"), cost)


def test_a_detour_is_the_way_if_an_edge_were_vetoed() -> None:
    run = course()
    assert run.detour(HERE, at("a/over")) == (at("a/up"), at("b/up"), at("d/up"))
    run.prune(at("a/up"), "worn")
    assert run.detour(HERE, at("a/over")) is None
    assert len(way(run)) == 2


def test_what_blocks_are_the_fewest_edges_that_would_open_a_way() -> None:
    run = course(LADDER, {"SB1/Stateb/up": "avoided", "SB1/Statec/skip": "avoided"})
    run.tag_risky(at("c/up"), "it slipped")
    assert way(run) == []
    assert run.blocking(HERE) == {at("c/skip"): "avoided"}
    run.prune(at("a/over"), "no")
    assert run.blocking(HERE) == {at("b/up"): "avoided"}


def test_a_failure_state_in_the_way_is_named() -> None:
    run = course(branch({"a": "drop>x", "x": "lift>e", "e": ""}, facts={"0": {"failure": ["x"]}}))
    words = "it leads into a failure: Fact 1 would be x"
    assert run.blocking(HERE) == {at("a/drop"): words}


def test_nothing_blocks_where_there_is_a_way_or_none_is_drawn() -> None:
    assert course().blocking(HERE) == {}
    island = course(branch({"a": "loop>a", "e": ""}))
    assert island.blocking(HERE) == {}


def test_what_blocks_a_sub_blocks_its_base() -> None:
    values = {
        "SB1": branch({"0": "on>1", "1": ""}, subs={"SB2": 0}),
        "SB2": branch({"0": "up>1", "1": ""}),
    }
    run = course(values, {"SB2/State0/up": "avoided"}, "SB1/State1")
    here = {"SB1": "State0", "SB2": "State0"}
    assert run.next_step(here) == (None, None)
    assert run.blocking(here) == {Address("SB2", "State0", "up"): "avoided"}
