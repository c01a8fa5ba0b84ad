"""Levels of autonomy: who acts, senses, inspects and supervises, and the human share."""

from __future__ import annotations

import json
from typing import Any

import pytest

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison.compare import compare
from smsl_studio.blueprint.levels import Levels, spectrum
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused, UsageError
from smsl_studio.smsl.json_form import parse_json

FILE: dict[str, Any] = {
    "A": {
        "HEADER": {"SUB_SBS": {"B": 0}},
        "_facts": {"1": {"aggregation": "human"}},
        "_operations": {
            "go": {"actor": "human"},
            "State_01/go": {"actor": "robot"},
            "push": {"actor": "shared"},
        },
        "State_00": {"go": "State_01", "push": "State_01"},
        "State_01": {"go": "State_01", "rise": "State_11"},
        "State_11": {"1": "State_01"},
    },
    "B": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}},
}


def made(levels: Any = None, file: dict[str, Any] = FILE) -> Blueprint:
    values = file if levels is None else {"_levels": levels, **file}
    return read_blueprint(parse_json(json.dumps(values), "x.json"))


def of(levels: Any = None, before: dict[str, str] | None = None) -> Levels:
    return Levels(made(levels), before or {})


GO, PUSH = Address("A", "State_00", "go"), Address("A", "State_00", "push")
STAY, RISE = Address("A", "State_01", "go"), Address("A", "State_01", "rise")


def test_annotations_say_who_acts_and_who_senses() -> None:
    levels = of()
    assert [levels.operation(one) for one in (GO, PUSH, STAY, RISE)] == [
        "human",
        "shared",
        "automatic",
        "automatic",
    ]
    assert (levels.fact("A", 1), levels.fact("B", 0)) == ("human", "automatic")
    assert (levels.inspection, levels.supervision) == ("automatic", "shared")


def test_levels_of_the_file_win_over_annotations_and_the_edge_over_its_name() -> None:
    levels = of({"A/go": "shared", "A/State_01/go": "human", "A/1": "automatic"})
    assert (levels.operation(GO), levels.operation(STAY)) == ("shared", "human")
    assert levels.fact("A", 1) == "automatic"


def test_what_is_set_before_a_run_wins_over_all() -> None:
    file = {"A/State_01/go": "human", "supervision": "automatic", "inspection": "human"}
    levels = of(file, {"A/go": "automatic", "supervision": "human"})
    assert (levels.operation(GO), levels.operation(STAY)) == ("automatic", "automatic")
    assert (levels.inspection, levels.supervision) == ("human", "human")


def test_a_key_like_a_digit_is_the_fact() -> None:
    levels = of({"A/1": "shared"})
    assert levels.fact("A", 1) == "shared"
    assert levels.operation(Address("A", "State_11", "1")) == "automatic"
    assert of({"A/State_11/1": "human"}).operation(Address("A", "State_11", "1")) == "human"


@pytest.mark.parametrize(
    ("key", "level", "sentence", "advice"),
    [
        ("A/go", "humn", "'humn' is no level of A/go", "Did you mean human?"),
        ("A/go", "x", "'x' is no level of A/go", "Choose one of human, shared, automatic."),
        ("supervison", "human", "'supervison' has no level", "Did you mean supervision?"),
        ("A/gp", "human", "'A/gp' has no level", "Did you mean A/go?"),
        ("A/State_00/rise", "human", "has no level", "Did you mean A/State_01/rise?"),
        ("A/01", "human", "'A/01' has no level", "Did you mean A/1?"),
        ("A/0", "human", "A/0 has no level of its own: B expands it", "Set the levels of what B"),
        ("C/go", "human", "'C/go' has no level", ""),
        ("A", "human", "'A' has no level", ""),
    ],
)
def test_what_is_not_there_has_no_level(key: str, level: str, sentence: str, advice: str) -> None:
    with pytest.raises(UsageError) as refused:
        of(None, {key: level})
    assert sentence in refused.value.sentence
    assert refused.value.advice.startswith(advice)
    with pytest.raises(EditRefused) as edited:
        edit.set_levels(made(), {key: level})
    assert edited.value.sentence == refused.value.sentence


def test_odd_levels_of_a_file_do_not_count() -> None:
    levels = of({"A/go": 5, "A/push": "robot", "supervision": None, "A/1": ["human"]})
    assert (levels.operation(GO), levels.operation(PUSH)) == ("human", "shared")
    assert of(["human"]).supervision == "shared"


def test_the_spectrum_counts_and_weighs_every_kind_alike() -> None:
    found = spectrum(made({"inspection": "human"}))
    assert [(s.kind, s.human, s.shared, s.automatic) for s in found.shares] == [
        ("inspection", 1, 0, 0),
        ("operations", 1, 1, 5),
        ("facts", 1, 0, 1),
        ("supervision", 0, 1, 0),
    ]
    assert [share.position for share in found.shares] == [0, 5.5 / 7, 0.5, 0.5]
    assert found.position == pytest.approx((0 + 5.5 / 7 + 0.5 + 0.5) / 4)


@pytest.mark.parametrize(("level", "position"), [("human", 0), ("shared", 0.5), ("automatic", 1)])
def test_the_ends_of_the_spectrum(level: str, position: float) -> None:
    blueprint = made()
    every = [str(edge.address) for branch in blueprint for edge in branch.edges()]
    keys = [*every, "A/1", "B/0", "inspection", "supervision"]
    assert spectrum(blueprint, Levels(blueprint, dict.fromkeys(keys, level))).position == position


def test_a_kind_that_is_not_there_does_not_count() -> None:
    bare = read_blueprint(parse_json('{"A": {}}', "x.json"))
    assert spectrum(bare).position == pytest.approx((1 + 0.5) / 2)


def test_levels_are_set_changed_and_taken_out_and_the_rest_of_the_text_stays() -> None:
    before = made({"A/odd": 7})
    after = edit.set_levels(before, {"supervision": "human", "A/go": "automatic"})
    assert after.fields["_levels"] == {"A/odd": 7, "supervision": "human", "A/go": "automatic"}
    assert Levels(after).operation(GO) == "automatic"
    assert made() != after
    back = edit.set_levels(after, {"supervision": None, "A/go": None, "A/push": None})
    assert back.document.text == before.document.text
    assert "_levels" not in edit.set_levels(back, {"A/odd": None}).fields
    with pytest.raises(EditRefused, match="no map"):
        edit.set_levels(made([]), {"supervision": "human"})


def test_keys_follow_new_names() -> None:
    keys = ["A/1", "A/go", "A/State_00/go", "A/State_01/rise", "supervision", "B/a", "odd/x"]
    blueprint = made(dict.fromkeys(keys, "human"))

    def now(edited: Blueprint) -> list[str]:
        return list(edited.fields["_levels"])

    assert now(edit.rename(blueprint, Address("A"), "Z/")) == [
        *("Z~1/1", "Z~1/go", "Z~1/State_00/go", "Z~1/State_01/rise"),
        *("supervision", "B/a", "odd/x"),
    ]
    assert now(edit.rename(blueprint, Address("A", "State_01"), "State_10")) == [
        *keys[:3],
        "A/State_10/rise",
        *keys[4:],
    ]
    assert now(edit.rename(blueprint, GO, "walk")) == ["A/1", "A/go", "A/State_00/walk", *keys[3:]]
    assert now(edit.rename(blueprint, GO, "walk", rename_everywhere=True)) == [
        *("A/1", "A/walk", "A/State_00/walk"),
        *keys[3:],
    ]
    assert now(edit.rename(made({"A/go": "human"}), GO, "walk")) == ["A/go", "A/State_00/walk"]
    assert now(edit.rename(made({"A/go": "human", "A/rise": "shared"}), GO, "rise")) == [
        "A/go",
        "A/rise",
    ]
    one = Address("A", "State_11", "1")
    assert now(edit.rename(blueprint, one, "fall", rename_everywhere=True)) == keys


def test_levels_go_with_what_they_are_of() -> None:
    keys = ["A/1", "A/go", "A/State_00/go", "A/State_01/rise", "supervision", "B/a"]
    blueprint = made(dict.fromkeys(keys, "human"))

    def left(*addresses: Address) -> list[str]:
        return list(edit.delete(blueprint, addresses).fields.get("_levels", []))

    assert left(GO) == ["A/1", "A/go", "A/State_01/rise", "supervision", "B/a"]
    assert left(Address("A", "State_11")) == ["A/1", "A/go", "A/State_00/go", "supervision", "B/a"]
    assert left(Address("B")) == keys[:-1]
    assert left(Address("A"), Address("B")) == ["supervision"]


def test_levels_of_an_imported_file_count_behind_its_own() -> None:
    base = {"_imports": ["sub.json"], "_levels": {"B/a": "shared"}, "A": {"S": {"x": "S"}}}
    sub = {"_levels": {"B/a": "human", "B/b": "human"}, "B": FILE["B"]}
    blueprint = read_blueprint(
        parse_json(json.dumps(base), "base.json"),
        opened=[parse_json(json.dumps(sub), "sub.json")],
    )
    levels = Levels(blueprint)
    assert levels.operation(Address("B", "State_0", "a")) == "shared"
    assert levels.operation(Address("B", "State_1", "b")) == "human"
    theirs = blueprint.home("B").file
    changed = edit.set_levels(blueprint, {"B/b": None}, theirs)
    assert Levels(changed).operation(Address("B", "State_1", "b")) == "automatic"
    assert changed.document is blueprint.document
    assert [change.words for change in compare(blueprint, changed).changes] == [
        "The level of B/b is removed (it was human)."
    ]


def test_a_change_of_a_level_is_told_by_what_it_is_of() -> None:
    before = made({"A/go": "human", "supervision": "shared"})
    after = made({"A/go": "shared", "inspection": "human"})
    difference = compare(before, after)
    assert [(c.kind.value, c.what, c.words) for c in difference.changes] == [
        ("changed", "level", "The level of A/go is shared instead of human."),
        ("added", "level", "The level of inspection is added: human."),
    ]
    renamed = edit.rename(before, Address("A"), "Z")
    assert [change.what for change in compare(before, renamed).changes] == ["branch"]


def test_the_most_careful_level_of_forecasts_counts() -> None:
    file = {**FILE, "A": {**FILE["A"], "_operations": {"push": {"forecast": "ask"}}}}
    none, own = Levels(made()), Levels(made(None, file))
    assert (none.forecasts, none.forecast(PUSH)) == (False, "")
    assert (own.forecasts, own.forecast(PUSH), own.forecast(GO)) == (True, "ask", "")
    whole = Levels(made({"forecast": "show"}, file))
    assert (whole.forecast(PUSH), whole.forecast(GO)) == ("ask", "show")
    before = Levels(made({"forecast": "hold"}, file), {"forecast": "show"})
    assert (before.forecast(PUSH), before.forecast(GO)) == ("hold", "hold")


def test_a_level_of_forecasts_is_another_kind_of_word() -> None:
    assert not of({"forecast": "human"}).forecasts
    with pytest.raises(UsageError, match="'human' is no level of forecast") as refused:
        of(None, {"forecast": "human"})
    assert refused.value.advice == "Choose one of show, ask, hold."
    with pytest.raises(UsageError, match="'ask' is no level of A/go"):
        of(None, {"A/go": "ask"})
    edited = edit.set_levels(made(), {"forecast": "ask"})
    assert Levels(edited).forecast(GO) == "ask"
    assert Levels(edit.rename(edited, GO, "walk")).forecast(PUSH) == "ask"
