"""A value of a fact gets another name, or a state another value; all that names them follows."""

from __future__ import annotations

import random
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.smsl.forms import form_named
from tests.blueprint.values import in_form, read
from tests.counts import share_of

VALUED: dict[str, Any] = {
    "_hazards": [{"name": "both", "facts": {"A/0": "0", "A/1": "1", "B/0": "1"}}],
    "_levels": {"A/1": "human", "A/State_01/up": "shared", "A/State_x1/up": "human"},
    "A": {
        "HEADER": {"INITIAL": "State_00", "ACTIVATING": "State_11", "NUM_FACTS": 2,
                   "SUB_SBS": {"B": 1}},
        "State_00": {"down": "State_01", "stay": "State_00"},
        "State_01": {"up": "State_11"},
        "State_11": {},
        "_facts": {"0": {"values": {"0": "open", "1": "fixed"}, "failure": ["0"]}},
        "_states": {"State_01": {"title": "half"}},
        "_operations": {"State_01/up": {"cost": 2}, "up": {"requires": {"A/0": "0", "A/1": "1"}}},
        "_layout": {"State_00": [0, 0]},
    },
    "B": {"T0": {"go": "T1"}, "T1": {}, "_operations": {"go": {"requires": {"A/0": "1"}}}},
}  # fmt: skip
BESIDE: dict[str, Any] = {
    "A": {"Idle": {"go": "Ready"}, "Ready": {},
          "_states": {"Idle": {"facts": ["no"], "title": "rest"}, "Ready": {"facts": ["yes"]}}},
}  # fmt: skip


def test_a_renamed_value_is_followed_by_all_that_names_it() -> None:
    after = edit.rename_value(read(VALUED), "A", 0, "0", "x")
    branch = after["A"]
    assert branch.table == {
        "State_x0": {"down": "State_x1", "stay": "State_x0"},
        "State_x1": {"up": "State_11"},
        "State_11": {},
    }
    assert (branch.header.initial, branch.header.activating) == ("State_x0", "State_11")
    fact = branch.fields["_facts"]["0"]
    assert fact == {"values": {"x": "open", "1": "fixed"}, "failure": ["x"]}
    assert branch.fields["_states"] == {"State_x1": {"title": "half"}}
    assert branch.fields["_layout"] == {"State_x0": [0, 0]}
    assert branch.fields["_operations"] == {
        "State_x1/up": {"cost": 2}, "up": {"requires": {"A/0": "x", "A/1": "1"}}
    }  # fmt: skip
    assert after["B"].fields["_operations"]["go"]["requires"] == {"A/0": "1"}
    assert after.hazards[0].facts == {"A/0": "x", "A/1": "1", "B/0": "1"}
    assert after.levels == {"A/1": "human", "A/State_x1/up": "shared"}


@pytest.mark.parametrize(("old", "new", "on"), [("1", "x", "x"), ("0", "x", "1")])
def test_the_same_states_count_as_on_after_a_value_was_renamed(old: str, new: str, on: str) -> None:
    last_is_off = {"A": {"State_1": {"off": "State_0"}, "State_0": {}}}
    before = read(last_is_off)
    after = edit.rename_value(before, "A", 0, old, new)
    assert after["A"].on_value(0) == on
    assert after["A"].fields["_facts"] == {"0": {"on": on}}
    plain = edit.rename_value(read(VALUED), "A", 0, "1", "x")
    assert "on" not in plain["A"].fields["_facts"]["0"], "what holds by default is not written"


def test_names_without_facts_keep_and_the_values_beside_them_change() -> None:
    before = read(BESIDE)
    after = edit.rename_value(before, "A", 0, "no", "not yet")
    assert after["A"].table == before["A"].table
    assert after["A"].facts("Idle") == ("not yet",)
    assert after["A"].fields["_states"]["Idle"]["title"] == "rest"
    one = edit.set_value(before, "A", ["Ready"], 0, "done")
    assert one["A"].facts("Ready") == ("done",)
    with pytest.raises(EditRefused, match="Idle has these facts already"):
        edit.set_value(before, "A", ["Ready"], 0, "no")


def test_a_state_gets_another_value_and_its_name_follows() -> None:
    after = edit.set_value(read(VALUED), "A", ["State_01"], 1, "2")
    assert list(after["A"].table) == ["State_00", "State_02", "State_11"]
    assert after["A"].table["State_00"]["down"] == "State_02"
    assert after.levels == {
        "A/1": "human", "A/State_02/up": "shared", "A/State_x1/up": "human"
    }  # fmt: skip
    both = edit.set_value(read(VALUED), "A", ["State_00", "State_01"], 0, "2")
    assert list(both["A"].table) == ["State_20", "State_21", "State_11"]
    same = read(VALUED)
    assert edit.set_value(same, "A", ["State_00"], 0, "0") is same


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("0", "1", "has the value '1' already, in State_11"),
        ("7", "8", "has no value '7'"),
        ("0", "", "needs a visible character"),
        ("0", "\u202e", "needs a visible character"),
        ("0", "ab", "has one character, and 'ab' has 2"),
    ],
)
def test_a_value_that_does_not_fit_is_refused(old: str, new: str, words: str) -> None:
    with pytest.raises(EditRefused, match=words):
        edit.rename_value(read(VALUED), "A", 0, old, new)


def test_a_fact_that_is_not_there_and_names_without_facts_are_refused() -> None:
    before = read(VALUED)
    with pytest.raises(EditRefused, match="it has no digit 2"):
        edit.rename_value(before, "A", 2, "0", "x")
    with pytest.raises(EditRefused, match="it has no digit -1"):
        edit.set_value(before, "A", ["State_00"], -1, "x")
    with pytest.raises(EditRefused, match="no state 'State_99'"):
        edit.set_value(before, "A", ["State_99"], 0, "x")
    odd = read({"A": {"Idle": {}, "Ready": {}}})
    with pytest.raises(EditRefused, match="carry no facts"):
        edit.rename_value(odd, "A", 0, "Idle", "x")
    off_by_default = read({"A": {"State_0": {}}})
    with pytest.raises(EditRefused, match="has the value '1' already"):
        edit.rename_value(off_by_default, "A", 0, "0", "1")


def test_states_that_would_be_the_same_are_named() -> None:
    before = read(VALUED)
    with pytest.raises(EditRefused, match="State_11 has these facts already"):
        edit.set_value(before, "A", ["State_01"], 0, "1")
    with pytest.raises(EditRefused, match="State_00 and State_01 would have the same facts"):
        edit.set_value(before, "A", ["State_00", "State_01"], 1, "2")


def some_values(chance: random.Random) -> dict[str, Any]:
    """An SB of some states with three facts, and annotations of some of them."""
    names = ["State_" + "".join(chance.choices("abc", k=3)) for _ in range(chance.randrange(1, 9))]
    branch: dict[str, Any] = {"HEADER": {"NUM_FACTS": 3}} if chance.random() < 0.5 else {}
    for name in dict.fromkeys(names):
        branch[name] = {f"Op_{n}": chance.choice(names) for n in range(chance.randrange(3))}
    some = chance.choice(names)
    branch["_facts"] = {"0": {"values": {"a": "first"}, "on": chance.choice("abc")},
                        "1": {"failure": ["b", "c"]}}  # fmt: skip
    branch["_operations"] = {"Op_0": {"requires": {"A/0": "a", "A/1": "b"}}}
    branch["_layout"] = {some: [8, 8]}
    hazards = [{"name": "h", "facts": {"A/0": "b", "A/2": "c"}}]
    return {"_hazards": hazards, "_levels": {f"A/{some}/Op_0": "human"}, "A": branch}


@settings(max_examples=share_of(120), deadline=None)
@given(st.sampled_from(["json", "smsl", "yaml"]), st.integers(0, 10**6))
def test_a_value_renamed_there_and_back_leaves_the_same_bytes(form: str, seed: int) -> None:
    chance = random.Random(seed)
    before = in_form(read(some_values(chance)), form)
    digit, old = chance.randrange(3), chance.choice("abc")
    try:
        after = edit.rename_value(before, "A", digit, old, "x")
    except EditRefused:
        return
    again = read_blueprint(form_named(form).parse(after.document.text, f"f.{form}"))
    assert again == after
    states = list(zip(before["A"].table, after["A"].table, strict=True))
    assert all(before["A"].is_on(one, digit) == after["A"].is_on(two, digit)
               for one, two in states)  # fmt: skip
    back = edit.rename_value(after, "A", digit, "x", old)
    assert back == before
    if ("on" in entry(before, digit)) == ("on" in entry(after, digit)):
        assert back.document.text == before.document.text


def entry(blueprint: Blueprint, digit: int) -> dict[str, Any]:
    """What ``_facts`` says of a digit."""
    found: dict[str, Any] = blueprint["A"].fields["_facts"].get(str(digit), {})
    return found


@settings(max_examples=share_of(120), deadline=None)
@given(st.sampled_from(["json", "smsl", "yaml"]), st.integers(0, 10**6))
def test_a_value_set_and_set_back_leaves_the_same_bytes(form: str, seed: int) -> None:
    chance = random.Random(seed)
    before = in_form(read(some_values(chance)), form)
    place = chance.randrange(len(before["A"].table))
    digit, state = chance.randrange(3), list(before["A"].table)[place]
    value, facts = chance.choice("abcx"), before["A"].facts(state)
    wanted = (*facts[:digit], value, *facts[digit + 1 :])
    if any(before["A"].facts(other) == wanted for other in before["A"].table if other != state):
        with pytest.raises(EditRefused, match="has these facts already"):
            edit.set_value(before, "A", [state], digit, value)
        return
    after = edit.set_value(before, "A", [state], digit, value)
    now = list(after["A"].table)[place]
    others = [name for name in before["A"].table if name != state]
    assert [name for name in after["A"].table if name != now] == others
    back = edit.set_value(after, "A", [now], digit, facts[digit])
    assert back.document.text == before.document.text
