"""Facts are added, deleted and moved in the names of all states, and what names them follows."""

from __future__ import annotations

import random
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.smsl.files import read_document
from smsl_studio.smsl.forms import form_named
from tests.blueprint.values import in_form, read
from tests.counts import share_of

SAMPLES = Path(__file__).parents[2] / "samples"
NAMED: dict[str, Any] = {
    "_hazards": [{"name": "both", "facts": {"A/0": "1", "A/1": "0", "B/0": "1"}}],
    "_levels": {"A/1": "human", "A/State_01/up": "shared", "A/up": "human", "A/2": "shared"},
    "A": {
        "HEADER": {"INITIAL": "State_00", "ACTIVATING": "State_11", "NUM_FACTS": 2,
                   "SUB_SBS": [{"B": 1}]},
        "State_00": {"down": "State_01", "stay": "State_00"},
        "State_01": {"up": "State_11"},
        "State_11": {},
        "_facts": {"0": {"name": "clamp"}, "1": {"name": "tool"}, "2": {"name": "left over"}},
        "_states": {"State_01": {"title": "half"}, "State_110": {"title": "long gone"}},
        "_operations": {"State_01/up": {"cost": 2},
                        "up": {"requires": {"A/1": "1"}, "touches": [1]}},
        "_layout": {"State_00": [0, 0]},
    },
    "B": {"T0": {"go": "T1"}, "T1": {}, "_operations": {"go": {"requires": {"A/0": "1"}}}},
}  # fmt: skip


def test_a_fact_is_added_to_every_name_and_all_that_names_a_state_follows() -> None:
    after = edit.add_fact(read(NAMED), "A")
    branch = after["A"]
    assert list(branch.table) == ["State_000", "State_010", "State_110"]
    assert branch.table["State_000"] == {"down": "State_010", "stay": "State_000"}
    header = branch.header
    assert (header.initial, header.activating, header.num_facts) == ("State_000", "State_110", 3)
    assert header.sub_sbs == (("B", 1),)
    assert branch.fields["_facts"] == {"0": {"name": "clamp"}, "1": {"name": "tool"}}
    assert branch.fields["_states"] == {"State_010": {"title": "half"}}
    assert branch.fields["_layout"] == {"State_000": [0, 0]}
    assert branch.fields["_operations"]["State_010/up"] == {"cost": 2}
    assert after.levels == {"A/1": "human", "A/State_010/up": "shared", "A/up": "human"}


def test_a_fact_is_moved_with_all_that_names_its_digit() -> None:
    after = edit.move_fact(read(NAMED), "A", 0, 1)
    branch = after["A"]
    assert list(branch.table) == ["State_00", "State_10", "State_11"]
    assert branch.subs == {0: "B"}
    assert [branch.fact_name(digit) for digit in range(2)] == ["tool", "clamp"]
    assert branch.fields["_operations"]["up"] == {"requires": {"A/0": "1"}, "touches": [0]}
    assert after["B"].fields["_operations"]["go"]["requires"] == {"A/1": "1"}
    assert after.hazards[0].facts == {"A/1": "1", "A/0": "0", "B/0": "1"}
    assert after.levels["A/0"] == "human"
    assert after.levels["A/State_10/up"] == "shared"


def test_a_fact_that_something_names_is_not_deleted() -> None:
    before = read(NAMED)
    with pytest.raises(EditRefused, match="B expands digit 1"):
        edit.delete_fact(before, "A", 1)
    with pytest.raises(EditRefused, match="the hazard 'both' names the fact A/0"):
        edit.delete_fact(before, "A", 0)
    with pytest.raises(EditRefused, match="go of B names the fact A/0"):
        edit.delete_fact(edit.set_hazards(before, []), "A", 0)
    with pytest.raises(EditRefused, match="it has no digit 2"):
        edit.delete_fact(before, "A", 2)


def test_states_that_would_be_the_same_are_named() -> None:
    before = read({"A": {"State_00": {}, "State_01": {"up": "State_00"}}})
    with pytest.raises(EditRefused, match="State_00 and State_01 would have the same facts"):
        edit.delete_fact(before, "A", 1)
    after = edit.delete_fact(before, "A", 0)
    assert after["A"].table == {"State_0": {}, "State_1": {"up": "State_0"}}
    with pytest.raises(EditRefused, match="would have the same facts"):
        edit.delete_fact(after, "A", 0)
    with pytest.raises(EditRefused, match="could not be cut into 0 facts"):
        edit.delete_fact(read({"A": {"State_1": {}}}), "A", 0)


def test_facts_come_before_states_or_beside_names_without_facts() -> None:
    first = edit.add_fact(read({"A": {}}), "A")
    assert first["A"].header.num_facts == 1
    assert edit.add_fact(first, "A")["A"].header.num_facts == 2
    assert edit.delete_fact(first, "A", 0)["A"].header.num_facts is None
    plain = read({"A": {"Idle": {"go": "Ready"}, "Ready": {}}})
    noted = edit.add_fact(plain, "A", "off")
    assert noted["A"].table == plain["A"].table
    assert noted["A"].facts("Ready") == ("off",)
    two = edit.move_fact(edit.add_fact(noted, "A", "on"), "A", 1, 0)
    assert two["A"].facts("Idle") == ("on", "off")
    bare = edit.delete_fact(edit.delete_fact(two, "A", 1), "A", 0)
    assert bare.document.text == plain.document.text


def test_a_value_must_have_the_width_of_the_others() -> None:
    wide = {"A": {"HEADER": {"NUM_FACTS": 1}, "State_aa": {}, "State_bb": {}}}
    assert list(edit.add_fact(read(wide), "A")["A"].table) == ["State_aa00", "State_bb00"]
    with pytest.raises(EditRefused, match="could not be cut into 2 facts"):
        edit.add_fact(read(wide), "A", "1")
    odd = read({"A": {"HEADER": {"NUM_FACTS": 2}, "State_00": {}, "State_1": {}}})
    with pytest.raises(EditRefused, match="'State_1' cannot be cut"):
        edit.add_fact(odd, "A")


@pytest.mark.parametrize("form", ["json", "smsl", "yaml"])
@pytest.mark.parametrize("name", ["hanoi", "registration", "three-levels", "hfsm"])
def test_a_fact_added_and_deleted_leaves_the_same_bytes(name: str, form: str) -> None:
    before = in_form(read_blueprint(read_document(SAMPLES / f"{name}.json")), form)
    for branch in before:
        after = edit.add_fact(before, branch.name)
        assert after[branch.name].num_facts == branch.num_facts + 1
        back = edit.delete_fact(after, branch.name, branch.num_facts)
        assert back == before
        assert back.document.text == before.document.text


@settings(max_examples=share_of(60), deadline=None)
@given(st.sampled_from(["json", "smsl", "yaml"]), st.integers(0, 10**6))
def test_moves_change_nothing_but_the_order_and_come_back(form: str, seed: int) -> None:
    chance = random.Random(seed)
    before = in_form(read({**NAMED, "C": values_of(chance)}), form)
    blueprint, order = before, list(range(3))
    for _ in range(chance.randrange(1, 4)):
        digit, place = chance.randrange(3), chance.randrange(3)
        blueprint = edit.move_fact(blueprint, "C", digit, place)
        order.insert(place, order.pop(digit))
    again = read_blueprint(form_named(form).parse(blueprint.document.text, f"f.{form}"))
    assert again == blueprint
    shown = before["C"]
    moved = {s: "State_" + "".join(shown.facts(s)[digit] for digit in order) for s in shown.table}
    edges = [(moved[e.source], e.name, moved[e.target]) for e in shown.edges()]
    assert [(e.source, e.name, e.target) for e in blueprint["C"].edges()] == edges
    for place in range(3):
        now = order.index(place)
        blueprint = edit.move_fact(blueprint, "C", now, place)
        order.insert(place, order.pop(now))
    assert blueprint == before


def values_of(chance: random.Random) -> dict[str, Any]:
    """An SB with three facts and any of its edges."""
    names = [f"State_{a}{b}{c}" for a in "01" for b in "ab" for c in "xyz"]
    chosen = chance.sample(names, 6)
    return {
        "HEADER": {"INITIAL": chosen[2], "NUM_FACTS": 3},
        **{state: {f"to {n}": chance.choice(chosen) for n in range(2)} for state in chosen},
        "_facts": {"1": {"name": "one", "values": {"a": "left"}}},
        "_states": {chosen[0]: {"title": "t"}},
    }
