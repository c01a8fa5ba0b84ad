"""States that cannot be told apart: against a plain bisimulation, and merged."""

from __future__ import annotations

from copy import deepcopy
from itertools import combinations
from random import Random
from typing import Any

import pytest

from smsl_studio.errors import RunRefused
from smsl_studio.front.inputs import read
from smsl_studio.front.shapes import diff_behaviour
from smsl_studio.generate.shapes.chosen import CutRefused
from smsl_studio.generate.shapes.same_states import SameStates, merged, same_states
from tests.dispatch.generated import blueprint_values
from tests.inspection.equivalence.pairs import blueprint
from tests.inspection.explorer.test_onward import SAMPLES

Plain = dict[str, Any]


def with_twins(plain: Plain, chance: Random) -> tuple[Plain, set[str]]:
    """The values with a second state for some states of one SB, with the same facts."""
    found = deepcopy(plain)
    sb = chance.choice(list(found))
    inside = found[sb]
    states = [name for name in inside if name.startswith("S")]
    head = inside["HEADER"]
    chosen = [one for one in states if one != head["ACTIVATING"]][:2]
    made: set[str] = set()
    for state in chosen:
        twin = f"{state}twin"
        inside[twin] = dict(inside[state])
        for other in states:
            for name, target in inside[other].items():
                if target == state and chance.random() < 0.5:
                    inside[other][name] = twin
        made.add(twin)
    notes = inside.setdefault("_states", {})
    for state in [*states, *made]:
        facts = list(state.removesuffix("twin")[1:])
        notes[state] = {**notes.get(state, {}), "facts": facts}
    return found, made


@pytest.mark.parametrize("seed", range(15))
def test_twins_are_found_and_merged_and_nothing_else_changes(seed: int) -> None:
    plain, twins = with_twins(blueprint_values(seed), Random(seed))
    whole = blueprint(plain)
    found = [one for one in same_states(whole) if not one.facts]
    for one in found:
        judged(plain, one)
    grouped = {name for one in found for name in one.states}
    assert twins <= grouped
    refused: list[tuple[str, ...]] = []
    for one in found:
        if one.why_not:
            continue
        try:
            after = merged(whole, one, 20_000)
        except RunRefused:
            continue
        except CutRefused as refusal:
            # Sub-SBs choose among ways of the same cost by their names, and one is gone.
            refused.append(refusal.run)
            continue
        told = diff_behaviour(whole, after)
        assert told.equal, told
        assert len(after[one.branch].table) == len(whole[one.branch].table) - len(one.states) + 1
    assert all(refused)
    assert not refused or len(plain) > 1


def judged(plain: Plain, same: SameStates) -> None:
    """The states of an answer have the same facts, and what leaves them fits."""
    inside = plain[same.branch]
    for a, b in combinations(same.states, 2):
        assert a.removesuffix("twin")[1:] == b.removesuffix("twin")[1:]
        assert inside[a].keys() == inside[b].keys()
        for name in inside[a]:
            one, other = inside[a][name], inside[b][name]
            assert one.removesuffix("twin") == other.removesuffix("twin")


def branch(states: Plain, **more: Any) -> Plain:
    return {"SB": {"HEADER": {"INITIAL": "S_0", "ACTIVATING": "S_2"}, **more, **states}}


STATES: Plain = {
    "S_0": {"go": "S_1"}, "S_1": {"on": "S_2", "other": "S_1b"},
    "S_1b": {"on": "S_2", "other": "S_1"}, "S_2": {"back": "S_1b"},
}  # fmt: skip
NOTES = {f"S_{name}": {"facts": [name[0]]} for name in ("0", "1", "1b", "2")}
FACTS = {"_states": NOTES}


def test_what_led_to_the_second_leads_to_the_first() -> None:
    whole = blueprint(branch(STATES, **FACTS))
    (same,) = same_states(whole)
    assert same == SameStates("SB", ("S_1", "S_1b"))
    after = merged(whole, same, 100)
    assert {name: dict(row) for name, row in after["SB"].table.items()} == {
        "S_0": {"go": "S_1"}, "S_1": {"on": "S_2", "other": "S_1"}, "S_2": {"back": "S_1"}
    }  # fmt: skip


@pytest.mark.parametrize(
    ("more", "why"),
    [
        ({"_operations": {"S_1/on": {"cost": 3}}}, "what is written about on differs"),
        ({"_operations": {"S_1b/on": {"actor": "human"}}}, "what is written about on differs"),
        ({"_states": {**NOTES, "S_1": {"facts": ["1"], "safe": True}}}, "declared safe"),
    ],
)
def test_what_is_written_about_them_is_not_lost(more: Plain, why: str) -> None:
    whole = blueprint(branch(STATES, **{**FACTS, **more}))
    (same,) = same_states(whole)
    assert why in same.why_not
    with pytest.raises(CutRefused, match=why):
        merged(whole, same, 100)


def test_a_property_that_names_one_of_them_keeps_them() -> None:
    values = branch(STATES, **FACTS)
    values["_properties"] = [{"name": "Seen", "reachable": "SB in S_1b"}]
    (same,) = same_states(blueprint(values))
    assert same.why_not == "the property Seen names S_1b"


def test_other_conditions_and_other_facts_tell_them_apart() -> None:
    values = branch(STATES, **{**FACTS, "_operations": {"S_1/on": {"requires": {"SB/0": "1"}}}})
    assert same_states(blueprint(values)) == ()
    other = {**STATES, "S_1b": {"on": "S_2", "other": "S_1", "new": "S_0"}}
    assert same_states(blueprint(branch(other, **FACTS))) == ()


def test_states_that_only_a_sensor_tells_apart_are_shown_and_not_merged() -> None:
    values = {"SB": {
        "HEADER": {"INITIAL": "S_00", "ACTIVATING": "S_11"},
        "_facts": {"0": {"name": "light"}},
        "S_00": {"go": "S_01"}, "S_01": {"on": "S_11", "lamp": "S_02"},
        "S_02": {"on": "S_11", "lamp": "S_01"}, "S_11": {},
    }}  # fmt: skip
    values["SB"]["_facts"] = {"1": {"name": "light"}}
    (same,) = same_states(blueprint(values))
    assert same.states == ("S_01", "S_02")
    assert same.facts == ("light",)
    assert same.why_not == "they mean different things: light differs in them"
    with pytest.raises(CutRefused):
        merged(blueprint(values), same, 100)


@pytest.mark.parametrize("name", ["hanoi-corrected.json", "registration-digitization.json",
                                  "three-levels.json", "hfsm.json"])  # fmt: skip
def test_samples_have_no_states_too_many(name: str) -> None:
    assert [one for one in same_states(read(SAMPLES / name)) if not one.why_not] == []
