"""Reading the JSON form: what opens, what is refused, and that no value is lost."""

from __future__ import annotations

import json
import random
from pathlib import Path

import pytest
from hypothesis import given, settings

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import Place, ReadError
from smsl_studio.smsl.document.limits import MAX_CHARACTERS, MAX_DEPTH
from smsl_studio.smsl.files import parse_bytes, read_document
from smsl_studio.smsl.json_form import parse_json, recover, write_json
from tests.counts import share_of
from tests.smsl.texts import VALUES, texts

SAMPLES = sorted((Path(__file__).parents[2] / "samples").glob("*.json"))


def refusal(text: str) -> ReadError:
    with pytest.raises(ReadError) as caught:
        parse_json(text, "f.json")
    assert caught.value.place is not None
    return caught.value


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.name)
def test_a_sample_comes_back_byte_for_byte(path: Path) -> None:
    assert read_document(path).encoded() == path.read_bytes()


@settings(max_examples=share_of(300))
@given(texts())
def test_any_document_comes_back_byte_for_byte(text: str) -> None:
    raw = text.encode("utf-8")
    document = parse_bytes(raw, "f.json")
    assert document.encoded() == raw
    assert document.values == json.loads(text.removeprefix("\ufeff"))


@settings(max_examples=share_of(100))
@given(VALUES)
def test_new_text_reads_to_its_values(values: dict[str, object]) -> None:
    document = parse_json(write_json(values), "f.json")
    assert json.dumps(document.values) == json.dumps(values)


def test_the_canonical_layout_is_that_of_the_samples() -> None:
    path = next(path for path in SAMPLES if path.name == "hanoi.json")
    document = read_document(path)
    assert write_json(document.values).split() == document.text.split()
    assert write_json({"SB1": {"S": {"Op": "S"}, "T": {}, "_layout": {"S": [1, 2.5]}}}) == (
        '{\n    "SB1": {\n        "S": {\n            "Op": "S"\n        },\n'
        '        "T": {},\n        "_layout": {\n            "S": [1, 2.5]\n        }\n    }\n}\n'
    )


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        ("", 1, 1, "the file is empty"),
        ("\ufeff \n", 2, 1, "the file is empty"),
        ("[]", 1, 1, "the file holds no State Branches"),
        (" 5", 1, 2, "the file holds no State Branches"),
        ('{"a": {},\n"b" {}}', 2, 5, "the colon behind 'b' is missing"),
        ('{"a": {}} {', 1, 11, "text follows after the end"),
        ('{"é": {},\r\n  "b": }', 2, 8, "'b' has no value"),
        ('\ufeff{"a": x}', 1, 7, "x is no value in JSON"),
        ('{"a": "\x07"}', 1, 8, "a control character (U+0007)"),
        ('{"a": "b', 1, 7, "the closing quote is missing"),
        ('{"NaN": 1,\n "b": NaN}', 2, 7, "NaN is no number in JSON"),
        ('{"a": -Infinity}', 1, 7, "-Infinity is no number in JSON"),
        ('{"a": 1, "b": 1e999}', 1, 15, "the number is too large"),
        ('{"a": ' + "7" * 5000 + "}", 1, 7, "the number is too large"),
        ('{"ok": "\\ud83d\\ude00", "a": "\\\\ \\ud800"}', 1, 33, "half a surrogate pair"),
        ('{"a": "\\ude00"}', 1, 8, "half a surrogate pair"),
        ('{"a": "\\ud83d\\u0041"}', 1, 8, "half a surrogate pair"),
        ('{"a": "\ud800"}', 1, 8, "half a surrogate pair"),
        ('{"a":' + "[" * 5000, 1, MAX_DEPTH + 5, "nested deeper than 64 levels"),
        ('{"a":' + "[" * 99 + "]" * 99 + ',"a":1}', 1, 69, "nested deeper than 64 levels"),
        ('{"a":' + "[" * 99 + "]" * 99 + "}", 1, 69, "nested deeper than 64 levels"),
        ('{"a":\n' * 5000, MAX_DEPTH + 1, 1, "nested deeper than 64 levels"),
    ],
    ids=range(22),
)
def test_a_refusal_names_the_place(text: str, line: int, column: int, words: str) -> None:
    error = refusal(text)
    assert error.place == Place("f.json", line, column)
    assert words in error.sentence
    assert error.advice


def test_a_text_has_an_end() -> None:
    text = " " * (MAX_CHARACTERS + 1)
    error = refusal(text)
    assert error.sentence == "the file is larger than 32 million characters"
    assert error.place == Place("f.json", 1, 1)
    assert recover(text, "f.json").values == {}


def test_a_whole_number_has_a_length() -> None:
    assert parse_json('{"_a": ' + "7" * 4000 + "}", "f.json").values["_a"] > 10**3999
    error = refusal('{"_a": ' + "7" * 4001 + "}")
    assert "the number is too large" in error.sentence
    assert (error.place, error.length) == (Place("f.json", 1, 8), 4001)


def test_columns_count_characters_and_the_bom_is_none() -> None:
    text = '\ufeff{"𝔘é": {"Zustand": {}},\n "𝔘é2": {}}'
    document = parse_json(text, "f.json")
    assert document.place(("𝔘é", "Zustand")) == Place("f.json", 1, 9)
    assert document.place(("𝔘é2",)) == Place("f.json", 2, 2)
    assert document.place(()) == Place("f.json", 1, 1)
    assert document.place(("gone", "further")) == Place("f.json", 1, 1)


def test_bytes_that_are_no_utf8_are_refused_where_they_stand() -> None:
    with pytest.raises(ReadError, match="byte 0xff is no UTF-8") as caught:
        parse_bytes('{"é": \n"'.encode() + b'\xff"}', "f.json")
    assert caught.value.place == Place("f.json", 2, 2)
    with pytest.raises(ReadError, match="no UTF-8"):
        parse_bytes('{"a": {}}'.encode("utf-16"), "f.json")


def test_a_file_that_cannot_be_read_is_refused(tmp_path: Path) -> None:
    for path in (tmp_path / "absent.json", tmp_path, Path("nul\0byte")):
        with pytest.raises(ReadError, match="cannot be read") as caught:
            read_document(path)
        assert caught.value.place == Place(str(path), 1, 1)


def test_the_suffix_may_be_in_capitals(tmp_path: Path) -> None:
    path = tmp_path / "A.JSON"
    path.write_bytes(b"{}")
    assert read_document(path).values == {}


def test_a_key_written_twice_opens_and_both_places_are_found() -> None:
    text = '{"A": {"S": {"o": "S"}, "T": {}, "S": {}},\n "B": {}, "_n": [{"x": 1, "x": 2}], "B": 1}'
    document = parse_json(text, "f.json")
    assert list(document.values) == ["A", "B", "_n"]
    assert document.values["B"] == 1
    assert list(document.values["A"].items()) == [("S", {}), ("T", {})]
    found = {path: [(p.line, p.column) for p in at] for path, at in document.duplicates()}
    assert found == {
        ("A", "S"): [(1, 8), (1, 34)],
        ("B",): [(2, 2), (2, 37)],
        ("_n", "0", "x"): [(2, 19), (2, 27)],
    }
    assert document.place(("A", "S")) == Place("f.json", 1, 34)
    twice = parse_json('{"A": {"S": {}},\n "A": {"S": {}, "T": {}}}', "f.json")
    assert twice.place(("A", "S")) == Place("f.json", 2, 8)
    assert twice.place(("A", "T")) == Place("f.json", 2, 17)


def test_a_document_without_doubles_reports_none() -> None:
    assert parse_json('{"A": {"S": {"a": "S"}, "T": {"a": "S"}}}', "f").duplicates() == ()


def mutated(text: str, chance: random.Random) -> str:
    """The text with one small damage: characters dropped, doubled, swapped or put in."""
    start = chance.randrange(len(text))
    end = min(len(text), start + chance.choice([1, 1, 2, 9, 60]))
    piece = text[start:end]
    kind = chance.randrange(5)
    if kind == 0:
        return text[:start] + text[end:]
    if kind == 1:
        return text[:end] + piece + text[end:]
    if kind == 2:
        return text[:start] + piece[::-1] + text[end:]
    if kind == 3:
        odd = chance.choice(['"', "{", "}", "[", "]", ",", ":", "5", "null", "\\", "\0", "_", "é"])
        return text[:start] + odd + text[start:]
    return text[:start] + chance.choice(["NaN", "1e999", "\\ud800", "\ufeff", "-", "true"]) + piece


def rejection(raw: bytes) -> ReadError | None:
    try:
        read_blueprint(parse_bytes(raw, "f.json"))
    except ReadError as error:
        return error
    return None


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.name)
def test_a_damaged_sample_opens_or_is_refused_with_a_place(path: Path) -> None:
    chance = random.Random(path.name)
    text = path.read_bytes().decode()
    for _ in range(300 // len(SAMPLES) + 1):
        raw = mutated(text, chance).encode()
        error = rejection(raw)
        if error:
            assert error.place is not None
            assert error.place.line <= raw.count(b"\n") + 1
