"""How the name of a state holds the values of its facts."""

from __future__ import annotations

import json
from typing import Any

import pytest

from smsl_studio.blueprint.facts import fact_string, shape_of
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.plain_words import carried
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.json_form import parse_json


def branch(states: list[str], **rest: Any) -> StateBranch:
    values = {"A": {**rest, **{name: {} for name in states}}}
    return read_blueprint(parse_json(json.dumps(values), "f"))["A"]


@pytest.mark.parametrize(
    ("name", "num_facts", "expected"),
    [
        ("State_aaa", None, "aaa"),
        ("State010", None, "010"),
        ("State", None, ""),
        ("chess_0a1b", 2, "0a1b"),
        ("a_b_10", None, "10"),
        ("Ready", 2, "dy"),
        ("Ready", None, "Ready"),
    ],
)
def test_the_fact_string_is_what_the_name_ends_in(
    name: str, num_facts: int | None, expected: str
) -> None:
    assert fact_string(name, num_facts) == expected


def test_facts_may_be_wider_than_one_character() -> None:
    chess = branch(["chess_0a1b", "chess_1a0b"], HEADER={"NUM_FACTS": 2})
    assert chess.shape.width == 2
    assert chess.facts("chess_0a1b") == ("0a", "1b")
    assert chess.alphabet == (("0a", "1a"), ("0b", "1b"))


def test_without_num_facts_every_character_is_a_fact() -> None:
    assert branch(["State_ab", "State_cd"]).facts("State_cd") == ("c", "d")


@pytest.mark.parametrize(
    ("names", "num_facts", "misfits"),
    [
        (["Idle", "Busy!"], None, ("Idle",)),
        (["State00", "State01", "State1"], None, ("State1",)),
        (["State00", "State01", "State1"], 2, ("State1",)),
        (["State000", "State111"], 2, ("State000", "State111")),
        (["State0"], 0, ("State0",)),
        (["State", "State_"], None, ("State", "State_")),
    ],
)
def test_names_that_cannot_be_cut_are_opaque(
    names: list[str], num_facts: int | None, misfits: tuple[str, ...]
) -> None:
    shape = shape_of(names, num_facts)
    assert shape.opaque
    assert shape.num_facts == 1
    assert shape.misfits == misfits
    assert shape.values(names[0]) == (names[0],)


def test_how_names_are_cut_is_part_of_the_meaning() -> None:
    names = ["Foo", "Barr"]
    cut = branch(names, HEADER={"NUM_FACTS": 1})
    assert cut.facts("Foo") == ("o",)
    assert cut.num_facts == branch(names).num_facts == 1
    assert cut != branch(names)


def test_states_notes_give_the_facts_of_opaque_names() -> None:
    notes = {"Idle": {"facts": ["no", "0"]}, "Working": {"facts": ["yes", "1"]}}
    noted = branch(["Idle", "Working"], _states=notes)
    assert noted.num_facts == 2
    assert noted.facts("Working") == ("yes", "1")
    assert noted.alphabet == (("no", "yes"), ("0", "1"))
    assert branch(["Idle", "Working", "Other"], _states=notes).shape.opaque
    uneven = {"Idle": {"facts": ["no"]}, "Working": {"facts": ["yes", "1"]}}
    assert branch(["Idle", "Working"], _states=uneven).shape.opaque


def test_on_is_what_facts_say_else_one_else_the_value_in_activating() -> None:
    names = ["State_0a", "State_1b"]
    plain = branch(names)
    assert (plain.on_value(0), plain.on_value(1)) == ("1", "b")
    assert plain.is_on("State_1b", 1)
    assert not plain.is_on("State_0a", 1)
    other = branch(names, HEADER={"ACTIVATING": "State_0a"})
    assert (other.on_value(0), other.on_value(1)) == ("1", "a")
    said = branch(names, _facts={"0": {"on": "0"}, "1": {"on": "a", "name": "hand"}})
    assert (said.on_value(0), said.on_value(1)) == ("0", "a")
    assert (said.fact_name(0), said.fact_name(1)) == ("Fact 1", "hand")


def test_an_sb_without_states_has_no_values() -> None:
    empty = branch([])
    assert empty.alphabet == ()
    assert (empty.initial, empty.activating) == ("", "")
    assert empty.on_value(0) == "1"


class CountedName(str):
    """A name that counts how often it is compared with another one."""

    compared = 0

    def __eq__(self, other: object) -> bool:
        CountedName.compared += 1
        return super().__eq__(other)

    __hash__ = str.__hash__


def test_facts_that_names_carry_are_found_without_comparing_each_name_with_all() -> None:
    names = [CountedName(f"{'a' * (number % 7)}_{number}") for number in range(500)]
    found = StateBranch("SB", {name: {} for name in names})
    assert len(found.shape.misfits) == 100
    CountedName.compared = 0
    carried(found)
    assert CountedName.compared <= 5 * len(names)
