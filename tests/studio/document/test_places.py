"""States keep their positions from edit to edit."""

from __future__ import annotations

import json
from itertools import pairwise
from random import Random
from typing import cast

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import delete, rename
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.writing import values_of
from smsl_studio.errors import EditRefused
from smsl_studio.graph.layout import place_states
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.studio.document.places import Places, Position
from tests.blueprint.test_any_edits import random_edit
from tests.counts import share_of


def branch(*names: str) -> StateBranch:
    return StateBranch("SB", {name: {"go": names[0]} for name in names})


def test_states_that_are_renamed_all_at_once_keep_their_places() -> None:
    places = Places()
    before = places.of(branch("A", "B", "C", "D"))
    after = places.of(branch("A", "X", "Y", "D"))
    assert list(after.values()) == list(before.values())
    assert places.of(branch("A", "B", "C", "D")) == before
    swapped = places.of(branch("A", "C", "B", "D"))
    assert swapped == before


def opened_anew(blueprint: Blueprint) -> dict[str, dict[str, Position]]:
    """The places of all states in a window that opens the blueprint as a file."""
    text = json.dumps(values_of(blueprint))
    return {one.name: place_states(one) for one in read_blueprint(parse_json(text, "x.json"))}


def agree(places: Places, blueprint: Blueprint) -> bool:
    anew = opened_anew(blueprint)
    return all(
        abs(x - anew[one.name][state][0]) < 0.2 and abs(y - anew[one.name][state][1]) < 0.2
        for one in blueprint
        for state, (x, y) in places.shown(one).items()
    )


def random_tables(chance: Random) -> dict[str, object]:
    """An SB of one or two parts, some states of which have names of facts."""
    count = chance.choice([3, 6, 9, 13, 30])
    names = [f"State_{i:05b}" if chance.random() < 0.7 else f"Place {i}" for i in range(count)]
    table: dict[str, object] = {name: {} for name in names}
    for number in range(chance.randrange(2 * count)):
        first = chance.randrange(2) * (count // 2)
        a, b = (names[first + chance.randrange((count + 1) // 2)] for _ in range(2))
        cast("dict[str, str]", table[a])[f"Op_{'long' * chance.randrange(5)}{number}"] = b
    return {"SB": {"HEADER": {"INITIAL": names[0]}, **table}}


@pytest.mark.parametrize("seed", range(share_of(60)))
def test_after_any_edit_a_file_that_is_opened_again_looks_the_same(seed: int) -> None:
    chance = Random(seed)
    blueprint = read_blueprint(parse_json(json.dumps(random_tables(chance)), "x.json"))
    places = Places()
    for one in blueprint:
        places.of(one)
    for _ in range(12):
        try:
            after = places.completed(blueprint, random_edit(chance, blueprint))
        except EditRefused:
            continue
        for one in after:
            places.of(one)
        assert agree(places, after)
        blueprint = after


def changed(table: dict[str, object], after: dict[str, object]) -> tuple[Places, Blueprint]:
    """What an edit of the source text from one table to another leaves."""
    before, now = (read_blueprint(parse_json(json.dumps(one), "x.json")) for one in (table, after))
    places = Places()
    for one in before:
        places.of(one)
    completed = places.completed(before, now)
    for one in completed:
        places.of(one)
    return places, completed


def test_another_activating_state_of_a_triangle_is_seen_in_the_file() -> None:
    table: dict[str, object] = {"A": {"b": "B", "c": "C"}, "B": {"a": "A", "c": "C"}}
    table["C"] = {"a": "A", "b": "B"}
    places, after = changed(
        {"SB": {"HEADER": {"INITIAL": "A", "ACTIVATING": "C"}, **table}},
        {"SB": {"HEADER": {"INITIAL": "A", "ACTIVATING": "B"}, **table}},
    )
    assert after["SB"].notes.layout
    assert agree(places, after)


def test_two_states_that_change_names_are_seen_in_the_file() -> None:
    places, after = changed(
        {
            "SB": {
                "Home": {"go": "Field", "way": "Barn"},
                "Field": {},
                "Barn": {"on": "Town"},
                "Town": {},
            }
        },
        {
            "SB": {
                "Home": {"go": "Barn", "way": "Field"},
                "Barn": {},
                "Field": {"on": "Town"},
                "Town": {},
            }
        },
    )
    assert agree(places, after)


def test_a_name_that_goes_from_state_to_state_moves_none_of_them() -> None:
    """Both are renamed before their SB is shown again."""
    table = {
        "Home": {"go": "Field", "way": "Barn"},
        "Field": {},
        "Barn": {"on": "Town"},
        "Town": {},
    }
    blueprint = read_blueprint(parse_json(json.dumps({"SB": table}), "x.json"))
    places = Places()
    before = places.of(blueprint["SB"])
    for old, new in (("Field", "Shop"), ("Barn", "Field")):
        blueprint = places.completed(blueprint, rename(blueprint, Address("SB", old), new))
    assert list(places.of(blueprint["SB"]).values()) == list(before.values())
    assert agree(places, blueprint)


def test_a_longer_name_in_the_smaller_part_is_seen_in_the_file() -> None:
    """The columns of each part are as far apart as its own names need."""
    one = {f"First {i}": {"averylongoperation": f"First {i + 1}"} for i in range(3)}
    places, after = changed(
        {"SB": {**one, "First 3": {}, "X": {"go": "Y"}, "Y": {}}},
        {"SB": {**one, "First 3": {}, "X": {"alongoperation": "Y"}, "Y": {}}},
    )
    assert after["SB"].notes.layout
    assert agree(places, after)


def test_another_name_of_the_same_length_leaves_the_file_without_places() -> None:
    names = [f"S{'x' * (i % 4)}{i}" for i in range(40)]
    table = {a: {"go": b} for a, b in pairwise([*names, names[0]])}
    blueprint = read_blueprint(parse_json(json.dumps({"SB": table}), "x.json"))
    places = Places()
    before = places.of(blueprint["SB"])
    after = places.completed(blueprint, rename(blueprint, Address("SB", "S4"), "T4"))
    assert not after["SB"].notes.layout
    assert places.of(after["SB"])["T4"] == before["S4"]
    assert agree(places, after)


def test_what_changes_no_place_leaves_the_file_without_places() -> None:
    names = [f"S{i}" for i in range(30)]
    table = {a: {"go": b} for a, b in pairwise([*names, "S0"])}
    table["S3"]["by"] = "S8"
    places, after = changed({"SB": table}, {"SB": {**table, "S3": {"og": "S4", "by": "S8"}}})
    assert not after["SB"].notes.layout
    assert agree(places, after)


@pytest.mark.parametrize("seed", range(4))
def test_a_state_that_is_moved_by_hand_moves_no_other(seed: int) -> None:
    chance = Random(seed)
    table = {f"S{at}": {"go": f"S{chance.randrange(20)}"} for at in range(20)}
    blueprint = read_blueprint(parse_json(json.dumps({"SB": table}), "x.json"))
    places = Places()
    before = places.of(blueprint["SB"])
    for moved in chance.sample(list(table), 12):
        to = (round(chance.random() * 900, 1), round(chance.random() * 900, 1))
        edited = places.completed(blueprint, places.moved(blueprint, "SB", {moved: to}))
        after = places.of(edited["SB"])
        assert after == {**before, moved: to}
        assert opened_anew(edited)["SB"] == after, "and none in the file that is saved"
        blueprint, before = edited, after


def test_a_state_that_takes_the_name_of_a_deleted_one_leaves_that_one_its_place() -> None:
    """Undo brings the deleted state back to where it stood."""
    table = {"A": {"b": "B"}, "B": {"c": "C"}, "C": {"a": "A"}}
    blueprint = read_blueprint(parse_json(json.dumps({"SB": table}), "x.json"))
    places = Places()
    before = places.of(blueprint["SB"])
    fewer = places.completed(blueprint, delete(blueprint, [Address("SB", "C")]))
    stood = places.of(fewer["SB"])["B"]
    renamed = places.completed(fewer, rename(fewer, Address("SB", "B"), "C"))
    assert places.of(renamed["SB"])["C"] == stood
    assert agree(places, renamed)
    assert places.of(fewer["SB"])["B"] == stood
    assert places.of(blueprint["SB"]) == before
