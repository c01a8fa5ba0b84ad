"""Notes and groups: read, refused, edited; they follow their states and change no digest."""

from __future__ import annotations

import json
from typing import Any

import pytest

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison import compare
from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.drawn import Drawn
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.inspection.inspect import inspect
from smsl_studio.smsl.forms import form_named
from smsl_studio.smsl.json_form import parse_json

NOTE = {"text": "Ask the clinic", "author": "R. Stein", "date": "2026-11-12", "at": [8, -16]}
HUNG = {"text": "It drifts", "at": [90, 40], "state": "S0"}
GROUP = {"title": "Apart", "states": ["S0", "S1"]}
Values = dict[str, Any]


def read(notes: Any = None, groups: Any = None, **more: Any) -> Blueprint:
    """An SB with three states, and what is drawn on it."""
    sb: Values = {"S0": {"o": "S1", "p": "S2"}, "S1": {"o": "S0"}, "S2": {}}
    if notes is not None:
        sb["_notes"] = notes
    if groups is not None:
        sb["_layout"] = {"S0": [0, 0], "_groups": groups}
    return read_blueprint(parse_json(json.dumps({"A": sb, **more}, indent=2), "f.json"))


def drawn(blueprint: Blueprint) -> Drawn:
    return blueprint["A"].drawn


def faults(blueprint: Blueprint) -> list[str]:
    return [one.message for one in inspect(blueprint) if one.rule == "R29"]


def test_an_sb_without_notes_and_groups_has_nothing_drawn() -> None:
    assert not drawn(read())
    assert not drawn(read(groups={}))


def test_notes_and_groups_are_read() -> None:
    found = drawn(read({"1": NOTE, "b": HUNG}, {"1": GROUP}))
    assert found.notes["1"].at == (8.0, -16.0)
    assert (found.notes["1"].text, found.notes["1"].author) == ("Ask the clinic", "R. Stein")
    assert found.notes_on("S0") == ("b",)
    assert found.group_of("S1") == "1"
    assert found.group_of("S2") == ""
    assert read(groups={"1": GROUP})["A"].notes.layout == {"S0": (0.0, 0.0)}


@pytest.mark.parametrize(
    ("notes", "groups", "said"),
    [
        ([], None, "_notes must be a map"),
        ({"1": {"text": "x"}}, None, "at: Field required"),
        ({"1": {**NOTE, "at": [1e9, 0]}}, None, "at.0"),
        ({"1": {**NOTE, "colour": "red"}}, None, "colour"),
        ({"1": {**NOTE, "text": "x" * 10_001}}, None, "at most 10000 characters"),
        ({"1": {**HUNG, "state": "S9"}}, None, "it hangs on S9, which is no state"),
        (None, 5, "_groups must be a map"),
        (None, {"1": {**GROUP, "states": "S0"}}, "states"),
        (None, {"1": GROUP, "2": GROUP}, "stands in another group already"),
        (None, {"1": {"title": "x", "states": ["S9"]}}, "one that does not exist"),
    ],
)
def test_what_does_not_fit_is_told_and_the_rest_counts(notes: Any, groups: Any, said: str) -> None:
    blueprint = read(notes, groups)
    told = faults(blueprint)
    assert len(told) == 1, told
    assert said in told[0]
    assert len(blueprint["A"].table) == 3
    assert set(drawn(blueprint).groups) <= {"1"}


def test_a_note_on_a_state_that_is_gone_is_free() -> None:
    assert drawn(read({"1": {**HUNG, "state": "S9"}})).notes["1"].state == ""


def test_they_change_no_digest() -> None:
    plain = read(groups={})
    after = edit.put_groups(edit.put_notes(plain, "A", {"1": NOTE}), "A", {"1": GROUP})
    assert digests(after) == digests(plain)
    assert after == plain
    assert drawn(after).notes
    assert drawn(after).groups


def test_adding_and_deleting_leads_back_to_the_same_text() -> None:
    before = read()
    one = edit.put_notes(before, "A", {"1": {**NOTE, "at": (8.04, -16.0)}, "2": HUNG})
    assert one["A"].fields["_notes"]["1"]["at"] == [8, -16]
    two = edit.put_groups(one, "A", {"1": GROUP})
    back = edit.put_groups(two, "A", {"1": None})
    assert back.document.text == one.document.text
    assert edit.put_notes(back, "A", {"1": None, "2": None}).document.text == before.document.text


def test_a_changed_field_leaves_the_others_alone() -> None:
    before = read({"1": NOTE, "2": HUNG})
    after = edit.put_notes(before, "A", {"1": {"text": "Ask again"}})
    assert after["A"].fields["_notes"] == {"1": {**NOTE, "text": "Ask again"}, "2": HUNG}
    free = edit.put_notes(before, "A", {"2": {"state": None}})
    assert drawn(free).notes["2"].state == ""


@pytest.mark.parametrize(
    "note",
    [
        {"text": "x"},
        {**NOTE, "state": "S9"},
        {**NOTE, "at": [float("nan"), 0]},
        {**NOTE, "at": [0, 1e8]},
        {**NOTE, "at": "here"},
        {**NOTE, "text": "x" * 10_001},
        {**NOTE, "size": 3},
    ],
)
def test_a_note_that_does_not_fit_is_refused(note: Values) -> None:
    with pytest.raises(EditRefused):
        edit.put_notes(read(), "A", {"1": note})


@pytest.mark.parametrize("group", [{"states": ["S9"]}, {"states": 5}, {"title": 5}, {"x": 1}])
def test_a_group_that_does_not_fit_is_refused(group: Values) -> None:
    with pytest.raises(EditRefused):
        edit.put_groups(read(), "A", {"1": group})


def test_nothing_is_put_where_something_else_stands() -> None:
    with pytest.raises(EditRefused, match="no map"):
        edit.put_notes(read(notes="see below"), "A", {"1": NOTE})
    with pytest.raises(EditRefused, match="no map"):
        edit.put_groups(read(groups=[1]), "A", {"1": GROUP})


def test_a_state_stands_in_one_group() -> None:
    both = edit.put_groups(read(groups={"1": GROUP}), "A", {"2": {"states": ["S1", "S2"]}})
    assert drawn(both).groups["1"].states == ("S0",)
    alone = edit.put_groups(both, "A", {"3": {"states": ["S0", "S0"]}})
    assert list(drawn(alone).groups) == ["2", "3"]
    assert drawn(alone).groups["3"].states == ("S0",)
    assert not faults(alone)


def test_they_follow_a_state_that_is_renamed() -> None:
    before = read({"1": HUNG}, {"1": GROUP})
    after = edit.rename(before, Address("A", "S0"), "S7")
    assert drawn(after).notes["1"].state == "S7"
    assert drawn(after).groups["1"].states == ("S7", "S1")
    assert not faults(after)
    back = edit.rename(after, Address("A", "S7"), "S0")
    assert back.document.text == before.document.text


def test_what_is_left_of_a_former_state_does_not_come_to_one_with_its_name() -> None:
    left = read({"1": {**HUNG, "state": "S7"}}, {"1": {"states": ["S7", "S1"]}})
    after = edit.rename(left, Address("A", "S0"), "S7")
    assert drawn(after).notes["1"].state == ""
    assert drawn(after).groups["1"].states == ("S1",)


def test_facts_that_are_added_rename_the_states_there_too() -> None:
    before = read({"1": HUNG}, {"1": GROUP})
    after = edit.add_fact(before, "A")
    assert drawn(after).notes["1"].state == "S00"
    assert drawn(after).groups["1"].states == ("S00", "S10")


def test_a_deleted_state_takes_its_notes_and_its_place_in_the_group_along() -> None:
    before = read({"1": HUNG, "2": NOTE}, {"1": GROUP})
    one = edit.delete(before, [Address("A", "S0")])
    assert list(drawn(one).notes) == ["2"]
    assert drawn(one).groups["1"].states == ("S1",)
    two = edit.delete(one, [Address("A", "S1")])
    assert not drawn(two).groups
    assert not faults(two)


def test_an_sb_carries_them() -> None:
    before = read({"1": HUNG}, {"1": GROUP})
    assert edit.rename(before, Address("A"), "B")["B"].drawn == drawn(before)
    text = edit.excerpt(before, [Address("A")])
    pasted, made = edit.paste(before, "A", text)
    assert pasted[made[0].branch].drawn == drawn(before)


def test_copied_states_have_their_notes_and_a_group_that_is_copied_whole() -> None:
    before = read({"1": HUNG, "2": NOTE}, {"1": GROUP})
    after, made = edit.duplicate(before, [Address("A", "S0"), Address("A", "S1")])
    names = [one.state for one in made]
    assert drawn(after).notes["3"].state == names[0]
    assert set(drawn(after).groups["2"].states) == set(names)
    part, _ = edit.duplicate(before, [Address("A", "S0")])
    assert list(drawn(part).groups) == ["1"]
    assert not faults(after)


@pytest.mark.parametrize("form", ["json", "smsl", "yaml"])
def test_every_form_keeps_them_byte_for_byte(form: str) -> None:
    odd = {**NOTE, "text": 'Line one\n\n  - "two" # no comment\t{x: [1]}\u202e é 漢\n'}
    values = read({"1": odd, "2": HUNG}, {"1": GROUP}).document.values
    text = form_named(form).write(values)
    first = read_blueprint(form_named(form).parse(text, "f"))
    assert first.document.text == text
    assert drawn(first) == drawn(read({"1": odd, "2": HUNG}, {"1": GROUP}))
    moved = edit.put_notes(first, "A", {"2": {"at": [1, 2]}})
    again = read_blueprint(form_named(form).parse(moved.document.text, "f"))
    assert drawn(again) == drawn(moved)
    back = edit.put_notes(moved, "A", {"2": {"at": HUNG["at"]}})
    assert back.document.text == text


def test_a_comparison_lists_them_beside_the_meaning() -> None:
    before = read({"1": NOTE}, {"1": GROUP})
    after = edit.put_notes(before, "A", {"1": {"text": "Done"}, "2": HUNG})
    after = edit.put_groups(after, "A", {"1": {"title": "Together"}})
    found = compare(before, after)
    assert not found.changes
    assert [one.path_after for one in found.fields] == [
        ("A", "_notes", "1"), ("A", "_notes", "2"), ("A", "_layout", "_groups", "1")
    ]  # fmt: skip
    odd = compare(before, read("none", {"1": GROUP}))
    assert [one.path_after for one in odd.fields] == [("A", "_notes")]


def test_an_edit_elsewhere_does_not_read_them_again() -> None:
    before = read({"1": NOTE}, {"1": GROUP})
    kept = drawn(before)
    moved = edit.set_layout(before, "A", {"S2": (5.0, 5.0)})
    assert drawn(moved) is kept
    assert moved["A"].notes.layout["S2"] == (5.0, 5.0)
    assert drawn(edit.put_notes(moved, "A", {"1": {"text": "new"}})) is not kept
