"""Edits of many annotations at once change only the given keys."""

from __future__ import annotations

import json
from typing import Any

import pytest

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.smsl.json_form import parse_json

ODD = {"cost": "dear", "title": "Go"}


def read(**fields: object) -> Blueprint:
    values = {"A": {"S0": {"o": "S1", "p": "S1"}, "S1": {"o": "S0"}, **fields}}
    return read_blueprint(parse_json(json.dumps(values, indent=2), "f"))


def test_many_entries_change_in_one_edit_and_empty_ones_go() -> None:
    before = read()
    both: dict[tuple[str, str], dict[str, Any]] = {
        ("A", "o"): {"cost": 2.5},
        ("A", "S0/p"): {"cost": 2.5, "title": None},
    }
    after = edit.change_notes(before, "_operations", both)
    assert after["A"].fields["_operations"] == {"o": {"cost": 2.5}, "S0/p": {"cost": 2.5}}
    back = edit.change_notes(after, "_operations", {key: {"cost": None} for key in both})
    assert back.document.text == before.document.text


def test_what_fits_no_kind_stays_beside_what_is_changed() -> None:
    before = read(_operations={"o": ODD})
    after = edit.change_notes(before, "_operations", {("A", "o"): {"risk": "low"}})
    assert after["A"].fields["_operations"]["o"] == {**ODD, "risk": "low"}
    mended = edit.change_notes(after, "_operations", {("A", "o"): {"cost": 3}})
    assert mended["A"].cost("S0", "o") == 3
    assert not mended["A"].notes.faults


@pytest.mark.parametrize(
    ("table", "key", "words", "said"),
    [
        ("_operations", "o", {"cost": -1}, "greater than or equal to 0"),
        ("_operations", "S1/p", {"cost": 1}, "no operation"),
        ("_operations", "a/b/c", {"cost": 1}, "no operation"),
        ("_facts", "9" * 5000, {"name": "x"}, "no digit"),
        ("_states", "S0", {"title": "x"}, "is no map"),
        ("_layout", "S0", {"x": 1}, "no table of annotations"),
    ],
)
def test_nonsense_is_refused(table: str, key: str, words: dict[str, object], said: str) -> None:
    with pytest.raises(EditRefused, match=said):
        edit.change_notes(read(_states={"S0": "words"}), table, {("A", key): words})


def test_a_hazard_that_fits_no_kind_is_kept_while_others_change() -> None:
    values = {"_hazards": [{"name": 5}], "A": {"S0": {}}}
    before = read_blueprint(parse_json(json.dumps(values), "f"))
    good = {"name": "both", "facts": {"A/0": "0"}}
    after = edit.set_hazards(before, [{"name": 5}, good])
    assert after.fields["_hazards"] == [{"name": 5}, good]
    with pytest.raises(EditRefused, match="no hazard"):
        edit.set_hazards(before, [{"name": 5}, {"name": 6}])
    odd = read_blueprint(parse_json('{"_hazards": "none", "A": {}}', "f"))
    with pytest.raises(EditRefused, match="no list"):
        edit.set_hazards(odd, [good])
