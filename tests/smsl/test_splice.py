"""Reconcile changes the text only where values change."""

from __future__ import annotations

import json
import random
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.smsl.json_form import parse_json
from smsl_studio.smsl.json_form.spans import LONG, JsonSpans
from smsl_studio.smsl.splice import keep_winner, reconcile
from tests.counts import share_of
from tests.smsl.texts import VALUES, written

Json = Any


def after(text: str, values: Json) -> str:
    document = reconcile(parse_json(text, "f.json"), values)
    again = parse_json(document.text, "f.json")
    assert json.dumps(again.values) == json.dumps(document.values)
    assert again.values == values
    return document.text


def movable(values: Json, depth: int = 0, free: bool = False) -> Json:
    """The values with the order of the keys that the text has to follow made part of them."""
    if isinstance(values, dict):
        keys = [k for k in values if not k.startswith("_") and not (k == "HEADER" and depth == 1)]
        inner = {
            key: movable(value, depth + 1, key == "HEADER" and depth == 1)
            for key, value in values.items()
        }
        return sorted(keys) if free else keys, inner
    return [movable(item, depth + 1) for item in values] if isinstance(values, list) else values


@settings(max_examples=share_of(400))
@given(VALUES, VALUES, st.integers(0, 10**6))
def test_any_text_comes_to_read_to_any_values(old: Json, new: Json, seed: int) -> None:
    document = parse_json(written(old, seed), "f.json")
    changed = reconcile(document, new)
    again = parse_json(changed.text, "f.json")
    assert movable(again.values) == movable(new)
    assert json.dumps(again.values) == json.dumps(changed.values)
    assert reconcile(changed, new).text == changed.text


@settings(max_examples=share_of(200))
@given(VALUES, st.integers(0, 10**6))
def test_values_that_do_not_differ_change_nothing(values: Json, seed: int) -> None:
    document = parse_json(written(values, seed), "f.json")
    assert reconcile(document, json.loads(json.dumps(values))) is document


@settings(max_examples=share_of(200))
@given(VALUES, st.integers(0, 10**6), st.data())
def test_one_more_key_is_put_in_and_nothing_else_moves(
    values: Json, seed: int, data: st.DataObject
) -> None:
    before = written(values, seed)
    changed = dict(values)
    if values:
        branch = data.draw(st.sampled_from(sorted(values)))
        if isinstance(values[branch], dict):
            changed[branch] = {**values[branch], "fresh": {}}
    changed["another fresh"] = {}
    text = reconcile(parse_json(before, "f.json"), changed).text
    rest = iter(text)
    assert all(char in rest for char in before if not char.isspace()), "in its old order"


LINES = """{
    "A": {
        "HEADER": {},

        "S": {
            "a": "S",
            "b": "T"
        },
        "_note": "between",
        "T": { },
        "U": {"only": "S"}
    }
}
"""


def values() -> Json:
    return json.loads(LINES)


def test_adding_takes_the_layout_of_the_neighbours() -> None:
    new = values()
    new["A"]["S"]["c"] = "U"
    assert after(LINES, new) == LINES.replace('"b": "T"\n', '"b": "T",\n            "c": "U"\n')
    new = values()
    new["A"]["U"]["more"] = "T"
    assert after(LINES, new) == LINES.replace('"only": "S"', '"only": "S", "more": "T"')
    new = values()
    new["A"]["T"]["first"] = "S"
    assert after(LINES, new) == LINES.replace(
        '"T": { }', '"T": {\n            "first": "S"\n        }'
    )


def test_removing_takes_the_line_and_a_comma() -> None:
    new = values()
    del new["A"]["S"]["a"]
    assert after(LINES, new) == LINES.replace('            "a": "S",\n', "")
    new = values()
    del new["A"]["S"]["b"]
    assert after(LINES, new) == LINES.replace('"a": "S",\n            "b": "T"\n', '"a": "S"\n')
    new = values()
    del new["A"]["U"]["only"]
    assert after(LINES, new) == LINES.replace('{"only": "S"}', "{}")


def test_what_is_emptied_and_filled_again_is_as_before() -> None:
    new = values()
    new["A"]["S"].clear()
    emptied = after(LINES, new)
    assert '"S": {\n        },' in emptied
    assert after(emptied, values()) == LINES


def test_a_rename_splices_the_key_and_leaves_the_value() -> None:
    new = {"A": {("R" if key == "S" else key): value for key, value in values()["A"].items()}}
    assert after(LINES, new) == LINES.replace('"S": {', '"R": {')


def test_a_reorder_moves_texts_between_gaps_and_skipped_names_stay() -> None:
    old = values()["A"]
    new = {"A": {key: old[key] for key in ("HEADER", "T", "_note", "S", "U")}}
    text = reconcile(parse_json(LINES, "f.json"), new).text
    assert text == LINES.replace('"T": { }', '"@"').replace(
        '"S": {\n            "a": "S",\n            "b": "T"\n        }', '"T": { }'
    ).replace('"@"', '"S": {\n            "a": "S",\n            "b": "T"\n        }')


def test_the_elements_of_a_list_change_one_by_one() -> None:
    text = '{\n  "_h": [\n    {"name": "x"},\n    {"name":   "y"},\n    3\n  ]\n}'
    new = {"_h": [{"name": "x"}, {"name": "z"}, 3]}
    assert after(text, new) == text.replace('"y"', '"z"')
    assert after(text, {"_h": [{"name": "x"}, 3]}) == text.replace('    {"name":   "y"},\n', "")
    assert after(text, {"_h": [{"name": "x"}, {"name": "y"}, 4, 3]}) == text.replace(
        "    3", "    4,\n    3"
    )
    assert after(text, {"_h": []}) == '{\n  "_h": [\n  ]\n}'


def test_line_ends_tabs_bom_and_a_missing_last_line_end_are_kept() -> None:
    text = '\ufeff{\r\n\t"A": {\r\n\t\t"S": {\r\n\t\t\t"a": "S"\r\n\t\t}\r\n\t}\r\n}'
    new = {"A": {"S": {"a": "S", "b": "T"}, "T": {"c": "S"}}}
    assert reconcile(parse_json(text, "f"), new).text == (
        '\ufeff{\r\n\t"A": {\r\n\t\t"S": {\r\n\t\t\t"a": "S",\r\n\t\t\t"b": "T"\r\n\t\t},\r\n'
        '\t\t"T": {\r\n\t\t\t"c": "S"\r\n\t\t}\r\n\t}\r\n}'
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('{"A":{"S":{"a":"S"}}}', '{"A":{"S":{"a":"S"},"T":{"b":"S","c":"S"}}}'),
        ('{"A": {"S": {"a": "S"}}}', '{"A": {"S": {"a": "S"}, "T": {"b": "S", "c": "S"}}}'),
        (
            '{\n "A": {\n  "S": {"a": "S"}\n }\n}',
            '{\n "A": {\n  "S": {"a": "S"},\n  "T": {"b": "S", "c": "S"}\n }\n}',
        ),
    ],
)
def test_a_new_state_is_written_as_the_others_are(text: str, expected: str) -> None:
    assert after(text, {"A": {"S": {"a": "S"}, "T": {"b": "S", "c": "S"}}}) == expected


def test_escaped_names_are_left_as_they_were_written() -> None:
    text = '{"\\u0041": {"S\\/T": {}}}'
    assert after(text, {"A": {"S/T": {"o": "S/T"}}}) == '{"\\u0041": {"S\\/T": {"o": "S/T"}}}'


DOUBLED = '{"A": {"S": {"a": "S"},  "T": {}, "S": {"b": "T"}}}'


def test_the_winning_one_of_two_is_edited_and_the_other_stays() -> None:
    new = {"A": {"S": {"b": "S"}, "T": {}}}
    assert after(DOUBLED, new) == DOUBLED.replace('"b": "T"', '"b": "S"')
    added = {"A": {"S": {"b": "T"}, "T": {}, "U": {}}}
    assert reconcile(parse_json(DOUBLED, "f"), added).text.count('"S": {') == 2


def test_keeping_the_winner_keeps_the_values_and_their_order() -> None:
    before = parse_json(DOUBLED, "f")
    kept = keep_winner(before, ("A", "S"))
    assert kept.text == '{"A": {"S": {"b": "T"},  "T": {}}}'
    assert json.dumps(kept.values) == json.dumps(before.values)
    assert kept.duplicates() == ()
    with pytest.raises(KeyError):
        keep_winner(before, ("A", "gone"))


def long_values(count: int) -> dict[str, dict[str, Json]]:
    states = {f"s{n}": {"go": f"s{(n + 1) % count}", "back": f"s{n - 1}"} for n in range(count)}
    places = {f"s{n}": [n, 0] for n in range(count)}
    return {"SB1": {"HEADER": {"INITIAL": "s0"}, **states, "_layout": places}, "SB2": {"a": {}}}


def edited(values: dict[str, dict[str, Json]], chance: random.Random) -> dict[str, dict[str, Json]]:
    """The values with one state renamed, added, deleted, placed, or in another place."""
    branch = dict(values["SB1"])
    states = [key for key in branch if key not in ("HEADER", "_layout")]
    chosen, fresh = chance.choice(states), f"n{chance.randrange(10**9)}"
    kind = chance.randrange(5)
    if kind == 0:
        branch = {fresh if key == chosen else key: value for key, value in branch.items()}
        for key in chance.sample([*branch][1:-1], 3):
            branch[key] = {**branch[key], "go": fresh}
    elif kind == 1:
        branch[fresh] = {"go": chosen}
        branch["_layout"] = {**branch["_layout"], fresh: [1, 2]}
    elif kind == 2:
        del branch[chosen]
        branch["_layout"] = {k: v for k, v in branch["_layout"].items() if k != chosen}
    elif kind == 3:
        branch["_layout"] = {**branch["_layout"], chosen: [chance.randrange(99), 1]}
    else:
        items = [item for item in branch.items() if item[0] != chosen]
        items.insert(chance.randrange(1, len(items)), (chosen, branch[chosen]))
        branch = dict(items)
    return {**values, "SB1": branch}


@pytest.mark.parametrize("seed", range(20))
def test_where_things_stand_is_known_after_each_edit_of_a_long_text(seed: int) -> None:
    chance = random.Random(seed)
    values = long_values(150)
    assert len(json.dumps(values["SB1"]["_layout"])) < LONG < len(json.dumps(values))
    document = parse_json(written(values, seed), "f.json")
    document.members(("SB1", "_layout"))
    for _ in range(12):
        document = reconcile(document, edited(dict(document.values), chance))
        again = parse_json(document.text, "f.json")
        assert json.dumps(again.values) == json.dumps(document.values)
        assert isinstance(document.spans, JsonSpans)
        known = document.spans.long_rows
        assert known.keys() >= {(), ("SB1",)}
        for path in known:
            assert document.members(path) == again.members(path)
