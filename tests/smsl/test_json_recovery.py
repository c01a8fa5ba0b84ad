"""A broken JSON text: its faults, their repairs, and what can be read of it."""

from __future__ import annotations

import json
import random
from collections.abc import Sequence
from pathlib import Path

import pytest

from smsl_studio.errors import ReadError
from smsl_studio.smsl.forms import recovered
from smsl_studio.smsl.json_form import parse_json, recover
from smsl_studio.smsl.json_form.strides import balance_of

SAMPLES = sorted((Path(__file__).parents[2] / "samples").glob("*.json"))


def refusal(text: str) -> ReadError:
    with pytest.raises(ReadError) as caught:
        parse_json(text, "f.json")
    return caught.value


def places(error: ReadError) -> list[tuple[int, int, int]]:
    return [(f.place.line, f.place.column, f.length) for f in error.faults if f.place]


def repaired(text: str, faults: Sequence[ReadError]) -> str:
    """The text with every offered repair made, from the last to the first."""
    fixes = [(f.fix.start, f.fix.end, i, f.fix.text) for i, f in enumerate(faults) if f.fix]
    before = len(text)
    for start, end, _, new in sorted(fixes, reverse=True):
        if end <= before:
            text, before = text[:start] + new + text[end:], start
    return text


def is_valid(text: str) -> bool:
    try:
        parse_json(text, "f.json")
    except ReadError:
        return False
    return True


@pytest.mark.parametrize(
    ("text", "place", "words", "after"),
    [
        ('{"a": {"o": "T" "p": "S"}}', (1, 17, 3), "a comma is missing", '"T", "p"'),
        ('{"a": {},, "b": {}}', (1, 10, 1), "a comma with nothing before it", '{}, "b"'),
        ('{"a": {"o": "T",}}', (1, 16, 1), "a comma with nothing behind it", '"T"}'),
        ('{"a" {}}', (1, 6, 1), "the colon behind 'a' is missing", '"a": {}'),
        ('{"a":: {}}', (1, 6, 1), ": does not belong here", '"a": {}'),
        ('{"a" = {}}', (1, 6, 1), "a colon stands between name and value, not =", '"a" : {}'),
        ('{"a" -> {}}', (1, 6, 2), "a colon stands between name and value, not ->", '"a" : {}'),
        ('{"a", {}}', (1, 5, 1), "a colon stands between name and value, not ,", '"a": {}'),
        ("{'a b': {}}", (1, 2, 5), "only double quotes", '"a b"'),
        ("{“a”: {}}", (1, 2, 3), "only double quotes", '"a"'),
        ("{a-b c: {}}", (1, 2, 5), "stands without quotes", '"a-b c"'),
        ('{"a": {"o": T}}', (1, 13, 1), "T is no value in JSON", '"T"'),
        ('{"_a": True}', (1, 8, 4), "True is no value", ": true"),
        ('{"_a": None}', (1, 8, 4), "None is no value", ": null"),
        ('{"_a": 010}', (1, 8, 3), "010 is no value", '"010"'),
        ('{"a": {"o: "T"}}', (1, 8, 2), "the closing quote is missing", '"o"'),
        ('{"a": {o": "T"}}', (1, 8, 1), "the opening quote is missing", '"o"'),
        ('{"a": {"o": "T}}', (1, 13, 2), "the closing quote is missing", '"T"}}'),
        ('{"a": {"o"p": "T"}}', (1, 10, 1), "a quote stands inside a text", '"op"'),
        ('{"a":\n {"o": "T\n }}', (2, 8, 2), "the closing quote is missing", '"T"\n'),
        ('{"a": {"o": "T"}', (1, 16, 1), "the file ends, and a bracket", "}}"),
        ('{"a": {"o": "T",\n', (1, 16, 1), "the file ends, and 2 brackets", '"T"}}'),
        ('{"a": {"o": "T"}]', (1, 17, 1), "] cannot close what { has opened", "}}"),
        ('{"_a": [1, 2}', (1, 13, 1), "the [ of line 1 is not closed", "2]}"),
        ('{\n "a": {\n  "o": {\n },\n "b": {}\n}', (4, 2, 1), "the { of line 3", '"o": {'),
        ('{\n "a": {\n  "o": {},\n "b": {}\n}', (4, 2, 3), "the { of line 2", '"o": {}\n },'),
        ('{"a": "S": {"o": "S"}}}', (1, 7, 3), "the opening brace of 'a' is missing", '{ "S"'),
        ('{"a": {}}}', (1, 10, 1), "this closes nothing", '{"a": {}}'),
        ('{"a": {}, "b": {"S": {}]}}', (1, 24, 1), "this ] closes nothing", "{}}}"),
        ('{"a": {} // why\n}', (1, 10, 6), "JSON has no comments", "{}\n}"),
        ('{"a": {} # why\n}', (1, 10, 5), "JSON has no comments", "{}\n}"),
        ('{"a": /* why */ {}}', (1, 7, 9), "JSON has no comments", '"a": {}'),
        ('{"a": {}; "b": {}}', (1, 9, 1), "a comma stands between members, not ;", "{}, "),
        ('{"a\tb": {}}', (1, 4, 1), "a control character (U+0009)", "a\\tb"),
        ('{"a\\x": {}}', (1, 4, 1), "means nothing in JSON", "a\\\\x"),
        ('{"a":\u00a0{}}', (1, 6, 1), "a blank that JSON does not know", '"a": {}'),
        ('"a": {"o": "S"}}', (1, 1, 3), "the opening brace of the file", '{"a"'),
        ('x{"a": {}}', (1, 1, 1), "x does not belong here", '{"a": {}}'),
    ],
    ids=range(38),
)
def test_one_fault_is_told_once_and_repaired(
    text: str, place: tuple[int, int, int], words: str, after: str
) -> None:
    error = refusal(text)
    assert words in error.sentence
    assert places(error) == [place]
    assert error.advice
    assert error.fix is not None
    assert after in repaired(text, error.faults)
    assert is_valid(repaired(text, error.faults))


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ('{"_a": NaN}', "NaN is no number in JSON"),
        ('{"a": , "b": {}}', "'a' has no value"),
        ('{"a": {}} {"b": {}}', "text follows after the end of the file's object"),
        ('{"a": {', "the file ends, and 2 brackets are not closed"),
        ('{"a":', "the file ends before the value of 'a'"),
        ('{"a": {} {}}', "a comma and a name are missing before {"),
    ],
)
def test_a_fault_whose_repair_is_not_plain(text: str, sentence: str) -> None:
    error = refusal(text)
    assert error.sentence == sentence
    assert error.more == ()
    assert error.advice


BROKEN = """{
    "SB": {
        "State_0": {
            "go": "State_1"
            "stop": "State_0",
        },
        State_1: {'back' = "State_0"},
        // the end
        "State_2": {"x: "State_0"}
    }
"""


def test_every_fault_of_a_text_is_told_in_its_order_and_the_rest_is_read() -> None:
    error = refusal(BROKEN)
    assert [(f.place.line, f.sentence[:30]) for f in error.faults if f.place] == [
        (5, "a comma is missing before this"),
        (5, "a comma with nothing behind it"),
        (7, "the name State_1 stands withou"),
        (7, "only double quotes are quotes "),
        (7, "a colon stands between name an"),
        (8, "JSON has no comments"),
        (9, "the closing quote is missing"),
        (10, "the file ends, and a bracket i"),
    ]
    read = {
        "SB": {
            "State_0": {"go": "State_1", "stop": "State_0"},
            "State_1": {"back": "State_0"},
            "State_2": {"x": "State_0"},
        }
    }
    assert recover(BROKEN, "f.json").values == read
    assert parse_json(repaired(BROKEN, error.faults), "f.json").values == read


def test_a_comment_beside_another_fault_is_a_fault_of_its_own() -> None:
    text = '{\n  "a": {\n    "S": {"o": "S"}   // end\n'
    error = refusal(text)
    assert [fault.sentence for fault in error.faults] == [
        "the file ends, and 2 brackets are not closed",
        "JSON has no comments",
    ]
    fixed = '{\n  "a": {\n    "S": {"o": "S"}\n  }\n}\n'
    assert repaired(text, error.faults) == fixed


def test_what_could_be_read_is_a_document_of_its_own() -> None:
    document = recover('\ufeff{"a": {"S": {"o": \ud800"T"}, "_x": NaN}, "b" "c', "f.json")
    assert document.values == {"a": {"S": {"o": "T"}}, "b": "c"}
    assert parse_json(document.text, "f.json").values == document.values
    assert (document.file, document.form) == ("f.json", "json")
    assert document.encoded()
    for nothing in ("", "[1, 2]", "hello", "\ufeff", "// nothing"):
        assert recover(nothing, "f.json").values == {}


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ("{\n    # NAME: SB1\n    State0: [go -> State1]\n}", "native SMSL"),
        ("// first\n{ State0: [],\n # NAME: SB1\n }", "native SMSL"),
        ("SB1:\n  State0: {go: State1}\n", "YAML"),
        ("---\nSB1: [HEADER: [INITIAL: S0]]\n", "YAML"),
    ],
)
def test_another_form_under_the_name_of_json_is_told_as_that(text: str, form: str) -> None:
    error = refusal(text)
    assert error.sentence == f"this is {form}, not JSON"
    assert "Name it f." in error.advice
    assert error.more == ()
    document = recovered(text, "f.json")
    assert list(document.values) == ["SB1"]
    assert parse_json(document.text, "f.json").values == document.values


def test_a_hundred_faults_are_enough() -> None:
    text = "{" + "".join(f'"s{number}" {{}},\n' for number in range(500)) + "}"
    error = refusal(text)
    assert len(error.faults) == 100
    assert recover(text, "f.json").values["s7"] == {}


@pytest.mark.parametrize(
    "piece",
    [
        "{",
        "[",
        '{"a":',
        "}",
        '"',
        "'",
        "“",
        "\\",
        "#\n",
        "/*",
        "=.",
        "x ",
        ":",
        ",",
        '"a"',
        "\ufeff",
    ],
)
def test_what_is_hostile_is_refused_in_one_pass(piece: str) -> None:
    for begin in ("", '{"a":', '{"a":{"S":{"o":"S"'):
        error = refusal(begin + piece * 1_500)
        assert 1 <= len(error.faults) <= 100
        assert recover(begin + piece * 1_500, "f.json").text


def test_a_quote_that_is_not_closed_is_sought_once() -> None:
    # Asked again of every quote behind it, this takes minutes.
    text = '{"a": ' + '"\\' * 60_000
    error = refusal(text)
    assert error.place is not None
    assert error.place.column == 7
    assert balance_of('{"[\\"" } \'"]\' ] // "}\n] "}') == 3
    assert balance_of('{"a": "}}}, "b": 1\n}}') == 1


def test_one_fault_in_a_large_text_is_one_fault_in_its_place() -> None:
    states = {f"State_{n}": {"go": f"State_{n + 1}", "back": "State_0"} for n in range(400)}
    values = {"SB": {**states, "State_400": {}}}
    text = json.dumps(values, indent=2)
    lines = text.split("\n")
    line = lines.index('    "State_150": {') + 1
    for at, broken, told in [
        (line, '    "State_150" {', (line, 17)),
        (line + 1, '      "go": "State_151"', (line + 2, 7)),
        (line + 1, '      "go: "State_151",', (line + 1, 7)),
        (line + 3, "", (line + 4, 5)),
    ]:
        damaged = "\n".join([*lines[: at - 1], broken, *lines[at:]])
        error = refusal(damaged)
        assert [place[:2] for place in places(error)] == [told]
        assert recover(damaged, "f.json").values == values


MARKS = '{}[],:"'


def damaged(text: str, chance: random.Random) -> str:
    """The text with one mark of JSON taken out, put in, or made another."""
    at = chance.choice([index for index, char in enumerate(text) if char in MARKS])
    kind = chance.randrange(3)
    if kind == 0:
        return text[:at] + text[at + 1 :]
    return text[:at] + chance.choice(MARKS + "x;=") + text[at + (kind == 1) :]


def test_a_damaged_sample_is_mostly_one_fault_and_mostly_repaired() -> None:
    chance = random.Random(7)
    texts = [path.read_text(encoding="utf-8") for path in SAMPLES if path.stat().st_size < 4000]
    texts += [json.dumps(json.loads(text), separators=(",", ":")) for text in texts]
    broken, once, whole = 0, 0, 0
    for _ in range(120):
        text = damaged(chance.choice(texts), chance)
        if is_valid(text):
            continue
        error = refusal(text)
        for line, column, _ in places(error):
            assert 1 <= column <= len(text.split("\n")[line - 1]) + 1
        broken += 1
        once += not error.more
        whole += is_valid(repaired(text, error.faults))
    assert broken > 90
    assert once > 0.9 * broken
    assert whole > 0.9 * broken


def test_two_damages_are_mostly_two_faults_and_the_repairs_work_one_by_one() -> None:
    chance = random.Random(8)
    texts = [path.read_text(encoding="utf-8") for path in SAMPLES if path.stat().st_size < 4000]
    broken, few, whole = 0, 0, 0
    for _ in range(40):
        text = damaged(damaged(chance.choice(texts), chance), chance)
        if is_valid(text):
            continue
        broken += 1
        few += len(refusal(text).faults) <= 2
        for _ in range(10):
            if is_valid(text):
                break
            fixes = [fault.fix for fault in refusal(text).faults if fault.fix]
            if not fixes:
                break
            text = text[: fixes[0].start] + fixes[0].text + text[fixes[0].end :]
        whole += is_valid(text)
    assert broken > 30
    assert few > 0.8 * broken
    assert whole > 0.9 * broken
