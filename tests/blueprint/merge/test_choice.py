"""The choice of conflicts, one by one."""

from __future__ import annotations

import json
from random import Random
from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import delete, rename
from smsl_studio.blueprint.merge import (
    Conflict,
    Side,
    choose,
    choose_all,
    chosen_side,
    merge,
    open_conflicts,
)
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import EditRefused
from tests.blueprint.merge.random_merges import sides
from tests.blueprint.merge.sides import things
from tests.blueprint.merge.test_merge import BASE, changed, merged, without_s2
from tests.blueprint.values import read
from tests.counts import share_of

COUNT = share_of(100)
PARTS = COUNT // 25


def chosen(blueprint: Blueprint, side: Side, chance: Random | None = None) -> Blueprint:
    """The blueprint after all its conflicts were decided for one side, in any order."""
    while found := open_conflicts(blueprint):
        one = chance.choice(found) if chance else found[0]
        after = choose(blueprint, one, side)
        assert len(open_conflicts(after)) == len(found) - 1
        blueprint = after
    assert "_conflicts" not in blueprint.document.values
    return blueprint


@pytest.mark.parametrize("part", range(PARTS))
def test_all_mine_is_the_merged_blueprint_without_its_conflicts(part: int) -> None:
    for number in range(part, COUNT, PARTS):
        base, ours, theirs = sides(number, renames=True)
        done = merge(base, ours, theirs)
        assert things(chosen(done.blueprint, "ours")) == things(done.blueprint), number


@pytest.mark.parametrize("part", range(PARTS))
def test_all_mine_is_ours_where_theirs_changed_nothing_else(part: int) -> None:
    """Theirs gets back what it changed alone, so that only conflicts are left of it."""
    for number in range(part, COUNT, PARTS):
        base, ours, theirs = sides(number, renames=False)
        done = merge(base, ours, theirs)
        again = merge(base, ours, chosen(done.blueprint, "ours"))
        assert again.conflicts == (), number
        here, there, before = things(ours), things(theirs), things(base)
        mine = things(chosen(done.blueprint, "ours"))
        for thing, value in here.items():
            if there.get(thing) == before.get(thing):
                assert mine.get(thing) == value, (number, thing)


@pytest.mark.parametrize("part", range(PARTS))
def test_all_theirs_is_the_merge_with_the_sides_swapped(part: int) -> None:
    seen = 0
    for number in range(part, 2 * COUNT, PARTS):
        base, ours, theirs = sides(number, renames=number % 4 == 3)
        done = merge(base, ours, theirs)
        swapped = chosen(merge(base, theirs, ours).blueprint, "ours")
        mine = chosen(done.blueprint, "theirs", Random(number))
        assert things(mine) == things(swapped), number
        assert things(choose_all(done.blueprint, "theirs")) == things(swapped), number
        seen += len(done.conflicts)
    assert seen > 10


@pytest.mark.parametrize(("side", "target"), [("ours", "S0"), ("theirs", "S2"), ("base", "S1")])
def test_a_choice_changes_one_value_and_one_entry(side: Side, target: str) -> None:
    done = merged(
        changed(("A|S0|go", "S0"), ("B|X0|up", "X0")), changed(("A|S0|go", "S2"), ("B|X0|up", None))
    )
    second, first = done.conflicts
    after = choose(done.blueprint, first, side)
    assert after["A"].table["S0"]["go"] == target
    assert open_conflicts(after) == (second,)
    assert chosen_side(after, first) == side
    assert json.loads(after.document.text)["_conflicts"][0]["path"] == ["B", "X0", "up"]


def test_a_decided_conflict_can_be_decided_anew() -> None:
    done = merged(changed(("A|S0|go", "S0")), changed(("A|S0|go", "S2")))
    (one,) = done.conflicts
    theirs = choose(done.blueprint, one, "theirs")
    mine = choose(theirs, one, "ours")
    assert mine["A"].table["S0"]["go"] == "S0"
    assert chosen_side(mine, one) == "ours"


@pytest.mark.parametrize("is_mine", [True, False])
def test_a_state_comes_and_goes_with_all_that_belongs_to_it(is_mine: bool) -> None:
    kept = changed(("A|S2|back", "S0"), ("A|HEADER|NUM_STATES", 3))
    gone = without_s2()
    gone["A"]["HEADER"]["NUM_STATES"] = 2
    done = merged(kept, gone) if is_mine else merged(gone, kept)
    found = open_conflicts(done.blueprint)
    (one,) = [conflict for conflict in found if conflict.path == ("A", "S2")]
    without = choose(done.blueprint, one, "theirs" if is_mine else "ours")
    with_it = choose(done.blueprint, one, "ours" if is_mine else "theirs")
    assert without["A"].table["S1"] == {"back": "S0"}
    assert without["A"].state_note("S2") is None
    assert without["A"].header.num_states == 2
    assert with_it["A"].table["S1"] == {"back": "S0", "on": "S2"}
    assert with_it["A"].table["S2"] == {"back": "S0"}
    assert with_it["A"].header.num_states == 3
    note = with_it["A"].state_note("S2")
    assert note is not None
    assert note.title == "third"


def test_an_end_stays_when_a_state_comes_back_behind_it() -> None:
    base: dict[str, Any] = {"A": {"S0": {"go": "S1"}, "S1": {}, "S2": {"a": "S0"}, "S3": {}}}
    ours = {"A": {"S0": {"go": "S1"}, "S1": {}, "S3": {}}}
    theirs = {"A": {**base["A"], "S2": {"a": "S1"}}}
    done = merge(read(base), read(ours), read(theirs))
    after = choose(done.blueprint, done.conflicts[0], "theirs")
    assert "S2" in after["A"].table
    assert after["A"].activating == "S3"


def test_a_name_is_chosen_and_other_conflicts_follow_it() -> None:
    def renamed(name: str, target: str) -> Blueprint:
        after = rename(read(BASE), Address("A", "S2"), name)
        return read(changed_in(after, target))

    def changed_in(blueprint: Blueprint, target: str) -> dict[str, Any]:
        values: dict[str, Any] = json.loads(blueprint.document.text)
        values["A"]["S0"]["go"] = target
        return values

    done = merge(read(BASE), renamed("Mine", "Mine"), renamed("Other", "S0"))
    name, edge = open_conflicts(done.blueprint)
    assert name.about_name
    after = choose(done.blueprint, name, "theirs")
    assert "Other" in after["A"].table
    (left,) = open_conflicts(after)
    assert (left.path, left.ours) == (edge.path, "Other")
    assert chosen_side(after, name) == "theirs"


def test_a_rename_in_the_drawing_takes_the_conflicts_along() -> None:
    done = merged(changed(("A|S0|go", "S0")), changed(("A|S0|go", "S2")))
    after = rename(done.blueprint, Address("A", "S0"), "Begin")
    after = rename(after, Address("A", "Begin", "go"), "start")
    after = rename(after, Address("A"), "Arm")
    (one,) = open_conflicts(after)
    assert (one.path, one.ours, one.theirs) == (("Arm", "Begin", "start"), "Begin", "S2")
    assert choose(after, one, "theirs")["Arm"].table["Begin"]["start"] == "S2"


def test_a_hazard_is_chosen_inside_its_list() -> None:
    fire = {"name": "fire", "facts": {"A/0": "1"}}
    one, other = ({**fire, "facts": {"A/0": value}} for value in "23")
    done = merged(changed(("_hazards", [one])), changed(("_hazards", [other])))
    after = choose(done.blueprint, done.conflicts[0], "theirs")
    assert after.document.values["_hazards"] == [other]


def test_sub_sbs_of_one_digit_are_swapped() -> None:
    base = {"A": {"s0": {"go": "s1"}, "s1": {}}, "B": BASE["B"], "C": BASE["B"]}
    one, other = ({**base, "A": {"HEADER": {"SUB_SBS": {sub: 0}}, **base["A"]}} for sub in "BC")
    done = merge(read(base), read(one), read(other))
    assert dict(chosen(done.blueprint, "theirs")["A"].header.sub_sbs) == {"C": 0}
    assert dict(chosen(done.blueprint, "ours")["A"].header.sub_sbs) == {"B": 0}
    assert dict(chosen(done.blueprint, "base")["A"].header.sub_sbs) == {}


def test_what_has_no_place_any_more_is_refused_and_mine_ends_it() -> None:
    done = merged(changed(("A|S2|back", "S0")), changed(("A|S2|back", "S2")))
    (one,) = done.conflicts
    gone = delete(done.blueprint, [Address("A", "S2")])
    with pytest.raises(EditRefused, match="A/S2/back has no place"):
        choose(gone, one, "theirs")
    assert open_conflicts(choose(gone, one, "ours")) == ()


def test_a_base_that_is_not_known_cannot_be_chosen() -> None:
    entry = {"path": ["A", "S0", "go"], "ours": "S1", "theirs": "S2", "base_known": False}
    blueprint = read({**BASE, "_conflicts": [entry, "odd"]})
    (one,) = open_conflicts(blueprint)
    assert not one.base_known
    with pytest.raises(EditRefused, match="not known"):
        choose(blueprint, one, "base")
    assert choose(blueprint, one, "theirs").document.values["_conflicts"] == ["odd"]


@pytest.mark.parametrize(
    "entry",
    [
        {"path": ["A", "S0", "go", "deep"], "ours": 1, "theirs": 2},
        {"path": ["A"], "ours": {}, "theirs": 7},
        {"path": ["Nowhere", "S"], "ours": {}, "theirs": {"go": "S"}},
        {"path": ["A", "HEADER"], "ours": {}, "theirs": []},
        {"path": ["A", "_states"], "ours": {}, "theirs": [1]},
        {"path": ["_hazards", "x"], "ours": {}, "theirs": 1},
        {"path": ["A", "S0"], "about": "name", "base": "a", "ours": "b", "theirs": "_x"},
    ],
)
def test_an_entry_written_by_hand_is_refused_or_gives_a_blueprint(entry: dict[str, Any]) -> None:
    blueprint = read({**BASE, "_conflicts": [entry]})
    sides_of: tuple[Side, ...] = ("ours", "theirs", "base")
    one: Conflict
    for one in open_conflicts(blueprint):
        for side in sides_of:
            try:
                after = choose(blueprint, one, side)
            except EditRefused:
                continue
            assert read(json.loads(after.document.text)) == after
    for side in sides_of:
        after = choose_all(blueprint, side)
        assert read(json.loads(after.document.text)) == after
        assert open_conflicts(after) == ()


@pytest.mark.parametrize("is_mine", [True, False])
def test_who_decides_about_its_operations_comes_and_goes_with_a_state(is_mine: bool) -> None:
    """Without its entry an operation of a kept state would be decided by nobody."""
    levels = {"A/S2/back": "human", "A/S1/on": "shared", "B/X0/up": "human"}
    base = {**BASE, "_levels": levels}
    kept = {**changed(("A|S2|back", "S0")), "_levels": levels}
    gone = {**without_s2(), "_levels": {"B/X0/up": "human"}}
    ours, theirs = (kept, gone) if is_mine else (gone, kept)
    done = merge(read(base), read(ours), read(theirs))
    with_it = chosen(done.blueprint, "ours" if is_mine else "theirs")
    without = chosen(done.blueprint, "theirs" if is_mine else "ours")
    assert with_it.document.values["_levels"] == levels
    assert without.document.values["_levels"] == {"B/X0/up": "human"}
    renamed = rename(done.blueprint, Address("A", "S1"), "Mid")
    after = chosen(renamed, "ours" if is_mine else "theirs")
    assert after.document.values["_levels"]["A/Mid/on"] == "shared"


def test_a_level_that_one_side_changed_on_a_deleted_operation_is_a_conflict() -> None:
    base = {**BASE, "_levels": {"A/S0/wait": "human"}}
    ours = {**BASE, "_levels": {"A/S0/wait": "shared"}}
    done = merge(read(base), read(ours), read(changed(("A|S0|wait", None))))
    (one,) = done.conflicts
    assert one.path == ("A", "S0", "wait")
    assert done.blueprint.document.values["_levels"] == {"A/S0/wait": "shared"}
    after = choose(done.blueprint, one, "theirs")
    assert "_levels" not in after.document.values
