"""Copy, cut, paste and duplicate as SMSL text; pasted elements get free names."""

from __future__ import annotations

import random
from collections.abc import Iterable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.writing import new_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.generate.rules import hanoi
from smsl_studio.inspection.inspect import inspect
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.forms import form_named
from smsl_studio.smsl.json_form import parse_json, write_json
from tests.counts import share_of
from tests.smsl.texts import texts


def read(**branches: object) -> Blueprint:
    return read_blueprint(parse_json(write_json(branches), "f.json"))


def at(*texts: str) -> list[Address]:
    return [Address(*Address.split(text)) for text in texts]


def again(blueprint: Blueprint) -> Blueprint:
    """The blueprint as its text reads."""
    return read_blueprint(parse_json(blueprint.document.text, "f.json"))


def native(text: str) -> Document:
    return form_named("smsl").parse(text, "x.smsl")


NOTED: dict[str, Any] = {
    "HEADER": {"NUM_FACTS": 2, "INITIAL": "State_00", "NUM_STATES": 3},
    "State_00": {"up": "State_10", "out": "State_11", "_why": "first"},
    "State_10": {"up": "State_00"},
    "State_11": {"back": "State_00"},
    "_states": {"State_10": {"title": "half"}, "State_11": {"title": "done"}},
    "_operations": {
        "up": {"cost": 2},
        "State_10/up": {"risk": "low", "requires": {"A/0": "1"}},
        "back": {"cost": 3},
    },
    "_layout": {"State_00": [0, 0], "State_10": [100, 50]},
}


def test_states_are_copied_with_what_is_among_them() -> None:
    text = edit.excerpt(read(A=NOTED), at("A/State_10", "A/State_00"))
    assert text == (
        "{\n"
        "    # NAME: A\n"
        "    # NUM_FACTS: 2\n"
        '    # _copied: "states"\n'
        "\n"
        "    State_00: [\n"
        "        up -> State_10\n"
        '        # _why: "first"\n'
        "    ],\n"
        "    State_10: [up -> State_00]\n"
        '    # _states: {"State_10": {"title": "half"}}\n'
        '    # _operations: {"up": {"cost": 2}, '
        '"State_10/up": {"risk": "low", "requires": {"A/0": "1"}}}\n'
        '    # _layout: {"State_00": [0, 0], "State_10": [100, 50]}\n'
        "}\n"
    )
    copied = read_blueprint(native(text))
    assert inspect(copied, ["R01", "R02", "R03", "R05", "R29"]) == ()


def test_copied_states_come_under_free_names_and_all_follows() -> None:
    blueprint = read(A=NOTED)
    text = edit.excerpt(blueprint, at("A/State_00", "A/State_10"))
    after, made = edit.paste(blueprint, "A", text, (200, 100))
    assert [str(address) for address in made] == ["A/State_01", "A/State_02"]
    branch = after["A"]
    assert branch.num_facts == 2
    assert branch.header.num_states == 5
    assert branch.table["State_01"] == {"up": "State_02"}
    assert branch.table["State_02"] == {"up": "State_01"}
    assert branch.state_fields["State_01"] == {"_why": "first"}
    assert branch.fields["_states"]["State_02"] == {"title": "half"}
    assert branch.operation_note("State_01", "up").cost == 2
    assert branch.fields["_operations"]["State_02/up"] == NOTED["_operations"]["State_10/up"]
    assert branch.notes.layout["State_01"] == (150, 75)
    assert branch.notes.layout["State_02"] == (250, 125)
    assert again(after) == after
    back = edit.delete(after, made)
    assert back == blueprint
    # The copy that was last was activating, so ACTIVATING says now which state follows it.
    assert back["A"].header.activating == "State_11"
    back = edit.set_header(back, "A", "ACTIVATING", None)
    assert back.document.text == blueprint.document.text


def test_free_names_are_those_of_the_field() -> None:
    digits = read(A={f"State_{n}": {} for n in range(6)})
    text = edit.excerpt(digits, at("A/State_5", "A/State_2"))
    _, made = edit.paste(digits, "A", text)
    assert [address.state for address in made] == ["State_6", "State_7"]
    binary = read(A={"State_000": {}, "State_100": {}, "State_111": {}})
    _, made = edit.duplicate(binary, at("A/State_000", "A/State_111"))
    assert [address.state for address in made] == ["State_001", "State_010"]
    other = read(B={"State_00": {}, "State_01": {}})
    text = edit.excerpt(binary, at("A/State_100", "A/State_111"))
    _, made = edit.paste(other, "B", text)
    assert [address.state for address in made] == ["State_10", "State_11"], "they fit their facts"
    _, made = edit.paste(edit.add_branch(new_blueprint(), "B"), "B", text)
    assert [address.state for address in made] == ["State_100", "State_111"]
    same = read(A={"State00": {}, "State_01": {}})
    _, made = edit.paste(same, "A", edit.excerpt(read(B={"State_00": {}}), at("B/State_00")))
    assert [address.state for address in made] == ["State_10"], "00 is there, by another name"
    words = read(A={"Idle": {}, "Idle2": {}, "Moving": {"a": "Idle"}, "S09": {}})
    after, made = edit.duplicate(words, at("A/Idle", "A/Moving", "A/S09"))
    assert [address.state for address in made] == ["Idle3", "Moving2", "S10"]
    assert after["A"].table["Moving2"] == {"a": "Idle3"}


def test_what_is_said_of_all_operations_of_a_name_falls_on_no_others() -> None:
    text = edit.excerpt(read(A=NOTED), at("A/State_00", "A/State_10"))
    other = read(B={"State_00": {"up": "State_00"}, "_operations": {"up": {"cost": 9}}})
    after, _ = edit.paste(other, "B", text)
    branch = after["B"]
    assert branch.cost("State_00", "up") == 9
    assert [branch.cost(state, "up") for state in ("State_01", "State_10")] == [2, 2]
    new = edit.paste(edit.add_branch(new_blueprint(), "C"), "C", text)[0]
    assert new["C"].fields["_operations"] == native(text).values["A"]["_operations"]


def test_operations_are_copied_on_their_own() -> None:
    blueprint = read(A=NOTED)
    text = edit.excerpt(blueprint, at("A/State_10/up", "A/State_11/back"))
    assert "State_10: [up -> State_00]" in text
    assert "State_11: [back -> State_00]" in text
    after, made = edit.paste(blueprint, "A", text)
    assert [str(address) for address in made] == ["A/State_10/up2", "A/State_11/back2"]
    assert after["A"].table["State_10"] == {"up": "State_00", "up2": "State_00"}
    note = after["A"].operation_note("State_10", "up2")
    assert (note.cost, note.risk) == (2, "low")
    assert after["A"].cost("State_11", "back2") == 3
    assert edit.delete(after, made) == blueprint
    gone = edit.delete(blueprint, made_of(blueprint, "A/State_11"))
    with pytest.raises(EditRefused, match="there is no state 'State_11' in A"):
        edit.paste(gone, "A", text)
    _, made = edit.paste(edit.delete(blueprint, at("A/State_10/up")), "A", text)
    assert [address.operation for address in made] == ["up", "back2"]


def made_of(blueprint: Blueprint, text: str) -> list[Address]:
    return [blueprint.resolve(text)]


def test_whole_sbs_are_copied_and_their_sub_sbs_follow() -> None:
    base = {
        "HEADER": {"SUB_SBS": [{"SUB": 0}, {"ELSE": 1}]},
        "State00": {"o": "State11"},
        "State11": {},
        "_operations": {"o": {"requires": {"SUB/0": "1", "ELSE/0": "1"}}},
    }
    states = {"State0": {"o": "State1"}, "State1": {}}
    blueprint = read(BASE=base, SUB=states, ELSE=states, SUB2={})
    after, made = edit.duplicate(blueprint, at("BASE", "SUB"))
    assert [address.branch for address in made] == ["BASE2", "SUB3"]
    assert after["BASE2"].header.sub_sbs == (("SUB3", 0), ("ELSE", 1))
    assert after["BASE2"].operation_note("State00", "o").requires == {"SUB3/0": "1", "ELSE/0": "1"}
    assert after["SUB3"].table == states
    assert again(after) == after
    assert edit.delete(after, made) == blueprint
    text = edit.excerpt(blueprint, at("BASE", "SUB", "SUB/State0"))
    fresh, made = edit.paste(edit.add_branch(new_blueprint(), "X"), "X", text)
    assert list(fresh.branches) == ["X", "BASE", "SUB"]
    assert [fresh[name] == blueprint[name] for name in ("BASE", "SUB")] == [True, True]


def test_places_without_overlap() -> None:
    blueprint = read(A=NOTED)
    text = edit.excerpt(blueprint, at("A/State_10"))
    once, (first,) = edit.paste(blueprint, "A", text)
    twice, (second,) = edit.paste(once, "A", text)
    places = twice["A"].notes.layout
    assert places[first.state] == (132, 82)
    assert places[second.state] == (164, 114)
    moved, (third,) = edit.duplicate(blueprint, at("A/State_10"), (1, -2))
    assert moved["A"].notes.layout[third.state] == (101, 48)
    bare = edit.excerpt(blueprint, at("A/State_11"))
    assert edit.paste(blueprint, "A", bare)[0]["A"].notes.layout == blueprint["A"].notes.layout
    placed, (fourth,) = edit.paste(blueprint, "A", bare, (7, 8))
    assert placed["A"].notes.layout[fourth.state] == (7, 8)
    with pytest.raises(EditRefused, match="not on the canvas"):
        edit.paste(blueprint, "A", text, (float("nan"), 0))


def test_cut_leaves_the_rest() -> None:
    blueprint = read(A=NOTED)
    left, text = edit.cut(blueprint, at("A/State_10"))
    assert left == edit.delete(blueprint, at("A/State_10"))
    assert text == edit.excerpt(blueprint, at("A/State_10"))
    with pytest.raises(EditRefused, match="nothing is chosen"):
        edit.cut(blueprint, [])
    with pytest.raises(EditRefused, match="no state 'X'"):
        edit.excerpt(blueprint, at("A/X"))


@pytest.mark.parametrize(
    "text",
    ["", "hello", "{", '{"A": 5}', '{"A": {"S": {"o": 5}}}', "[1, 2]", "\ud800", "\0", "a: [b: c"],
)
def test_what_is_no_smsl_is_refused_with_a_sentence(text: str) -> None:
    blueprint = read(A=NOTED)
    with pytest.raises(EditRefused, match="the pasted text is no SMSL: "):
        edit.paste(blueprint, "A", text)


@pytest.mark.parametrize("text", ["{}", '{"_x": 1}', "// nothing", '{"A": {"_copied": "states"}}'])
def test_what_holds_nothing_is_refused(text: str) -> None:
    with pytest.raises(EditRefused, match="holds nothing"):
        edit.paste(read(A=NOTED), "A", text)


def test_states_need_an_sb_to_be_pasted_into() -> None:
    text = edit.excerpt(read(A=NOTED), at("A/State_00"))
    with pytest.raises(EditRefused, match="no State Branch to paste into"):
        edit.paste(new_blueprint(), "", text)
    whole = edit.excerpt(read(A=NOTED), at("A"))
    assert list(edit.paste(new_blueprint(), "", whole)[0].branches) == ["A"]


def test_odd_texts_do_no_harm() -> None:
    odd = {
        "_copied": "states",
        "State_01": {"o": "Nowhere", "_x": 1},
        "_states": [],
        "_operations": {"o": 5, "a/b/c": {}},
        "_layout": {"State_01": [10**400, 0], "X": [0, 0]},
    }
    blueprint = read(A=NOTED)
    after, _ = edit.paste(blueprint, "A", write_json({"A": odd}))
    assert after["A"].table["State_01"] == {"o": "Nowhere"}
    assert after["A"].fields["_layout"] == NOTED["_layout"]
    assert again(after) == after
    with pytest.raises(EditRefused, match="neither a State Branch nor a state 'X'"):
        edit.paste(blueprint, "X", write_json({"A": odd}))


# --- any blueprint -------------------------------------------------------------------------------


def some_states(blueprint: Blueprint, chance: random.Random) -> list[Address]:
    branch = chance.choice([one for one in blueprint if one.table])
    states = chance.sample(list(branch.table), chance.randrange(1, len(branch.table) + 1))
    return [Address(branch.name, state) for state in states]


def shape(blueprint: Blueprint, states: Iterable[Address], inside: bool = True) -> object:
    """The states by number, and the operations among them."""
    number = {address: index for index, address in enumerate(states)}
    return [
        {
            name: number[Address(at.branch, target)]
            for name, target in blueprint[at.branch].table[at.state].items()
            if Address(at.branch, target) in number
        }
        for at in number
    ]


def in_order(blueprint: Blueprint, states: Iterable[Address]) -> list[Address]:
    chosen = set(states)
    return [
        s.address for branch in blueprint for s in branch.states.values() if s.address in chosen
    ]


@settings(max_examples=share_of(60))
@given(texts(), st.integers(0, 10**6))
def test_what_is_pasted_is_what_was_copied(text: str, seed: int) -> None:
    chance = random.Random(seed)
    blueprint = read_blueprint(parse_json(text, "f.json"))
    if not any(branch.table for branch in blueprint):
        blueprint = hanoi(2)
    chosen = in_order(blueprint, some_states(blueprint, chance))
    copied = edit.excerpt(blueprint, chosen)
    values = native(copied).values
    target = chance.choice(list(blueprint.branches))
    results = []
    for form in ("smsl", "json", "yaml"):
        other = form_named(form).write(values)
        after, made = edit.paste(blueprint, target, other)
        results.append(after.document.text)
        assert shape(after, made) == shape(blueprint, chosen)
        assert again(after) == after
        for address in in_order(
            blueprint, [s.address for b in blueprint for s in b.states.values()]
        ):
            assert (
                after[address.branch].table[address.state]
                == (blueprint[address.branch].table[address.state])
            )
    assert len(set(results)) == 1, "from every form the same"
    for old, new in zip(chosen, made, strict=True):
        for operation in shape(blueprint, chosen)[chosen.index(old)]:  # type: ignore[index]
            was = blueprint[old.branch].fields.get("_operations")
            if isinstance(was, dict) and note_key(operation, old.state) in was:
                assert note_key(operation, new.state) in after[target].fields["_operations"]
    whole = chance.choice(list(blueprint.branches))
    empty = edit.add_branch(new_blueprint(), "an SB that nobody else has")
    fresh, (made_sb,) = edit.paste(
        empty, "an SB that nobody else has", edit.excerpt(blueprint, [Address(whole)])
    )
    assert made_sb == Address(whole)
    assert fresh[whole] == blueprint[whole]
    assert again(fresh) == fresh


GIVEN: dict[str, Any] = {
    "Ready": {"Go": "Moving"},
    "Moving": {},
    "_states": {"Ready": {"facts": ["0", "1"]}, "Moving": {"facts": ["1", "1"], "title": "fast"}},
    "_facts": {"0": {"name": "Power", "values": {"0": "off", "1": "on"}}},
}


def test_copies_take_fact_values_that_are_free() -> None:
    blueprint = read(A=GIVEN)
    both = at("A/Ready", "A/Moving")
    for after, made in (
        edit.duplicate(blueprint, both),
        edit.paste(blueprint, "A", edit.excerpt(blueprint, both)),
    ):
        branch = after["A"]
        assert [branch.facts(one.state) for one in made] == [("0", "0"), ("1", "0")]
        assert branch.fields["_states"][made[1].state]["title"] == "fast"
        assert [branch.facts(name) for name in GIVEN if name[0] != "_"] == [("0", "1"), ("1", "1")]


def test_the_names_of_facts_come_along_where_there_are_none() -> None:
    blueprint, target = read(A=GIVEN), read(A={})
    text = edit.excerpt(blueprint, at("A/Ready"))
    after, made = edit.paste(target, "A", text)
    assert after["A"].fields["_facts"] == GIVEN["_facts"]
    assert after["A"].facts(made[0].state) == ("0", "1")
    again_, _ = edit.paste(after, "A", text)
    assert again_["A"].fields["_facts"] == GIVEN["_facts"]
    named = read(A={"State_0": {}, "State_1": {}, "_facts": {"0": {"name": "Mine"}}})
    kept, _ = edit.paste(named, "A", text)
    assert kept["A"].fields["_facts"] == {"0": {"name": "Mine"}}
