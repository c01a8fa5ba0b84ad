"""Clauses 1 to 3: sub digits, classes of edges, and where a run starts."""

from __future__ import annotations

from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import Reading, Scene, state_check
from smsl_studio.blueprint.configuration import Hierarchy, disagreements, start_configuration
from smsl_studio.blueprint.edges import EdgeKind, Edges
from smsl_studio.errors import RunRefused
from tests.dispatch.runs import blueprint, branch, sample

SUB = branch({"0": "go>1", "1": "back>0"})


def based(states: dict[str, str], **more: Any) -> Any:
    return blueprint({"BASE": branch(states, subs={"SUB": 1}, **more), "SUB": SUB})


@pytest.mark.parametrize(
    ("note", "states", "on"),
    [
        ({}, {"a0": "", "a1": ""}, "1"),
        ({}, {"an": "", "ay": ""}, "y"),
        ({"facts": {"1": {"on": "n"}}}, {"an": "", "ay": ""}, "n"),
    ],
    ids=["one of 0 and 1", "as in ACTIVATING", "as _facts says"],
)
def test_clause_1_which_value_is_on(note: Any, states: dict[str, str], on: str) -> None:
    assert based(states, **note)["BASE"].on_value(1) == on


@pytest.mark.parametrize(
    ("source", "target", "kind", "function"),
    [
        ("000", "100", EdgeKind.PURE, True),
        ("000", "000", EdgeKind.PURE, True),
        ("000", "010", EdgeKind.RISE, False),
        ("011", "001", EdgeKind.FALL, False),
        ("000", "110", EdgeKind.MIXED, True),
        ("010", "001", EdgeKind.MIXED, True),
    ],
)
def test_clause_2_edges_are_classed_by_their_effect_on_sub_digits(
    source: str, target: str, kind: EdgeKind, function: bool
) -> None:
    edges = dict.fromkeys(("000", "010", "011", "001", "100", "110"), "")
    made = based({**edges, source: f"go>{target}"})
    edge = Edges(Hierarchy(made)).get(Address("BASE", f"State{source}", "go"))
    assert edge is not None
    assert (edge.kind, edge.function) == (kind, function)


def test_clause_2_several_sub_digits_alone_need_no_function_either() -> None:
    made = blueprint(
        {
            "BASE": branch({"00": "go>11", "11": ""}, subs={"SUB": 0, "TOO": 1}),
            "SUB": SUB,
            "TOO": SUB,
        }
    )
    edge = Edges(Hierarchy(made)).get(Address("BASE", "State00", "go"))
    assert edge is not None
    assert (edge.kind, edge.function, edge.rises) == (EdgeKind.MIXED, False, (0, 1))


def test_clause_3_bases_first_each_sub_where_its_digit_is() -> None:
    hierarchy = Hierarchy(sample("three-levels"))
    assert start_configuration(hierarchy, {}) == {
        "SURGERY": "State000",
        "REGISTRATION": "State000",
        "DIGITIZATION": "State00",
    }
    later = start_configuration(hierarchy, {"SURGERY": "State110"})
    assert later == {
        "SURGERY": "State110",
        "REGISTRATION": "State111",
        "DIGITIZATION": "State11",
    }
    assert disagreements(hierarchy, later) == ()


def test_clause_3_a_sub_may_start_elsewhere_if_its_base_agrees() -> None:
    hierarchy = Hierarchy(sample("three-levels"))
    given = {"SURGERY": "State100", "DIGITIZATION": "State10"}
    assert start_configuration(hierarchy, given)["DIGITIZATION"] == "State10"
    with pytest.raises(RunRefused, match="DIGITIZATION/State11 disagrees with REGISTRATION"):
        start_configuration(hierarchy, {"DIGITIZATION": "State11"})


def test_clause_3_bases_must_agree_about_a_shared_sub() -> None:
    made = blueprint(
        {
            "ONE": branch({"0": "", "1": ""}, subs={"SUB": 0}),
            "TWO": branch({"0": "", "1": ""}, subs={"SUB": 0}),
            "SUB": SUB,
        }
    )
    with pytest.raises(RunRefused, match="bases of SUB disagree"):
        start_configuration(Hierarchy(made), {"ONE": "State1"})


def test_clause_3_a_sub_that_starts_in_activating_refuses() -> None:
    made = blueprint(
        {
            "BASE": branch({"0": "", "1": ""}, subs={"SUB": 0}),
            "SUB": branch({"0": "", "1": ""}, initial="1", activating="1"),
        }
    )
    with pytest.raises(RunRefused, match="INITIAL is its ACTIVATING"):
        start_configuration(Hierarchy(made), {})


def test_a_circle_of_subs_is_refused_with_its_names() -> None:
    made = blueprint(
        {
            "ONE": branch({"0": "", "1": ""}, subs={"TWO": 0}),
            "TWO": branch({"0": "", "1": ""}, subs={"ONE": 0}),
        }
    )
    with pytest.raises(RunRefused, match="circle: ONE, TWO"):
        Hierarchy(made)


@pytest.mark.parametrize(
    ("digitized", "wanted", "truth"),
    [
        (("1", "1"), "State110", True),
        (("1", "0"), "State110", False),
        (("1", None), "State110", None),
        (("0", None), "State110", False),
        (("1", "1"), "State100", False),
        (("1", "0"), "State100", True),
        (("1", None), "State100", None),
        (("0", None), "State100", True),
    ],
)
def test_a_sub_digit_is_the_subs_activating_check_or_its_negation(
    digitized: tuple[str, str | None], wanted: str, truth: bool | None
) -> None:
    """Three-valued and recursive: false and unknown is false, its negation true."""
    readings = {
        ("REGISTRATION", 0): Reading("1"),
        ("REGISTRATION", 2): Reading("0"),
        ("DIGITIZATION", 0): Reading(digitized[0]),
        ("DIGITIZATION", 1): Reading(digitized[1], "no reading for 1.2 s"),
    }
    check = state_check(sample("three-levels"), "REGISTRATION", wanted, Scene(readings), {})
    assert check.truth is truth
    assert [term.truth for term in check.terms] == [True, truth, True]


def test_clause_13_what_nobody_senses_is_believed_and_what_is_unknown_is_never_true() -> None:
    made = sample("hanoi")
    readings = {("SB1", 0): Reading("a"), ("SB1", 1): Reading(None, "no reading for 1.2 s")}
    check = state_check(made, "SB1", "State_aaa", Scene(readings), {"SB1": "State_aab"})
    assert [term.truth for term in check.terms] == [True, None, False]
    believed = state_check(made, "SB1", "State_aab", Scene(readings), {"SB1": "State_aab"})
    assert believed.truth is None
    assert believed.unknown[0].reason == "no reading for 1.2 s"
