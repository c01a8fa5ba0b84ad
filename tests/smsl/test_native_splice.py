"""Reconcile in the native form changes the text only where values change."""

from __future__ import annotations

import copy
import difflib
import json
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.errors import ConvertError
from smsl_studio.smsl.native_form import parse
from smsl_studio.smsl.splice import reconcile
from tests.counts import share_of
from tests.smsl.native_texts import native, plain
from tests.smsl.test_splice import edited, long_values, movable
from tests.smsl.texts import VALUES

Json = Any
EXAMPLE = (Path(__file__).parents[2] / "samples" / "example.smsl").read_text("utf-8")


def mixed(old: Json, new: Json, chance: random.Random) -> Json:
    """Values that have much in common with both."""
    keys = list(dict.fromkeys([*old, *new]))
    if chance.random() < 0.3:
        chance.shuffle(keys)
    result = {}
    for key in keys:
        luck = chance.random()
        one, other = old.get(key, new.get(key)), new.get(key, old.get(key))
        if isinstance(one, dict) and isinstance(other, dict) and luck > 0.2:
            result[key] = mixed(one, other, chance)
        elif luck > 0.1:
            result[key] = one if luck < 0.7 else other
    return result


@settings(max_examples=share_of(150), deadline=None)
@given(VALUES, VALUES, st.integers(0, 10**6))
def test_any_text_comes_to_read_to_any_values(old: Json, new: Json, seed: int) -> None:
    chance = random.Random(seed)
    if chance.random() < 0.6:
        new = mixed(old, new, chance)
    document = parse(native(old, seed), "f.smsl")
    changed = reconcile(document, new)
    again = parse(changed.text, "f.smsl")
    assert movable(again.values) == movable(plain(new))
    assert json.dumps(again.values) == json.dumps(changed.values)
    assert reconcile(changed, new).text == changed.text


@settings(max_examples=share_of(60), deadline=None)
@given(VALUES, st.integers(0, 10**6))
def test_values_that_do_not_differ_change_nothing(values: Json, seed: int) -> None:
    document = parse(native(values, seed), "f.smsl")
    assert reconcile(document, json.loads(json.dumps(plain(values)))) is document


@settings(max_examples=share_of(100), deadline=None)
@given(VALUES, st.integers(0, 10**6))
def test_one_more_element_is_put_in_and_nothing_else_moves(values: Json, seed: int) -> None:
    before = native(values, seed)
    changed = {**plain(values), "another fresh": {"fresh": {"a": "fresh"}}}
    names = [name for name in values if not name.startswith("_")]
    if names:
        branch = changed[random.Random(seed).choice(names)]
        branch["fresh"] = {}
    rest = iter(reconcile(parse(before, "f.smsl"), changed).text)
    assert all(char in rest for char in before if not char.isspace()), "in its old order"


def diff(change: Callable[[Json], object], text: str = EXAMPLE) -> list[str]:
    """The lines that one change of the values takes out of and puts into the text."""
    document = parse(text, "f.smsl")
    values = copy.deepcopy(dict(document.values))
    change(values)
    after = reconcile(document, values)
    assert parse(after.text, "f.smsl").values == plain(values)
    lines = difflib.ndiff(text.splitlines(), after.text.splitlines())
    return [line for line in lines if line[0] in "+-"]


def renamed(table: Json, old: str, new: str) -> None:
    items = [(new if key == old else key, value) for key, value in table.items()]
    table.clear()
    table.update(items)


def test_an_edit_touches_the_lines_of_its_element() -> None:
    assert diff(lambda v: v["SB1"]["State100"].update(More="State000")) == [
        "-         Operation100B -> State111",
        "+         Operation100B -> State111,",
        "+         More -> State000",
    ]
    assert diff(lambda v: v["SB1"]["State000"].update({"a b": "State111"})) == [
        "-     State000: [Operation000 -> State100],",
        '+     State000: [Operation000 -> State100, "a b" -> State111],',
    ]
    assert diff(lambda v: v["SB1"]["State111"].update(Back="State000")) == [
        "-     State111: [ ]",
        "+     State111: [Back -> State000]",
    ]
    assert diff(lambda v: v["SB1"]["State000"].clear()) == [
        "-     State000: [Operation000 -> State100],",
        "+     State000: [ ],",
    ]
    assert diff(lambda v: v["SB1"]["State100"].pop("Operation100A")) == [
        "-         Operation100A -> State110,"
    ]
    assert diff(lambda v: v["SB1"]["State100"].update(Operation100B="State000")) == [
        "-         Operation100B -> State111",
        "+         Operation100B -> State000",
    ]
    assert diff(lambda v: v["SB2"].update(New={"a": "State0", "b": "State1"})) == [
        "+     New: [",
        "+         a -> State0,",
        "+         b -> State1",
        "+     ]",
    ]
    assert diff(lambda v: v.update(SB3={"HEADER": {"INITIAL": "S"}, "S": {}})) == [
        "+ },",
        "+ {",
        "+     # NAME: SB3",
        "+     # INITIAL: S",
        "+ ",
        "+     S: [ ]",
    ]
    assert diff(lambda v: v["SB1"].update(_layout={"S": [1, 2.5]})) == [
        '+     # _layout: {"S": [1, 2.5]}'
    ]
    field = diff(lambda v: v["SB1"]["State000"].update(_note="x"))
    assert [line for line in field if line[0] == "-"] == [
        "-     State000: [Operation000 -> State100],"
    ]
    assert [line for line in field if line[0] == "+"] == [
        "+     State000: [",
        "+         Operation000 -> State100",
        '+         # _note: "x"',
        "+     ],",
    ]


def test_a_header_edit_touches_its_line() -> None:
    assert diff(lambda v: v["SB1"]["HEADER"].update(ACTIVATING="State111")) == [
        "+     # ACTIVATING: State111"
    ]
    assert diff(lambda v: v["SB1"]["HEADER"].pop("INITIAL")) == ["-     # INITIAL: State000"]
    assert diff(lambda v: v["SB1"]["HEADER"]["SUB_SBS"].update({"SB 3": 0})) == [
        "-     # SUB_SBS: (SB2: 1)",
        '+     # SUB_SBS: (SB2: 1, "SB 3": 0)',
    ]
    assert diff(lambda v: v["SB2"].update(HEADER={"NUM_FACTS": 1})) == ["+     # NUM_FACTS: 1"]
    text = "{ #NAME:A\n#X:1,// one\n#Y:a text // two\n#NOTE:z\n}"
    assert diff(lambda v: v["A"]["HEADER"].update(X="a, b"), text) == [
        "- #X:1,// one",
        "+ #X:a, b // one",
    ]
    assert diff(lambda v: v["A"]["HEADER"].update(Z=1), text) == ["+ #Z:1"]


def test_a_rename_splices_the_name() -> None:
    assert diff(lambda v: renamed(v["SB1"], "State100", "State 1")) == [
        "-     State100: [",
        '+     "State 1": [',
    ]
    assert diff(lambda v: renamed(v, "SB2", "SB9")) == ["-     # NAME: SB2", "+     # NAME: SB9"]
    assert diff(lambda v: renamed(v["SB1"]["State100"], "Operation100A", "Go")) == [
        "-         Operation100A -> State110,",
        "+         Go -> State110,",
    ]


COMMENTED = """// a licence

{ // opened
    # NAME: A // the name
    # INITIAL: S // where it begins

    // about S
    S: [ // of S
        // about a
        a -> S, // of a
        // about b
        b -> T // of b
        // at the end
    ],

    // about T
    T: [c -> S] // of T
} // of A
// the last
"""


def test_comments_survive_an_edit_beside_them() -> None:
    def gone(change: Callable[[Json], object]) -> set[str]:
        lines = diff(change, COMMENTED)
        before = {line[line.index("//") :] for line in lines if line[0] == "-" and "//" in line}
        after = {line[line.index("//") :] for line in lines if line[0] == "+" and "//" in line}
        return before - after

    assert gone(lambda v: v["A"]["S"].update(a="T")) == set()
    assert gone(lambda v: v["A"]["S"].update(z="T")) == set()
    assert gone(lambda v: v["A"]["S"].pop("b")) == {"// of b"}
    assert gone(lambda v: v["A"]["S"].pop("a")) == {"// of a"}
    assert gone(lambda v: v["A"]["S"].clear()) == {"// of a", "// of b"}
    assert gone(lambda v: v["A"]["HEADER"].update(INITIAL="T")) == set()
    assert gone(lambda v: v["A"].pop("T")) == {"// of T"}
    assert gone(lambda v: v["A"].update(U={})) == set()
    assert gone(lambda v: renamed(v, "A", "B")) == set()
    assert gone(lambda v: v.update(B={})) == set()


def test_a_reorder_takes_the_comments_of_an_element_along() -> None:
    document = parse(COMMENTED, "f")
    branch = document.values["A"]
    swapped = {"A": {key: branch[key] for key in ("HEADER", "T", "S")}}
    text = reconcile(document, swapped).text
    assert "    // about T\n    T: [c -> S], // of T\n\n    // about S\n    S: [ // of S\n" in text
    assert text.startswith("// a licence\n\n{ // opened\n")
    turned = {"A": {**branch, "S": dict(reversed(branch["S"].items()))}}
    text = reconcile(document, turned).text
    assert (
        "        // about b\n        b -> T, // of b\n        // about a\n        a -> S // of a"
        in text
    )


def test_the_layout_of_the_neighbours_is_taken() -> None:
    text = "\ufeff{\r\n\t#NAME:A\r\n\tS:[\r\n\t\ta->S\r\n\t\tb->S\r\n\t]\r\n\tT:[]\r\n}"
    document = parse(text, "f.smsl")
    new = {"A": {"S": {"a": "S", "b": "S", "c": "T"}, "T": {}, "U": {"a": "S", "b": "T"}}}
    assert reconcile(document, new).text == (
        "\ufeff{\r\n\t#NAME:A\r\n\tS:[\r\n\t\ta->S\r\n\t\tb->S\r\n\t\tc->T\r\n\t]\r\n\tT:[]\r\n"
        "\tU:[\r\n\t\ta->S\r\n\t\tb->T\r\n\t]\r\n}"
    )
    one_line = "{ # NAME: A\nS: [a -> S] T: [ ] }"
    assert reconcile(parse(one_line, "f"), {"A": {"S": {}, "T": {"b": "T"}}}).text == (
        "{ # NAME: A\nS: [ ] T: [b -> T] }"
    )


def test_a_new_file_is_written_from_nothing() -> None:
    for text in ("", "\ufeff", "// only a comment", "\r\n"):
        document = reconcile(parse(text, "f.smsl"), {"A": {"S": {}}})
        assert parse(document.text, "f.smsl").values == {"A": {"S": {}}}
        assert document.text.startswith(text.strip("\r\n"))


def test_what_has_no_spelling_is_refused() -> None:
    document = parse(EXAMPLE, "f.smsl")
    branch = document.values["SB2"]
    for wrong in ({"HEADER": {"INITIAL": 5}, **branch}, {"S": {"o": 5}}, {"S": 5}, 5):
        with pytest.raises(ConvertError, match="SB2"):
            reconcile(document, {**document.values, "SB2": wrong})


def test_the_winning_one_of_two_is_edited_and_the_other_stays() -> None:
    text = "{ # NAME: A\nS: [a -> S]\nT: [ ]\nS: [b -> T]\n}"
    document = parse(text, "f.smsl")
    assert document.values == {"A": {"S": {"b": "T"}, "T": {}}}
    edited = reconcile(document, {"A": {"S": {"b": "S"}, "T": {}}})
    assert edited.text == text.replace("b -> T", "b -> S")
    added = reconcile(document, {"A": {"S": {"b": "T"}, "U": {}, "T": {}}})
    assert added.text.count("S: [") == 2


@pytest.mark.parametrize("seed", range(20))
def test_where_things_stand_is_known_after_each_edit_of_a_long_text(seed: int) -> None:
    chance = random.Random(seed)
    document = parse(native(long_values(30), seed), "f.smsl")
    for _ in range(12):
        document = reconcile(document, edited(dict(document.values), chance))
        assert "spans" in document.__dict__, "nothing is looked for again"
        again = parse(document.text, "f.smsl")
        assert json.dumps(again.values) == json.dumps(document.values)
        for path in ((), ("SB1",), ("SB1", "HEADER"), ("SB1", "_layout")):
            assert document.members(path) == again.members(path)
