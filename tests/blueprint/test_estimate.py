"""The estimated place of an SB equals the result of checking every state, also for unknown
facts."""

from __future__ import annotations

from itertools import product
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.blueprint.check import Reading, Scene, state_check
from smsl_studio.blueprint.estimate import MOST, Estimate, estimate
from tests.plugin_folder import blueprint_of

PEGS: dict[str, Any] = {"HANOI": {f"State_{a}{b}": {} for a, b in product("abc", repeat=2)}}


def _estimate(values: dict[str, Any], branch: str, *read: str | None) -> Estimate:
    readings = {(branch, d): Reading(v, "" if v else "dark") for d, v in enumerate(read)}
    return estimate(blueprint_of(values), branch, Scene(readings), {})


def test_one_state_is_located() -> None:
    found = _estimate(PEGS, "HANOI", "b", "c")
    assert (found.kind, found.states, found.state) == ("located", ("State_bc",), "State_bc")


def test_what_was_never_drawn_is_off_the_map() -> None:
    assert _estimate(PEGS, "HANOI", "b", "h") == Estimate("HANOI", "off the map")
    held = _estimate(PEGS, "HANOI", "h", None)
    assert (held.kind, held.possible, held.state) == ("off the map", (), None)
    assert [term.reason for term in held.unknown] == ["dark"]


def test_unknown_facts_leave_what_is_possible() -> None:
    found = _estimate(PEGS, "HANOI", "b", None)
    assert (found.kind, found.state) == ("unknown", None)
    assert found.possible == ("State_ba", "State_bb", "State_bc")
    assert len(_estimate(PEGS, "HANOI", None, None).possible) == MOST


def test_states_that_look_alike_are_ambiguous() -> None:
    note = {"_states": {name: {"facts": ["1"]} for name in ("Open", "Ajar")}}
    found = _estimate({"DOOR": {**note, "Open": {}, "Ajar": {}}}, "DOOR", "1")
    assert (found.kind, found.states, found.state) == ("ambiguous", ("Open", "Ajar"), None)


def test_an_empty_sb_is_nowhere() -> None:
    assert _estimate({"A": {"HEADER": {}}}, "A").kind == "off the map"


@st.composite
def questions(draw: st.DrawFn) -> tuple[dict[str, Any], Scene, dict[str, str]]:
    """A base SB over an alphabet of its own, perhaps with a sub-SB, and any scene and belief."""
    alphabet = draw(st.sampled_from(["01", "abc", "10x"]))
    names = draw(
        st.lists(st.text(alphabet, min_size=2, max_size=2), min_size=1, max_size=7, unique=True)
    )
    states = [f"State_{name}" for name in names]
    base: dict[str, Any] = {state: {} for state in states}
    values: dict[str, Any] = {"BASE": base, "SUB": {"State_0": {}, "State_1": {}}}
    if draw(st.booleans()):
        base["HEADER"] = {"SUB_SBS": {draw(st.sampled_from(["SUB", "NONE"])): 0}}
    read = st.one_of(st.none(), st.sampled_from(alphabet + "z"))
    scene: dict[tuple[str, int], Reading] = {}
    for key in (("BASE", 0), ("BASE", 1), ("SUB", 0)):
        if draw(st.booleans()):
            value = draw(read)
            scene[key] = Reading(value, "" if value else "dark", sensed=draw(st.booleans()))
    believed = {"BASE": draw(st.sampled_from(states))} if draw(st.booleans()) else {}
    return values, Scene(scene), believed


@given(questions())
def test_it_says_what_every_state_check_says(
    question: tuple[dict[str, Any], Scene, dict[str, str]],
) -> None:
    values, scene, believed = question
    blueprint = blueprint_of(values)
    truths = {
        state: state_check(blueprint, "BASE", state, scene, believed).truth
        for state in blueprint["BASE"].table
    }
    found = estimate(blueprint, "BASE", scene, believed)
    assert found.states == tuple(state for state, truth in truths.items() if truth is True)
    assert found.possible == tuple(state for state, truth in truths.items() if truth is None)
    kind = ("off the map", "located", "ambiguous")[min(len(found.states), 2)]
    assert found.kind == ("unknown" if found.possible else kind)
