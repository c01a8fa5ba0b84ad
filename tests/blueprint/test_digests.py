"""The three digests: which change alters which digest, and which change alters none."""

from __future__ import annotations

import json
from collections.abc import Callable
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint.digests import Digests, digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.front.inputs import read as read_file
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.json_form import parse_json

Json = dict[str, Any]

FILE: Json = {
    "_hazards": [{"name": "both", "facts": {"A/0": "1", "B/0": "1"}}],
    "A": {
        "HEADER": {"SUB_SBS": {"B": 0}},
        "State0": {"go": "State1", "wait": "State0"},
        "State1": {"back": "State0"},
        "_operations": {"go": {"title": "Go", "timeout": 5}, "State0/wait": {"cost": 2}},
        "_facts": {"0": {"name": "ready"}},
    },
    "B": {"State0": {"x": "State1"}, "State1": {}},
}


def blueprint(values: Json, file: str = "x.json") -> Blueprint:
    return read_blueprint(parse_json(json.dumps(values), file))


def of(values: Json) -> Digests:
    return digests(blueprint(values))


def changed(edit: Callable[[Json], object]) -> set[str]:
    """The digests that an edit of the file changes; equality must say the same."""
    values = deepcopy(FILE)
    edit(values)
    before, after = of(FILE).as_json(), of(values).as_json()
    assert (blueprint(values) == blueprint(FILE)) == (before == after)
    return {kind for kind in before if before[kind] != after[kind]}


BOTH, NOTES = {"behaviour", "closure"}, {"meaning", "closure"}


@pytest.mark.parametrize(
    ("edit", "kinds"),
    [
        (lambda v: v["A"]["State0"].update(go="State0"), BOTH),
        (lambda v: v["A"].update(State2={}), BOTH),
        (lambda v: v["A"]["State0"].pop("wait"), BOTH),
        (lambda v: v["A"]["HEADER"].update(INITIAL="State1"), BOTH),
        (lambda v: v["A"]["HEADER"].update(SUB_SBS={}), BOTH),
        (lambda v: v.update(A=v.pop("A")), BOTH),
        (lambda v: v["A"]["_operations"]["go"].update(title="Go on"), NOTES),
        (lambda v: v["A"]["_operations"]["State0/wait"].update(cost=3), NOTES),
        (lambda v: v["A"].update(_states={"State0": {"safe": True}}), NOTES),
        (lambda v: v["A"]["_facts"]["0"].update(on="0"), NOTES),
        (lambda v: v.update(_hazards=[]), NOTES),
        (lambda v: v["B"].update(_operations={"x": {"nonsense": 1}}), NOTES),
        (lambda v: v.update(_levels={"supervision": "human"}), NOTES),
        (lambda v: v.update(_levels={"A/State0/go": "human"}), NOTES),
        (lambda v: v.update(_levels={"A/0": ["odd"]}), NOTES),
        (lambda v: v.update(_levels=["odd"]), NOTES),
        (lambda v: v["A"]["_operations"]["go"].update(escalates_to="head"), NOTES),
    ],
)
def test_a_change_of_meaning_changes_its_digest(
    edit: Callable[[Json], object], kinds: set[str]
) -> None:
    assert changed(edit) == kinds


@pytest.mark.parametrize(
    "edit",
    [
        lambda v: v["A"].update(_layout={"State0": [1, 2]}, _comment="c"),
        lambda v: v["A"]["HEADER"].update(NUM_STATES=2, OTHER=1, _x=1),
        lambda v: v["A"]["HEADER"].update(INITIAL="State0", ACTIVATING="State1", NUM_FACTS=1),
        lambda v: v["A"]["HEADER"].update(SUB_SBS=[{"B": 0}]),
        lambda v: v["A"].update(State0={"wait": "State0", "go": "State1", "_c": 1}),
        lambda v: v["A"]["_operations"]["go"].update(cost=1, subs="drive", repeatable=False),
        lambda v: v["A"]["_operations"].update(back={"cost": 1.0, "confirm": []}),
        lambda v: v["A"]["_operations"]["go"].update(timeout=5.0),
        lambda v: v["A"]["_operations"].update({"State0/go": {"title": "Go", "timeout": 5}}),
        lambda v: v["A"]["_facts"]["0"].update(on="1", aggregation="single", critical=False),
        lambda v: v["A"].update(_states={"State0": {}, "State1": {"note": ""}}),
        lambda v: v.update(_imports=[]),
        lambda v: v.update(_levels={"supervision": "shared", "inspection": "automatic"}),
        lambda v: v.update(_levels={}),
    ],
)
def test_what_means_nothing_changes_no_digest(edit: Callable[[Json], object]) -> None:
    assert changed(edit) == set()


def test_what_an_edge_says_counts_against_what_its_name_says() -> None:
    def costs(**edge: object) -> Json:
        return {"A": {**FILE["A"], "_operations": {"go": {"cost": 4}, "State0/go": edge}}}

    assert of(costs()) == of(costs(cost=4.0)) != of(costs(cost=1))
    assert of(costs(cost=1)) == of(costs(cost=None))


def test_the_order_of_states_counts_through_the_defaults_alone() -> None:
    states: Json = {"State0": {}, "State1": {}, "State2": {}}
    turned: Json = {"State0": {}, "State2": {}, "State1": {}}
    header = {"HEADER": {"INITIAL": "State0", "ACTIVATING": "State2"}}
    assert of({"A": {**header, **states}}) == of({"A": {**header, **turned}})
    assert of({"A": states}).behaviour != of({"A": turned}).behaviour


def test_the_order_of_hazards_means_nothing() -> None:
    hazards = [{"name": name, "facts": {"A/0": "1"}} for name in "ab"]
    assert of({"_hazards": hazards}) == of({"_hazards": hazards[::-1]})
    assert of({"_hazards": hazards}) != of({"_hazards": hazards[:1]})


def test_the_closure_covers_what_is_imported(tmp_path: Path) -> None:
    def put(name: str, values: Json) -> Path:
        path = tmp_path / name
        path.write_text(json.dumps(values), "utf-8")
        return path

    base = put("base.json", {"_imports": ["sub.json"], "A": FILE["A"]})
    put("sub.json", {"B": FILE["B"]})
    before = digests(read_file(base))
    assert digests(read_file(base.rename(tmp_path / "other.json"))) == before
    put("sub.json", {"B": {**FILE["B"], "State1": {"y": "State0"}}})
    after = digests(read_file(tmp_path / "other.json"))
    assert (after.behaviour, after.meaning) == (before.behaviour, before.meaning)
    assert after.closure != before.closure
    put("sub.json", {"B": {**FILE["B"], "_operations": {"x": {"title": "X"}}}})
    named = digests(read_file(tmp_path / "other.json"))
    assert named.closure not in (before.closure, after.closure)
    put("sub.json", {"B": FILE["B"], "_levels": {"B/State0/x": "human"}})
    leveled = digests(read_file(tmp_path / "other.json"))
    assert (leveled.behaviour, leveled.meaning) == (before.behaviour, before.meaning)
    assert leveled.closure not in (before.closure, after.closure)
    (tmp_path / "sub.json").unlink()
    missing = digests(read_file(tmp_path / "other.json"))
    assert missing.closure not in (before.closure, after.closure, of({"A": FILE["A"]}).closure)


@pytest.mark.parametrize(
    "values",
    [
        {"A": {"HEADER": {"SUB_SBS": {"B": 10**40}, "NUM_FACTS": 10**40}, "S": {}}},
        {"A": {"_facts": {"0": {"x": 10**40}, "٣": {}, "x": {}}, "_states": 7, "_operations": []}},
        {"A": {"_operations": {"a": {"binding": {"function": "f", "arguments": {"n": 10**40}}}}}},
        {"_hazards": 10**40, "_imports": 10**40},
        {"_hazards": [10**40, {"name": 1}, {"name": "h", "facts": {"A/0": "1"}}]},
    ],
)
def test_whatever_stands_in_a_file_has_a_digest(values: Json) -> None:
    assert of(values) == of(deepcopy(values))
    assert of(values) != of({"A": {"S": {}}})


def test_no_digest_of_a_sample_is_that_of_another() -> None:
    found = [digests(read_file(path)) for path in sorted(samples_dir().glob("*.json"))]
    assert len({one.closure for one in found}) == len(found)
    assert all(len(kind) == 64 for one in found for kind in one.as_json().values())
