"""Long JSON texts are read by a faster reader, with the same results."""

from __future__ import annotations

import json

import pytest
from hypothesis import given, settings

from smsl_studio.errors import ReadError
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.json_form import parse_json
from tests.counts import share_of
from tests.smsl.texts import texts

BLANKS = " " * 70_000


def read(text: str) -> Document | ReadError:
    try:
        return parse_json(text, "f.json")
    except ReadError as error:
        return error


def same(text: str) -> bool:
    """Whether the text is read alike as it is, and as part of a long one."""
    short, long = read(text), read(text + BLANKS)
    if isinstance(short, ReadError):
        return isinstance(long, ReadError) and [
            (fault.sentence, fault.place) for fault in long.faults
        ] == [(fault.sentence, fault.place) for fault in short.faults]
    assert isinstance(long, Document)
    assert long.text == text + BLANKS
    assert repr(long.values) == repr(short.values)
    return (long.doubled, long.duplicates()) == (short.doubled, short.duplicates())


@settings(max_examples=share_of(100))
@given(texts())
def test_any_text_reads_alike_short_and_long(text: str) -> None:
    assert same(text)


@pytest.mark.parametrize(
    "text",
    [
        '{"a": 123456789012345678901234567890, "b": 18446744073709551616}',
        '{"a": -9223372036854775809, "b": [-0, -0.0, 1e400]}',
        '{"a": 9223372036854775807, "b": [1E5, 0.1, 1e22, 5e-324, 1.7976931348623157e308]}',
        '{"a": ' + "7" * 5000 + "}",
        '{"a": NaN}',
        '{"a": {"S": {}, "S": {}}}',
        '{"a": {"S" : {}, "S": {"x: y": "a:b"}}}',
        '{"a": {"S"\n:{}, "S":{"_": "\\":"}}, "b": ":"}',
        '{"a": {"S": {"x:": ":y", "z: \\": ": "w"}}, "_": [{"q": "12:30"}, [{"q": 1, "q": 2}]]}',
        '{"a": "\\ud800"}',
        '{"a": "\ud800"}',
        '\ufeff{"é𝔘": "\\ud83d\\ude00"}',
        '{"a":' + "[" * 62 + "]" * 62 + "}",
        '{"a":' + "[" * 63 + "]" * 63 + "}",
        '{"a":' + "[" * 64 + "]" * 64 + "}",
        '{"a":' + "[" * 2000 + "]" * 2000 + "}",
        '{"a":' + "[" * 99 + "]" * 99 + ',"a":1}',
        "[]",
        '"text"',
    ],
    ids=range(19),
)
def test_what_readers_differ_in_reads_alike(text: str) -> None:
    assert same(text)


def test_a_key_written_twice_is_found_in_a_long_text() -> None:
    states = {f"State_{number}": {"note: x": f"{number}: y"} for number in range(3000)}
    text = json.dumps({"A": states})
    assert len(text) > 70_000
    assert not parse_json(text, "f.json").doubled
    document = parse_json(text[:-2] + ', "State_7": {}}}', "f.json")
    assert document.values["A"]["State_7"] == {}
    assert [path for path, _ in document.duplicates()] == [("A", "State_7")]
