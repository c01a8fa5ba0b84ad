"""Predicates of facts: what can be read, which units fit, and that they are part of the meaning."""

from __future__ import annotations

import json
from typing import Any

import pytest

from smsl_studio.blueprint.comparison import compare
from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.merge import merge
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.predicates import read_predicate, read_unit, sense_of
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import FormulaError
from smsl_studio.smsl.conversion import convert
from smsl_studio.smsl.json_form import parse_json

ENTRY: dict[str, Any] = {
    "name": "clamped",
    "sources": {"force": "N", "gap": "mm"},
    "range": {"force": [0, 50.5]},
    "predicate": {"0": "force < 1 N or gap > 3 mm", "1": "force > 2 N for 0.5 s and gap < 2 mm"},
}


def blueprint(entry: dict[str, Any]) -> Blueprint:
    text = {
        "SB": {"_facts": {"0": entry}, "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}
    }
    return read_blueprint(parse_json(json.dumps(text, indent=1), "x.json"))


@pytest.mark.parametrize(
    ("one", "other", "fit", "factor"),
    [
        ("mm", "m", True, 0.001),
        ("N*m", "J", True, 1),
        ("km/h", "m/s", True, 1 / 3.6),
        ("m/s^2", "m/s²", True, 1),
        ("N/mm²", "MPa", True, 1),
        ("l", "ml", True, 1000),
        ("µm", "um", True, 1),
        ("mmHg", "Pa", True, 133.322387415),
        ("min", "s", True, 60),
        ("1/min", "bpm", True, 1),
        ("%", "1", True, 0.01),
        ("deg", "1", False, 0),
        ("degC", "K", False, 0),
        ("rad/s", "Hz", False, 0),
        ("N", "m", False, 0),
    ],
)
def test_units_fit_by_what_they_measure(one: str, other: str, fit: bool, factor: float) -> None:
    first, second = read_unit(one), read_unit(other)
    assert first.fits(second) == fit
    if fit:
        assert float(first.to(second)) == pytest.approx(factor)


@pytest.mark.parametrize("text", ["", "Newton", "m//s", "m*", "5", "N m", "mdegC", "m^0", "m" * 99,
                                  "m^9*m^9"])  # fmt: skip
def test_what_is_no_unit_is_told(text: str) -> None:
    with pytest.raises(FormulaError, match="unit") as caught:
        read_unit(text)
    assert caught.value.advice


@pytest.mark.parametrize(
    ("text", "at", "words"),
    [
        ("a > 1 and b > 2 or c < 3", 17, "'and' and 'or' stand side by side"),
        ("a >", 4, "a number is expected, but the text ends there"),
        ("a > nan N", 5, "a number is expected, but 'nan' stands"),
        ("a > 1e99 N", 5, "too large"),
        ("a = 5 N", 3, "'='"),
        ("__import__('os') > 1", 1, "no '__import__' that measures could be put into"),
        ("a > 5 N for 2 mm", 13, "a time is expected"),
        ("a > 5 N for -2 s", 14, "a time is expected"),
        ("min > 5", 5, "'(' is expected after min"),
        ("(a > 1 N) > 1", 11, "'and', 'or' or the end is expected"),
        ("a + (b > 1) > 2", 5, "a condition stands where a measure is expected"),
        ("distance(a) > 2 mm", 11, "',' is expected"),
        ("'a > 2 mm", 1, "' is not closed"),
        ("a > 5 N and", 12, "the name of a source is expected, but the text ends"),
        ("(" * 30 + "a", 21, "more than 20 deep"),
        (" - ".join("a" * 101) + " > 1", 401, "more than 100 measures"),
        ("a" * 1_000_000, 2001, "1,000,000 characters is too long"),
        ("a > 5 N; b", 7, "'N;' is no unit"),
        ("a > 5 N b", 9, "the end is expected"),
    ],
)
def test_what_cannot_be_read_is_told_with_its_character(text: str, at: int, words: str) -> None:
    with pytest.raises(FormulaError) as caught:
        read_predicate(text)
    assert caught.value.sentence.startswith(f"character {at:,}: ")
    assert words in caught.value.sentence
    assert caught.value.advice


@pytest.mark.parametrize(
    ("change", "path", "words"),
    [
        ({"sources": {"force": "N"}}, ("predicate", "0"), "'gap' is no source of this fact"),
        ({"sources": {}}, ("predicate",), "no sources that the predicate could read"),
        ({"sources": {"force": "N", "gap": 5}}, ("sources", "gap"), "is no text"),
        ({"sources": {"force": "N", "gap": "mn"}}, ("sources", "gap"), "'mn' is no unit"),
        ({"sources": {"force": "N", "": "mm"}}, ("sources", ""), "has no name"),
        ({"sources": {f"s{n}": "N" for n in range(65)}}, ("sources",), "65 sources"),
        ({"range": {"force": [1, float("nan")]}}, ("range", "force"), "no pair of numbers"),
        ({"range": {"force": ["1", 2]}}, ("range", "force"), "no pair of numbers"),
        ({"range": {"x": [1, 2]}}, ("range", "x"), "no source"),
        ({"range": [1]}, ("range",), "no map"),
        ({"predicate": 5}, ("predicate",), "no map of values"),
        ({"predicate": {}}, ("predicate",), "says no value"),
        ({"predicate": {"0": 5}}, ("predicate", "0"), "is no text"),
        ({"predicate": {"0": "force < 1 N", "1": "force > 2 mm"}}, ("predicate", "1"),
         "2 mm is compared with a measure in N"),
        ({"predicate": {"1": "force - gap > 2 N"}}, ("predicate", "1"), "stands beside one in N"),
        ({"predicate": {"1": "gap > 2 mm and distance(gap, gap) > 2 mm"}}, ("predicate",),
         "gap is used as a number and as a position"),
        ({"predicate": "force above 1 N"}, ("sources",), "no predicate says which value"),
    ],
)  # fmt: skip
def test_what_does_not_fit_leaves_the_fact_unknown(
    change: dict[str, Any], path: tuple[str, ...], words: str
) -> None:
    sense = sense_of({**ENTRY, **change})
    assert sense is not None
    assert sense.fault is not None
    assert sense.fault.path == path
    assert words in sense.fault.sentence
    assert sense.fault.advice


def test_a_text_is_for_people_and_no_predicate() -> None:
    assert sense_of({"predicate": "at most 1 mm", "unit": "mm", "sensors": ["eye"]}) is None
    assert sense_of({}) is None
    assert not blueprint({"predicate": "at most 1 mm"}).branches["SB"].notes.senses


@pytest.mark.parametrize("form", ["json", "smsl", "yaml"])
def test_the_forms_keep_them_whole(form: str) -> None:
    before = blueprint(ENTRY)
    there = convert(before.document, form, f"x.{form}").document
    again = read_blueprint(convert(there, "json", "x.json").document)
    assert read_blueprint(there) == before == again
    assert digests(read_blueprint(there)) == digests(before)
    assert again["SB"].notes.senses == before["SB"].notes.senses != {}


@pytest.mark.parametrize(
    "change",
    [
        {"sources": {"force": "kN", "gap": "mm"}},
        {"range": {"force": [0, 51]}},
        {"predicate": {**ENTRY["predicate"], "1": "force > 3 N and gap < 2 mm"}},
    ],
)
def test_each_part_has_a_meaning(change: dict[str, Any]) -> None:
    before, after = blueprint(ENTRY), blueprint({**ENTRY, **change})
    assert digests(before).behaviour == digests(after).behaviour
    assert digests(before).meaning != digests(after).meaning
    (key,) = change
    assert any(key in str(one) for one in compare(before, after).changes)
    same = {**ENTRY, "range": {"force": [0.0, 50.5]}}
    assert digests(before) == digests(blueprint(same))


def test_two_people_may_change_two_of_them() -> None:
    tighter = {**ENTRY["predicate"], "1": "force > 3 N and gap < 2 mm"}
    ours, theirs = {**ENTRY, "predicate": tighter}, {**ENTRY, "range": {"force": [0, 20]}}
    merged = merge(blueprint(ENTRY), blueprint(ours), blueprint(theirs))
    assert not merged.conflicts
    assert merged.blueprint == blueprint({**ours, "range": {"force": [0, 20]}})
    other = {**ENTRY, "predicate": {**ENTRY["predicate"], "1": "force > 4 N and gap < 2 mm"}}
    clash = merge(blueprint(ENTRY), blueprint(ours), blueprint(other))
    assert clash.conflicts
    assert clash.blueprint["SB"].notes.senses == blueprint(ours)["SB"].notes.senses
