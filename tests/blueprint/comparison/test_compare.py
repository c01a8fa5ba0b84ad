"""Each single edit is reported as exactly its change. A rename is one change, without retargets."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison import Difference, compare
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.writing import values_of
from smsl_studio.generate.rules import hanoi
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.json_form import parse_json

A = Address
Edit = Callable[[Blueprint], Blueprint]


def sample(name: str) -> Blueprint:
    return smsl.read(samples_dir() / name)


def of(values: Any) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(values), "f.json"))


def told(difference: Difference) -> list[tuple[str, str, str, str]]:
    def at(address: Address | None) -> str:
        return "" if address is None else str(address)

    return [(c.kind.value, c.what, at(c.before), at(c.after)) for c in difference.changes]


def two_levels() -> Blueprint:
    return of(
        {
            "Base": {
                "HEADER": {"INITIAL": "State00", "ACTIVATING": "State11", "SUB_SBS": {"Sub": 1}},
                "State00": {"Plan": "State10", "Stay": "State00"},
                "State10": {"Touch": "State11", "Drop": "State00"},
                "State11": {"Drop": "State00"},
                "_operations": {
                    "Drop": {"cost": 2},
                    "State00/Plan": {"requires": {"Sub/0": "0"}},
                },
                "_states": {"State10": {"title": "Planned"}},
                "_layout": {"State00": [0, 0], "State10": [10, 0]},
            },
            "Sub": {
                "HEADER": {"INITIAL": "State0", "ACTIVATING": "State1"},
                "State0": {"Go": "State1"},
                "State1": {"Back": "State0"},
            },
            "_hazards": [{"name": "both", "facts": {"Base/0": "1", "Sub/0": "1"}}],
        }
    )


def test_the_misprints_of_the_appendix_are_two_renamed_operations() -> None:
    found = compare(sample("hanoi.json"), sample("hanoi-corrected.json"))
    assert told(found) == [
        ("renamed", "operation", "SB1/State_cbb/Op_1c", "SB1/State_cbb/Op_1b"),
        ("renamed", "operation", "SB1/State_cbc/Op_2b", "SB1/State_cbc/Op_2a"),
    ]
    place = found.place_before(found.changes[0])
    assert place is not None
    assert (place.line, place.column) == (73, 13)


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (lambda b: edit.add_branch(b, "New"), [("added", "branch", "", "New")]),
        (
            lambda b: edit.add_state(b, "Base", "State01"),
            [("added", "state", "", "Base/State01")],
        ),
        (
            lambda b: edit.add_operation(b, "Base", "State11", "Again", "State11"),
            [("added", "operation", "", "Base/State11/Again")],
        ),
        (
            lambda b: edit.delete(b, [A("Base", "State10", "Touch")]),
            [("removed", "operation", "Base/State10/Touch", "")],
        ),
        (
            lambda b: edit.delete(b, [A("Base", "State10")]),
            [
                ("removed", "operation", "Base/State00/Plan", ""),
                ("removed", "state", "Base/State10", ""),
            ],
        ),
        (
            lambda b: edit.retarget(b, A("Base", "State11", "Drop"), "State10"),
            [("retargeted", "operation", "Base/State11/Drop", "Base/State11/Drop")],
        ),
        (
            lambda b: edit.rename(b, A("Base", "State00"), "State01"),
            [("renamed", "state", "Base/State00", "Base/State01")],
        ),
        (
            lambda b: edit.rename(b, A("Base", "State00", "Plan"), "Draw"),
            [("renamed", "operation", "Base/State00/Plan", "Base/State00/Draw")],
        ),
        (
            lambda b: edit.rename(b, A("Base", "State11", "Drop"), "Leave", True),
            [
                ("renamed", "operation", "Base/State10/Drop", "Base/State10/Leave"),
                ("renamed", "operation", "Base/State11/Drop", "Base/State11/Leave"),
            ],
        ),
        (
            lambda b: edit.rename(b, A("Sub"), "Below"),
            [("renamed", "branch", "Sub", "Below")],
        ),
        (
            lambda b: edit.set_header(b, "Base", "INITIAL", "State10"),
            [("changed", "header", "Base", "Base")],
        ),
        (lambda b: edit.set_header(b, "Base", "NUM_FACTS", 2), []),
        (lambda b: edit.detach_sub(b, "Base", "Sub"), [("removed", "header", "Base", "Base")]),
        (
            lambda b: edit.set_note(b, "Base", "_facts", "0", {"name": "planned"}),
            [("added", "fact", "Base", "Base")],
        ),
        (
            lambda b: edit.set_note(b, "Base", "_states", "State10", {"title": "Ready"}),
            [("changed", "note", "Base/State10", "Base/State10")],
        ),
        (
            lambda b: edit.set_note(b, "Base", "_operations", "Drop", None),
            [("removed", "note", "Base", "Base")],
        ),
        (lambda b: edit.set_hazards(b, []), [("removed", "hazard", "", "")]),
        (lambda b: edit.reorder(b, A("Sub"), 0), [("changed", "order", "", "")]),
        (lambda b: edit.reorder(b, A("Base", "State10"), 0), []),
    ],
)
def test_one_edit_is_one_change(change: Edit, expected: list[tuple[str, str, str, str]]) -> None:
    before = two_levels()
    assert told(compare(before, change(before))) == expected


def test_names_that_are_cut_in_another_way_are_a_change_of_the_header() -> None:
    before = of({"S": {"State00": {}, "State11": {}}})
    found = compare(before, edit.set_header(before, "S", "NUM_FACTS", 1))
    assert [(c.what, c.field, c.old, c.new) for c in found.changes] == [
        ("header", "NUM_FACTS", 2, 1)
    ]


def test_moved_boxes_are_layout_only() -> None:
    before = two_levels()
    after = edit.set_layout(before, "Base", {"State00": (5.0, 5.0), "State11": (9.0, 9.0)})
    found = compare(before, after)
    assert found.layout_only
    assert not found.same
    assert [str(address) for address in found.moved] == ["Base/State00", "Base/State11"]
    assert found.words == "Layout only: 2 states were moved."
    renamed = compare(before, edit.rename(before, A("Base", "State00"), "State01"))
    assert renamed.moved == ()


def test_bends_and_moved_labels_are_layout_only() -> None:
    before = two_levels()
    one = next(before["Base"].edges())
    edge = A("Base", one.source, one.name)
    bent = edit.set_bends(before, edge, [(1.0, 2.0)])
    found = compare(before, bent)
    assert found.layout_only
    assert not found.same
    assert found.redrawn == (edge,)
    assert found.words == "Layout only: 1 operation was redrawn."
    assert found.as_json()["redrawn"] == 1
    moved = edit.place_label(edit.set_layout(bent, "Base", {"State00": (5, 5)}), edge, (0.5, 1, 1))
    assert compare(before, moved).words == (
        "Layout only: 1 state was moved, 1 operation was redrawn."
    )
    assert compare(moved, moved).same
    renamed = edit.rename(edit.rename(bent, edge, "anew"), A("Base", one.source), "State01")
    assert compare(bent, renamed).redrawn == ()
    assert not compare(before, edit.delete(bent, [edge])).redrawn, "it is gone, not redrawn"


def test_a_default_that_shifts_is_a_change_and_one_that_is_written_out_is_none() -> None:
    before = of({"S": {"StateA": {"go": "StateB"}, "StateB": {}}})
    written = edit.set_header(before, "S", "INITIAL", "StateA")
    assert compare(before, written).same
    shifted = compare(before, edit.reorder(before, A("S", "StateB"), 0))
    assert [(c.field, c.old, c.new) for c in shifted.changes] == [
        ("INITIAL", "StateA", "StateB"),
        ("ACTIVATING", "StateB", "StateA"),
    ]
    assert "the first state listed" in shifted.changes[0].words


def test_properties_are_part_of_the_meaning() -> None:
    plain: dict[str, Any] = {"S": {"State0": {}, "State1": {}}}
    one = {"name": "a", "never": "S/0 = 1"}
    before = of({**plain, "_properties": [one, {"name": "b", "reachable": "S/0 = 1"}]})
    same = [{"name": "b", "reachable": "S/0 = 1", "severity": "E"}, {**one, "why": ""}]
    assert compare(before, of({**plain, "_properties": same})).same
    after = of({**plain, "_properties": [{**one, "never": "S/0 = 0"}, {**one, "name": "c"}]})
    found = compare(before, after)
    assert not found.same
    assert [
        (c.kind.value, c.what, c.field, c.path_after or c.path_before) for c in found.changes
    ] == [
        ("changed", "property", "a", ("_properties", "0")),
        ("removed", "property", "b", ("_properties", "1")),
        ("added", "property", "c", ("_properties", "1")),
    ]
    assert "never is S/0 = 0 instead of S/0 = 1" in found.changes[0].words
    renamed = edit.rename(before, Address("S"), "T")
    assert {change.what for change in compare(before, renamed).changes} == {"branch"}


def test_hazards_are_told_by_name_and_their_order_means_nothing() -> None:
    hazards = [{"name": "a", "facts": {"S/0": v}} for v in "01"]
    before = of({"S": {"State0": {}}, "_hazards": [*hazards, {"name": "b", "facts": {}}]})
    assert compare(before, of({"S": {"State0": {}}, "_hazards": [
        {"name": "b", "facts": {}}, *hazards[::-1]]})).same  # fmt: skip
    after = of({"S": {"State0": {}}, "_hazards": [*hazards, {"name": "c", "facts": {}}]})
    found = compare(before, after)
    assert [(c.kind.value, c.field, c.path_before or c.path_after) for c in found.changes] == [
        ("removed", "b", ("_hazards", "2")),
        ("added", "c", ("_hazards", "2")),
    ]


def test_imports_with_long_names_are_told_apart() -> None:
    far = "../" + "a-long-way/" * 9
    before = of({"_imports": [f"{far}one.json"]})
    found = compare(before, of({"_imports": [f"{far}two.json"]}))
    assert [(c.kind.value, c.field, c.path_before or c.path_after) for c in found.changes] == [
        ("removed", f"{far}one.json", ("_imports", "0")),
        ("added", f"{far}two.json", ("_imports", "0")),
    ]
    assert compare(before, of({"_imports": [f"./{far}x/../one.json"]})).same


def test_notes_are_told_by_what_they_say() -> None:
    state = {"State0": {"go": "State0"}}
    before = of({"S": {**state, "_operations": {"go": {"cost": 2, "actor": "human"}}}})
    after = of({"S": {**state, "_operations": {"go": {"cost": 3, "title": "", "risk": "low"}}}})
    found = compare(before, after)
    assert {(c.kind.value, c.field, c.old, c.new) for c in found.changes} == {
        ("removed", "_operations/go/actor", "human", None),
        ("changed", "_operations/go/cost", 2, 3),
        ("added", "_operations/go/risk", None, "low"),
    }
    assert found.changes[0].words == "The cost of the operation go of S is 3 instead of 2."
    odd = of({"S": {**state, "_operations": {"go": {"colour": "red"}}}})
    misfit = compare(before, odd).changes[-1]
    assert (misfit.what, misfit.field) == ("note", "_operations/go")
    assert "which does not fit" in misfit.words


def test_details_of_an_operation_that_got_another_name_in_one_state_are_told() -> None:
    table = {"HEADER": {"INITIAL": "A", "ACTIVATING": "B"}, "B": {"go": "A"}}
    common = {"go": {"title": "Go on", "timeout": 9}}
    before = of({"S": {**table, "A": {"go": "B"}, "_operations": common}})

    def after(**own: object) -> Blueprint:
        noted = {**common, "A/walk": own}
        return of({"S": {**table, "A": {"walk": "B"}, "_operations": noted}})

    kept = compare(before, after(title="Go on", timeout=9))
    assert [change.kind.value for change in kept.changes] == ["renamed"]
    walked = after(title="Walk", cost=4)
    for one, other, gone in ((before, walked, "removed"), (walked, before, "added")):
        come = "added" if gone == "removed" else "removed"
        renamed, *told = compare(one, other).changes
        assert renamed.kind.value == "renamed"
        assert {(change.kind.value, change.field.rsplit("/", 1)[1]) for change in told} == {
            ("changed", "title"), (gone, "timeout"), (come, "cost"),
        }  # fmt: skip


def test_what_differs_beside_the_known_keys_is_told_with_its_place() -> None:
    before = of({"S": {"HEADER": {"COLOUR": "red", "_h": 1}, "A": {"_s": 1}}, "_f": True})
    after = of({"S": {"HEADER": {"_h": 2}, "A": {"_s": 2}, "_b": 3}, "_f": 1})
    found = compare(before, after)
    assert [(c.kind.value, c.what, c.field) for c in (*found.changes, *found.fields)] == [
        ("removed", "header", "COLOUR"),
        ("changed", "field", "_f"),
        ("changed", "field", "_h"),
        ("changed", "field", "_s"),
        ("added", "field", "_b"),
    ]
    assert before == after
    assert found.words == ("1 change: 1 removed; beside the meaning _f, _h, _s and _b differ.")


def test_a_field_without_meaning_is_no_change() -> None:
    before = of({"S": {"A": {}, "_comment": "one", "_x": 1}})
    after = of({"S": {"A": {}, "_comment": "two", "_x": 1}})
    found = compare(before, after)
    assert (found.changes, found.same, found.same_meaning, found.layout_only) == (
        (), False, True, False)  # fmt: skip
    assert [(one.field, one.old, one.new) for one in found.fields] == [("_comment", "one", "two")]
    assert found.words == "Same meaning: only _comment differs."
    moved = compare(before, edit.set_layout(after, "S", {"A": (1.0, 2.0)}))
    assert moved.words == "Same meaning: only _comment differs; 1 state was moved."
    assert not moved.layout_only
    many = compare(before, of({"S": {"A": {}, **{f"_{n}": n for n in range(9)}}}))
    assert many.words == "Same meaning: only _comment, _x, _0, _1, _2 and 6 more differ."


def rename_all(blueprint: Blueprint, new_name: Callable[[str], str]) -> Blueprint:
    values = values_of(blueprint)
    for branch in values.values():
        for state in [key for key in branch if key != "HEADER"]:
            operations = {op: new_name(target) for op, target in branch.pop(state).items()}
            branch[new_name(state)] = operations
        header = branch.get("HEADER", {})
        for key in ("INITIAL", "ACTIVATING"):
            if key in header:
                header[key] = new_name(header[key])
    return of(values)


@pytest.mark.parametrize(
    "new_name",
    [lambda name: name.replace("State", "Step"), lambda name: f"n{hash(name) % 10**6:06d}x"],
    ids=["other prefix", "nothing in common"],
)
def test_an_sb_whose_states_all_have_other_names_is_renames_alone(
    new_name: Callable[[str], str],
) -> None:
    before = hanoi(3)
    names = {name: new_name(name) for name in before["SB1"].table}
    found = compare(before, rename_all(before, names.__getitem__))
    renamed = {c.old: c.new for c in found.changes if c.kind.value == "renamed"}
    assert renamed == names
    assert all(c.what in ("state", "header") for c in found.changes)


def test_renamed_states_are_found_in_another_order_and_beside_other_changes() -> None:
    before = two_levels()
    after = edit.rename(before, A("Base", "State10"), "Prepared")
    after = edit.delete(after, [A("Base", "Prepared", "Drop")])
    after = edit.reorder(after, A("Base", "Prepared"), 2)
    after = edit.add_state(after, "Base", "State01")
    found = compare(before, after)
    assert {(c.kind.value, c.what, c.old) for c in found.changes if c.what != "header"} == {
        ("renamed", "state", "State10"),
        ("removed", "operation", "State00"),
        ("added", "state", None),
    }
    assert found.states["Base"] == {"State10": "Prepared"}


TWO = {"State_0": {"Open": "State_1"}, "State_1": {"Shut": "State_0"}}
NAMED = {"0": {"name": "Door open"}}


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (TWO, {"State_0": {"Heat": "State_1"}, "State_1": {"Cool": "State_0"}}),
        (TWO, {"State_0": {"Open": "State_1"}, "State_1": {"Cool": "State_0"}}),
        (TWO, {"State_0": {"Open": "State_1"}, "State_1": {}, "State_2": {}}),
        ({"_facts": NAMED, **TWO}, {"_facts": {"0": {"name": "Valve open"}}, **TWO}),
        ({}, {}),
        ({"State_0": {}, "State_1": {}}, {"State_0": {}, "State_2": {}}),
    ],
)
def test_an_sb_that_was_deleted_and_a_new_one_are_two(old: Any, new: Any) -> None:
    """Many SBs have a State_0 and a State_1; what they do tells them apart."""
    before, after = of({"S": {"A": {}}, "DOOR": old}), of({"S": {"A": {}}, "VALVE": new})
    assert told(compare(before, after)) == [
        ("removed", "branch", "DOOR", ""),
        ("added", "branch", "", "VALVE"),
    ]


@pytest.mark.parametrize(
    "new",
    [
        TWO,
        {**TWO, "_facts": NAMED},
        {"State_0": {"Open": "State_1", "Stay": "State_0"}, "State_1": {"Shut": "State_0"}},
    ],
)
def test_an_sb_is_recognised_under_another_name_by_what_it_does(new: Any) -> None:
    before, after = of({"S": {"A": {}}, "DOOR": TWO}), of({"S": {"A": {}}, "GATE": new})
    assert compare(before, after).branches == {"DOOR": "GATE"}


def test_a_renamed_sub_sb_expands_the_same_fact() -> None:
    base = {"State_00": {"Op": "State_01"}, "State_01": {}}

    def with_sub(name: str, digit: int) -> Blueprint:
        return of({"B": {"HEADER": {"NUM_FACTS": 2, "SUB_SBS": {name: digit}}, **base}, name: TWO})

    assert compare(with_sub("DOOR", 0), with_sub("GATE", 0)).branches == {"DOOR": "GATE"}
    assert compare(with_sub("DOOR", 0), with_sub("GATE", 1)).branches == {}


def test_what_has_nothing_in_common_is_removed_and_added() -> None:
    before = of({"S": {"A": {"x": "B", "y": "B"}, "B": {"z": "B"}}})
    after = of({"S": {"C": {"p": "C"}, "B": {"z": "B"}}})
    found = [c for c in compare(before, after).changes if c.what == "state"]
    assert {(c.kind.value, str(c.address)) for c in found} == {
        ("removed", "S/A"),
        ("added", "S/C"),
    }


def test_a_difference_as_json_has_places_on_both_sides() -> None:
    found = compare(sample("hanoi.json"), sample("hanoi-corrected.json")).as_json()
    json.dumps(found)
    assert (found["same"], found["layout_only"], len(found["changes"])) == (False, False, 2)
    assert found["changes"][0]["place_after"]["line"] == 73
    assert found["changes"][0]["old"] == "Op_1c"


def test_notes_and_groups_are_counted_and_told_in_words() -> None:
    note = {"text": "Hello\nthere", "author": "A", "date": "2026-01-01", "at": [10, 20]}
    group = {"title": "Near", "states": ["A"]}
    plain = {"A": {"go": "B"}, "B": {"go": "A"}}
    before = of({"S": plain, "T": plain})
    drawn = {**plain, "_notes": {"1": note}, "_layout": {"_groups": {"1": group}}}
    after = of({"S": drawn, "T": {**plain, "_notes": {"1": note}}})
    found = compare(before, after)
    assert found.words == "Same meaning: only 2 notes and 1 group differ."
    assert [one.words for one in found.fields] == [
        "The note “Hello” is added to S.",
        "The group “Near” is added to S.",
        "The note “Hello” is added to T.",
    ]
    moved = {**drawn, "_notes": {"1": {**note, "text": "Bye", "state": "B"}}}
    again = compare(after, of({"S": moved, "T": plain}))
    assert again.words == "Same meaning: only 2 notes differ."
    assert [one.words for one in again.fields] == [
        "The note “Bye” of S said “Hello” before and hangs on B.",
        "The note “Hello” of T is removed.",
    ]
    wider = {**drawn, "_layout": {"_groups": {"1": {"title": "Near", "states": ["B", "A"]}}}}
    assert [one.words for one in compare(after, of({"S": wider, "T": drawn})).fields][:1] == [
        "The group “Near” of S has B too."
    ]


def test_values_are_told_in_words_and_not_as_json() -> None:
    def with_values(values: dict[str, str], sensors: list[str]) -> Blueprint:
        facts = {"0": {"values": values, "sensors": sensors}}
        return of({"S": {"S0": {"go": "S1"}, "S1": {}, "_facts": facts}})

    found = compare(
        with_values({"0": "open", "1": "shut"}, ["a"]),
        with_values({"0": "open", "1": "fixed"}, ["a", "b"]),
    )
    told = [change.words for change in found.changes]
    assert any(words.endswith("differ: 1 is fixed instead of shut.") for words in told), told
    assert any(words.endswith("is a, b instead of a.") for words in told), told
    assert not any("{" in words or "[" in words for words in told)
