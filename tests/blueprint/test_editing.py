"""The edits: what each changes in meaning and in the text, and what each refuses."""

from __future__ import annotations

import difflib
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.writing import new_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.smsl.files import read_document
from smsl_studio.smsl.json_form import parse_json, write_json

SAMPLES = Path(__file__).parents[2] / "samples"
A = Address


def sample(name: str) -> Blueprint:
    return read_blueprint(read_document(SAMPLES / f"{name}.json"))


def read(values: Any) -> Blueprint:
    text = values if isinstance(values, str) else write_json(values)
    return read_blueprint(parse_json(text, "f.json"))


def changes(before: Blueprint, after: Blueprint) -> tuple[list[str], list[str]]:
    """The lines that an edit took away and the lines it put in, stripped."""
    lines = list(
        difflib.unified_diff(before.document.text.split("\n"), after.document.text.split("\n"), n=0)
    )[2:]
    gone = [line[1:].strip() for line in lines if line.startswith("-")]
    come = [line[1:].strip() for line in lines if line.startswith("+")]
    again = read_blueprint(parse_json(after.document.text, after.file))
    assert again == after
    assert json.dumps(again.document.values) == json.dumps(after.document.values)
    return gone, come


FACTS_BOUND: dict[str, Any] = {
    "_hazards": [{"name": "both", "facts": {"A/0": "1", "B/0": "1"}}],
    "A": {
        "HEADER": {"INITIAL": "S0", "ACTIVATING": "S1", "SUB_SBS": {"B": 0}, "NUM_STATES": 2},
        "S0": {"up": "S1", "stay": "S0", "_why": "S1"},
        "S1": {"up": "S1"},
        "_states": {"S1": {"title": "done"}},
        "_operations": {"up": {"cost": 2}, "S0/up": {"requires": {"B/0": "0"}}},
        "_layout": {"S0": [0, 0], "S1": [9, 9]},
    },
    "B": {"T0": {"up": "T1"}, "T1": {}},
}


def test_drawing_from_nothing() -> None:
    blueprint = edit.add_branch(new_blueprint(), "SB1")
    blueprint = edit.add_state(blueprint, "SB1", "State0", at=(10.04, -3.96))
    blueprint = edit.add_state(blueprint, "SB1", "State1", at=(200.0, 0.0))
    blueprint = edit.add_operation(blueprint, "SB1", "State0", "Operation0", "State1")
    expected = {
        "SB1": {
            "HEADER": {},
            "State0": {"Operation0": "State1"},
            "State1": {},
            "_layout": {"State0": [10, -4], "State1": [200, 0]},
        }
    }
    assert blueprint.document.text == write_json(expected)


@pytest.mark.parametrize(
    ("change", "gone", "come"),
    [
        (
            lambda b: edit.add_operation(b, "SB1", "State000", "New", "State111"),
            ['"Operation000": "State100"'],
            ['"Operation000": "State100",', '"New": "State111"'],
        ),
        (
            lambda b: edit.retarget(b, A("SB1", "State000", "Operation000"), "State110"),
            ['"Operation000": "State100"'],
            ['"Operation000": "State110"'],
        ),
        (
            lambda b: edit.rename(b, A("SB1", "State000", "Operation000"), "Go"),
            ['"Operation000": "State100"'],
            ['"Go": "State100"'],
        ),
        (
            lambda b: edit.delete(b, [A("SB1", "State100", "Operation100A")]),
            ['"Operation100A": "State110",'],
            [],
        ),
        (
            lambda b: edit.set_header(b, "SB1", "INITIAL", "State100"),
            ['"INITIAL": "State000",'],
            ['"INITIAL": "State100",'],
        ),
        (lambda b: edit.set_header(b, "SB1", "INITIAL", None), ['"INITIAL": "State000",'], []),
        (
            lambda b: edit.reorder(b, A("SB1", "State100", "Operation100B"), 0),
            ['"Operation100A": "State110",', '"Operation100B": "State111"'],
            ['"Operation100B": "State111",', '"Operation100A": "State110"'],
        ),
        (
            lambda b: edit.add_branch(b, "SB3"),
            [],
            ["},", "", '"SB3": {', '"HEADER": {}'],
        ),
        (
            lambda b: edit.rename(b, A("SB1", "State100"), "State010"),
            ['"Operation000": "State100"', '"State100": {', '"Operation110A": "State100",'],
            ['"Operation000": "State010"', '"State010": {', '"Operation110A": "State010",'],
        ),
        (
            lambda b: edit.rename(b, A("SB2"), "Digits/2"),
            ['"SB2": 1', '"SB2": {'],
            ['"Digits/2": 1', '"Digits/2": {'],
        ),
        (
            lambda b: edit.detach_sub(b, "SB1", "SB2"),
            ['"NUM_FACTS": 3,', '"SUB_SBS": {', '"SB2": 1', "}"],
            ['"NUM_FACTS": 3'],
        ),
        (
            lambda b: edit.set_note(b, "SB2", "_facts", "0", {"name": "digitized"}),
            [],
            ["},", "", '"_facts": {', '"0": {', '"name": "digitized"', "}"],
        ),
    ],
)
def test_an_edit_changes_only_the_lines_of_its_element(
    change: Callable[[Blueprint], Blueprint], gone: list[str], come: list[str]
) -> None:
    before = sample("hfsm")
    text = before.document.text
    removed, added = changes(before, change(before))
    assert before.document.text == text
    assert (removed, added) == (gone, come)


def test_a_renamed_sb_is_followed_by_all_that_names_it() -> None:
    before = read(FACTS_BOUND)
    after = edit.rename(before, A("B"), "B/2")
    assert after["A"].header.sub_sbs == (("B/2", 0),)
    assert after["A"].operation_note("S0", "up").requires == {"B~12/0": "0"}
    assert after.hazards[0].facts == {"A/0": "1", "B~12/0": "1"}
    gone, come = changes(before, after)
    assert len(gone) == len(come) == 4
    assert edit.rename(after, A("B/2"), "B").document.text == before.document.text


def test_a_renamed_state_is_followed_by_all_that_names_it() -> None:
    before = read(FACTS_BOUND)
    after = edit.rename(before, A("A", "S1"), "S2")
    assert after["A"].table["S0"] == {"up": "S2", "stay": "S0"}
    assert after["A"].table["S2"] == {"up": "S2"}
    assert after["A"].header.activating == "S2"
    assert after["A"].notes.layout == {"S0": (0, 0), "S2": (9, 9)}
    assert after["A"].state_note("S2")
    assert after["A"].state_fields["S0"] == {"_why": "S1"}, "a comment is nobody's name"
    gone, come = changes(before, after)
    assert [line.replace("S1", "S2") for line in gone] == come
    renamed = edit.rename(before, A("A", "S0"), "S9")
    assert renamed["A"].operation_note("S9", "up").requires == {"B/0": "0"}


def test_what_was_said_of_a_state_long_gone_is_not_said_of_another() -> None:
    before = read({"A": {"S": {}, "_layout": {"S": [1, 1], "Gone": [2, 2]}}})
    assert edit.rename(before, A("A", "S"), "Gone")["A"].notes.layout == {"Gone": (1, 1)}


def test_a_renamed_operation_is_that_edge_alone_or_all_of_its_name() -> None:
    before = read(FACTS_BOUND)
    one = edit.rename(before, A("A", "S0", "up"), "rise")
    assert (list(one["A"].table["S0"]), list(one["A"].table["S1"])) == (["rise", "stay"], ["up"])
    assert one["A"].operation_note("S0", "rise").requires == {"B/0": "0"}
    assert one["A"].cost("S0", "rise") == 2, "what its name said goes on for the edge"
    assert one["A"].cost("S1", "up") == 2
    both = edit.rename(before, A("A", "S0", "up"), "rise", rename_everywhere=True)
    assert list(both["A"].table["S1"]) == ["rise"]
    assert both["A"].cost("S1", "rise") == 2
    assert "up" in both["B"].table["T0"], "another SB's operations are its own"
    last = edit.rename(one, A("A", "S1", "up"), "rise2")
    assert last["A"].cost("S1", "rise2") == 2, "the note follows the last edge of its name"


def test_an_operation_keeps_what_holds_for_it_under_a_new_name() -> None:
    of_up = {"requires": {"A/1": "1"}, "confirm": ["surgeon"], "cost": 3}
    notes = {"up": of_up, "S0/up": {"cost": 5}, "down": {"cost": 9, "title": "Down"}}
    table = {"S0": {"up": "S1"}, "S1": {"up": "S1", "down": "S0"}, "S2": {"down": "S0"}}
    before = read({"A": {**table, "_operations": {**notes, "S1/rise": {"risk": 1}}}})

    def held(blueprint: Blueprint, state: str, name: str) -> tuple[object, ...]:
        note = blueprint["A"].operation_note(state, name)
        return dict(note.requires), tuple(note.confirm), note.cost, note.title, note.risk

    for state in ("S0", "S1"):
        fresh = edit.rename(before, A("A", state, "up"), "rise")
        assert held(fresh, state, "rise") == held(before, state, "up")
        assert held(fresh, "S1" if state == "S0" else "S0", "up")[0] == {"A/1": "1"}
        assert edit.rename(fresh, A("A", state, "rise"), "up")["A"].table == before["A"].table
    joined = edit.rename(before, A("A", "S2", "down"), "up")
    assert held(joined, "S2", "up") == ({"A/1": "1"}, ("surgeon",), 3, "Down", None)
    own = edit.rename(before, A("A", "S0", "up"), "down")
    assert held(own, "S0", "down") == ({"A/1": "1"}, ("surgeon",), 5, "Down", None)
    several = edit.rename_operations(before, [A("A", "S0", "up"), A("A", "S1", "up")], "lift")
    assert set(several.document.values["A"]["_operations"]) >= {"lift", "S0/lift"}
    assert "up" not in several.document.values["A"]["_operations"]


def test_with_a_state_goes_what_would_point_at_nothing() -> None:
    after = edit.delete(read(FACTS_BOUND), [A("A", "S1")])
    assert after["A"].table == {"S0": {"stay": "S0"}}
    assert after["A"].header.activating is None
    assert after["A"].header.initial == "S0"
    assert after["A"].header.num_states == 1
    assert after["A"].notes.layout == {"S0": (0, 0)}
    assert after["A"].notes.operations.keys() == {"up"}
    assert after["A"].notes.states == {}
    assert not after["A"].notes.faults


def test_several_elements_are_deleted_at_once() -> None:
    before = sample("hfsm")
    gone = [
        A("SB2"),
        A("SB1", "State100"),
        A("SB1", "State100", "Operation100A"),
        A("SB2", "State0"),
    ]
    after = edit.delete(before, gone)
    assert list(after.branches) == ["SB1"]
    assert after["SB1"].header.sub_sbs == ()
    assert after["SB1"].table == {
        "State000": {},
        "State110": {"Operation110B": "State111"},
        "State111": {},
    }
    assert edit.delete(before, []) is before


def test_an_sb_that_a_condition_names_is_not_deleted() -> None:
    before = read(FACTS_BOUND)
    with pytest.raises(EditRefused, match=r"S0/up of A requires the fact B/0"):
        edit.delete(before, [A("B")])
    without = edit.set_note(before, "A", "_operations", "S0/up", None)
    with pytest.raises(EditRefused, match="the hazard 'both' names the fact B/0"):
        edit.delete(without, [A("B")])
    bare = edit.set_hazards(without, [])
    assert list(edit.delete(bare, [A("B")]).branches) == ["A"]
    assert edit.set_hazards(bare, [{"name": "x", "facts": {"A/0": "1"}}]).hazards[0].name == "x"


def test_what_holds_for_an_operation_goes_with_it_to_another_source() -> None:
    before = read({
        "_levels": {"A/S0/up": "human", "A/S2/up": "shared", "A/up": "shared"},
        "A": {
            "S0": {"up": "S1", "stay": "S0"},
            "S1": {"up": "S1"},
            "S2": {"down": "S0"},
            "_operations": {
                "S0/up": {"cost": 2}, "S2/up": {"cost": 9}, "up": {"title": "Up"},
            },
        },
    })  # fmt: skip
    after = edit.move_source(before, A("A", "S0", "up"), "S2")
    assert after["A"].table == {
        "S0": {"stay": "S0"}, "S1": {"up": "S1"}, "S2": {"down": "S0", "up": "S1"},
    }  # fmt: skip
    assert list(after["A"].table["S2"]) == ["down", "up"]
    values = after.document.values
    assert values["A"]["_operations"] == {"S2/up": {"cost": 2}, "up": {"title": "Up"}}
    assert values["_levels"] == {"A/S2/up": "human", "A/up": "shared"}
    changes(before, after)
    assert edit.move_source(before, A("A", "S0", "up"), "S0") is before
    loop = edit.move_source(before, A("A", "S2", "down"), "S0")
    assert loop["A"].table["S0"]["down"] == "S0"


def test_order_is_among_like_and_skipped_names_stay() -> None:
    before = read({"_c": 1, "A": {"S": {}, "_c": 0, "T": {}, "U": {}}, "B": {}})
    after = edit.reorder(before, A("A", "U"), 0)
    assert list(after.document.values["A"]) == ["U", "_c", "S", "T"]
    assert (after["A"].initial, after["A"].activating) == ("U", "T")
    assert list(edit.reorder(before, A("B"), 0).branches) == ["B", "A"]
    assert edit.reorder(before, A("B"), 1) is before


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        (None, '"SUB_SBS": {"C": 1}'),
        ("[]", '"SUB_SBS": {"C": 1}'),
        ("null", '"SUB_SBS": {"C": 1}'),
        ('[{"B": 0}]', '"SUB_SBS": [{"B": 0}, {"C": 1}]'),
        ('{"_c": "", "B": 0}', '"SUB_SBS": {"_c": "", "B": 0, "C": 1}'),
    ],
)
def test_a_sub_is_attached_in_the_form_that_is_there(written: str | None, expected: str) -> None:
    header = f'"HEADER": {{"SUB_SBS": {written}}}, ' if written else ""
    text = f'{{"A": {{{header}"S00": {{}}, "S11": {{}}}}, "B": {{}}, "C": {{}}}}'
    before = read(text.replace("S00", "State00").replace("S11", "State11"))
    after = edit.attach_sub(before, "A", 1, "C")
    assert expected in after.document.text
    assert after["A"].subs[1] == "C"
    changes(before, after)
    if "B" in (written or ""):
        assert edit.detach_sub(after, "A", "C").document.text == before.document.text


def test_num_facts_says_how_many_digits_an_empty_sb_will_have() -> None:
    before = read({"A": {"HEADER": {"NUM_FACTS": 3}}, "B": {}})
    assert edit.attach_sub(before, "A", 2, "B")["A"].subs == {2: "B"}


def test_the_layout_is_rounded_and_other_places_stay() -> None:
    before = read(FACTS_BOUND)
    after = edit.set_layout(before, "A", {"S1": (12.34, -0.04)})
    assert after.document.values["A"]["_layout"] == {"S0": [0, 0], "S1": [12.3, 0]}
    assert changes(before, after) == (['"S1": [9, 9]'], ['"S1": [12.3, 0]'])
    assert after == before, "where a state stands means nothing"
    assert edit.set_layout(before, "A", {"S0": (0.0, 0.0)}) is before
    assert edit.set_layout(before, "A", {}) is before


def test_a_note_is_set_and_taken_away() -> None:
    before = read(FACTS_BOUND)
    after = edit.set_note(before, "A", "_operations", "stay", {"actor": "human", "confirm": ("x",)})
    assert after["A"].operation_note("S0", "stay").confirm == ("x",)
    assert edit.set_note(after, "A", "_operations", "stay", None).document.text == (
        before.document.text
    )
    gone = edit.set_note(before, "A", "_states", "S1", None)
    assert "_states" not in gone.document.text
    assert edit.set_note(before, "B", "_states", "T0", None) is before


BOUND = read(FACTS_BOUND)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda: edit.add_branch(BOUND, ""), "needs a name"),
        (lambda: edit.add_branch(BOUND, " \t"), "needs a name"),
        (lambda: edit.add_branch(BOUND, "A"), "there is already a State Branch 'A'"),
        (lambda: edit.add_branch(BOUND, "_A"), "starts with _"),
        (lambda: edit.add_branch(BOUND, "a\nb"), r"U\+000A"),
        (lambda: edit.add_branch(BOUND, "a\ud800"), r"U\+D800"),
        (lambda: edit.add_state(BOUND, "A", "S1"), "there is already a state 'S1'"),
        (lambda: edit.add_state(BOUND, "A", "HEADER"), "HEADER is the name"),
        (lambda: edit.add_state(BOUND, "C", "S"), "'C'"),
        (lambda: edit.add_state(BOUND, "S0", "S"), "'S0'"),
        (lambda: edit.add_state(BOUND, "A", "S3", (float("nan"), 0)), "not on the canvas"),
        (lambda: edit.add_operation(BOUND, "A", "S0", "up", "S0"), "already an operation 'up'"),
        (lambda: edit.add_operation(BOUND, "A", "S0", "_x", "S0"), "starts with _"),
        (lambda: edit.add_operation(BOUND, "A", "S0", "x", "T0"), "no state 'T0' in A"),
        (lambda: edit.add_operation(BOUND, "A", "T0", "x", "S0"), "no state 'T0' in A"),
        (lambda: edit.rename(BOUND, A("A"), "B"), "already a State Branch 'B'"),
        (lambda: edit.rename(BOUND, A("A", "S0"), "S1"), "already a state 'S1'"),
        (lambda: edit.rename(BOUND, A("A", "S0"), ""), "needs a name"),
        (lambda: edit.rename(BOUND, A("A", "S0", "up"), "stay"), "already an operation 'stay'"),
        (lambda: edit.rename(BOUND, A("A", "S1", "up"), "stay", True), "in S0 an operation 'stay'"),
        (lambda: edit.rename(BOUND, A("A", "S5"), "S6"), "no state 'S5'"),
        (lambda: edit.delete(BOUND, [A("A", "S0", "gone")]), "no operation 'gone'"),
        (lambda: edit.retarget(BOUND, A("A", "S0", "up"), "T1"), "no state 'T1' in A"),
        (lambda: edit.retarget(BOUND, A("A", "S0"), "S1"), "is no operation"),
        (lambda: edit.move_source(BOUND, A("A", "S0", "up"), "T1"), "no state 'T1' in A"),
        (lambda: edit.move_source(BOUND, A("A", "S0", "up"), "S1"), "S1 has an operation 'up'"),
        (lambda: edit.move_source(BOUND, A("A", "S0"), "S1"), "is no operation"),
        (lambda: edit.reorder(BOUND, A("A", "S0"), 2), "outside 0 to 1"),
        (lambda: edit.reorder(BOUND, A("A", "S0"), -1), "outside 0 to 1"),
        (lambda: edit.set_header(BOUND, "A", "INITIAL", "T0"), "INITIAL must name a state of A"),
        (lambda: edit.set_header(BOUND, "A", "ACTIVATING", 3), "ACTIVATING must name a state"),
        (lambda: edit.set_header(BOUND, "A", "NUM_FACTS", 0), "whole number above 0"),
        (lambda: edit.set_header(BOUND, "A", "NUM_FACTS", True), "whole number above 0"),
        (lambda: edit.set_header(BOUND, "B", "NUM_FACTS", 3), "cannot be cut into 3 facts"),
        (lambda: edit.set_header(BOUND, "A", "NUM_STATES", 3), "A has 2 states"),
        (lambda: edit.set_header(BOUND, "A", "SUB_SBS", 3), "SUB_SBS is no header key"),
        (lambda: edit.attach_sub(BOUND, "A", 7, "B"), "no digit 7"),
        (lambda: edit.attach_sub(BOUND, "B", 0, "A"), "B > A > B would be a cycle"),
        (lambda: edit.attach_sub(BOUND, "B", 0, "B"), "B > B would be a cycle"),
        (lambda: edit.attach_sub(BOUND, "A", 0, "B"), "already expands digit 0"),
        (lambda: edit.attach_sub(BOUND, "A", 0, "C"), "'C'"),
        (lambda: edit.detach_sub(BOUND, "B", "A"), "expands no fact of B"),
        (lambda: edit.set_layout(BOUND, "A", {"T0": (0, 0)}), "no state 'T0' in A"),
        (lambda: edit.set_layout(BOUND, "A", {"S0": (0, 1e9)}), "not on the canvas"),
        (lambda: edit.set_note(BOUND, "A", "_facts", "7", {}), "no digit '7'"),
        (lambda: edit.set_note(BOUND, "A", "_facts", "00", {}), "no digit '00'"),
        (lambda: edit.set_note(BOUND, "A", "_states", "S7", {}), "no state 'S7'"),
        (lambda: edit.set_note(BOUND, "A", "_operations", "S1/stay", {}), "no operation"),
        (lambda: edit.set_note(BOUND, "A", "_operations", "up", {"cost": -1}), "no entry of"),
        (lambda: edit.set_note(BOUND, "A", "_operations", "up", {"cost": float("inf")}), "inf"),
        (lambda: edit.set_note(BOUND, "A", "_layout", "S0", {}), "no table of annotations"),
        (lambda: edit.set_hazards(BOUND, [{"facts": {}}]), "no hazard"),
    ],
)
def test_nonsense_is_refused_in_a_sentence(change: Callable[[], Blueprint], words: str) -> None:
    text = BOUND.document.text
    with pytest.raises(EditRefused, match=words):
        change()
    assert BOUND.document.text == text


def test_a_digit_is_expanded_once() -> None:
    before = read({"A": {"State00": {}, "State11": {}}, "B": {}, "C": {}})
    once = edit.attach_sub(before, "A", 0, "B")
    with pytest.raises(EditRefused, match="digit 0 of A is already expanded by B"):
        edit.attach_sub(once, "A", 0, "C")
    with pytest.raises(EditRefused, match="B already expands digit 0"):
        edit.attach_sub(once, "A", 1, "B")
    twice = edit.attach_sub(once, "A", 1, "C")
    with pytest.raises(EditRefused, match="C expands digit 1 of A, which would be gone"):
        edit.set_header(twice, "A", "NUM_FACTS", 1)


def test_a_table_that_is_no_map_is_not_overwritten() -> None:
    before = read({"A": {"S0": {}, "_layout": "by hand", "_operations": [1]}})
    with pytest.raises(EditRefused, match="_layout of A is no map") as caught:
        edit.set_layout(before, "A", {"S0": (0, 0)})
    assert caught.value.place == before.document.place(("A", "_layout"))
    after = edit.rename(before, A("A", "S0"), "S1")
    assert after.document.values["A"]["_operations"] == [1]


DOUBLED = '{"A": {"S": {"o": "S"},\n "T": {}, "S": {"p": "T"}},\n "B": {}, "B": {"X": {}}}'


def test_of_a_doubled_name_the_winning_one_is_edited() -> None:
    before = read(DOUBLED)
    after = edit.add_operation(before, "A", "S", "q", "T")
    assert after.document.text == DOUBLED.replace('"p": "T"', '"p": "T", "q": "T"')
    renamed = edit.rename(before, A("A", "S"), "R")
    assert renamed.document.text.count('"R": {') == 2
    assert len(renamed.document.duplicates()) == 2


def test_doubled_text_is_not_dropped_on_the_side() -> None:
    before = read(DOUBLED)
    for address in (A("A", "S"), A("B"), A("A")):
        with pytest.raises(EditRefused, match="is written 2 times") as caught:
            edit.delete(before, [address])
        assert "Keep one of them" in caught.value.advice
    kept = edit.keep_last(edit.keep_last(before, ("A", "S")), ("B",))
    assert kept == before
    assert not kept.document.doubled
    assert list(edit.delete(kept, [A("A", "S"), A("B")])["A"].table) == ["T"]
    with pytest.raises(EditRefused):
        edit.keep_last(kept, ("C",))


def test_an_edit_keeps_what_was_worked_out_about_other_sbs() -> None:
    before = sample("hfsm")
    after = edit.add_state(before, "SB1", "State001")
    assert after["SB2"] is before["SB2"]


def test_a_state_that_comes_in_takes_over_as_activating_only_where_an_sb_is_being_drawn() -> None:
    blueprint = edit.add_branch(new_blueprint(), "SB1")
    for name in ("State_00", "State_10", "State_11"):
        blueprint = edit.add_state(blueprint, "SB1", name)
    after = edit.add_state(blueprint, "SB1", "State_01")
    assert edit.keep_activating(blueprint, after, []) is after
    kept = edit.keep_activating(blueprint, after, ["SB1", "gone"])
    assert kept["SB1"].header.activating == kept["SB1"].activating == "State_11"
    assert edit.keep_activating(blueprint, blueprint, ["SB1"]) is blueprint
    named = edit.set_header(after, "SB1", "ACTIVATING", "State_01")
    assert edit.keep_activating(blueprint, named, ["SB1"]) is named
    one = edit.delete(blueprint, [A("SB1", "State_10"), A("SB1", "State_11")])
    two = edit.add_state(one, "SB1", "State_11")
    assert edit.keep_activating(one, two, ["SB1"]) is two


@pytest.mark.parametrize(
    ("table", "added", "activating"),
    [
        ({"A": {}, "B": {}}, {"C": {}}, "C"),
        ({"A": {"go": "B"}, "B": {}}, {"B": {"on": "C"}, "C": {}}, "C"),
        ({"A": {"go": "B"}, "B": {}}, {"B": {"on": "C"}, "C": {"on": "D"}, "D": {}}, "D"),
        ({"A": {"go": "B"}, "B": {}}, {"C": {}}, "B"),
        ({"A": {"go": "B"}, "B": {}}, {"A": {"go": "B", "fail": "C"}, "C": {}}, "B"),
        ({"A": {}, "B": {"back": "A"}}, {"B": {"back": "A", "on": "C"}, "C": {}}, "B"),
    ],
)
def test_while_an_sb_is_being_drawn_only_what_goes_on_takes_over(
    table: dict[str, Any], added: dict[str, Any], activating: str
) -> None:
    before, after = read({"SB1": table}), read({"SB1": {**table, **added}})
    kept = edit.keep_activating(before, after, [])
    assert kept["SB1"].activating == activating
    assert kept["SB1"].header.activating == (None if activating not in table else activating)
