"""The closed format between a child and its parent: only bytes that it writes can be read."""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.errors import (
    AddressError,
    HostError,
    Place,
    ReadError,
    RunRefused,
    StudioError,
    WorldError,
)
from smsl_studio.host.answers import REFUSED, RunAnswers
from smsl_studio.host.codec import (
    Codec,
    Unfit,
    exactly,
    flag,
    nothing,
    number,
    numbers,
    one_of,
    opaque,
    text,
    whole,
)
from smsl_studio.host.compound import mapping, optional, record, repeated, row, several
from smsl_studio.host.description import DESCRIPTION
from smsl_studio.host.local import LocalHost
from smsl_studio.host.protocol import OpenedWorld, Outcome, Tick
from smsl_studio.host.vocabulary import name
from smsl_studio.monitor.sample import Sample
from tests.plugin_folder import LAMP, blueprint_of


@dataclass(frozen=True)
class Pair:
    left: str
    right: float = 0.0


FLOATS = st.floats(-1e300, 1e300)
TEXTS = st.text(st.characters(codec="utf-8"), max_size=20)
PAIRS = st.builds(Pair, TEXTS, FLOATS)
NUMBER, TEXT = number(-1e300, 1e300), text(20)
PAIR = record(Pair, left=TEXT, right=NUMBER)


@given(
    st.tuples(
        st.none(),
        st.booleans(),
        st.integers(-5, 2**62),
        FLOATS,
        TEXTS,
        st.lists(FLOATS, max_size=4).map(tuple),
        st.tuples(FLOATS, FLOATS),
        st.one_of(st.none(), TEXTS),
        st.lists(PAIRS, max_size=4).map(tuple),
        st.dictionaries(TEXTS, PAIRS, max_size=4),
        st.dictionaries(TEXTS, st.sampled_from([Pair("a"), Pair("b")]), max_size=9),
        st.sampled_from(list(Outcome)),
        st.binary(max_size=9),
    )
)
def test_what_is_written_is_read(values: tuple[Any, ...]) -> None:
    codec = row(
        nothing(),
        flag(),
        whole(-5, 2**62),
        NUMBER,
        TEXT,
        numbers(-1e300, 1e300, 4),
        exactly(-1e300, 1e300, 2),
        optional(TEXT),
        several(PAIR, 4),
        mapping(TEXT, PAIR, 4),
        mapping(TEXT, PAIR, 9, few=True),
        one_of(list(Outcome)),
        opaque(9),
    )
    assert codec.decode(codec.encode(values)) == values


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_floats_are_exact(value: float) -> None:
    codec = number(-1.8e308 / 1.01, 1.8e308 / 1.01)
    if abs(value) < 1.7e308:
        assert struct.pack("d", codec.decode(codec.encode(value))) == struct.pack("d", value)


COUNT = struct.Struct("<I")


def _told(size: int, data: bytes) -> bytes:
    return COUNT.pack(size) + data


@pytest.mark.parametrize(
    ("codec", "data", "words"),
    [
        (nothing(), b"x", "1 bytes stand behind"),
        (flag(), b"", "ends too early"),
        (flag(), b"\2", "is 2, not 0 or 1"),
        (whole(0, 9), struct.pack("<q", 10), "not from 0 to 9"),
        (whole(0, 9), b"\0" * 7, "ends too early"),
        (number(0, 9), struct.pack("<d", math.nan), "is nan, not a number from 0 to 9"),
        (number(0, 9), struct.pack("<d", math.inf), "is inf"),
        (number(0, math.inf), struct.pack("<d", math.nan), "is nan"),
        (numbers(-9, 9, 9), _told(2, struct.pack("<dd", 1, math.nan)), "no.* number from -9 to 9"),
        (numbers(-9, 9, 9), _told(2, struct.pack("<dd", math.inf, -math.inf)), "number from"),
        (numbers(-9, 9, 9), _told(2, struct.pack("<dd", 1, 10)), "number from -9 to 9"),
        (numbers(-9, 9, 9), _told(10, bytes(80)), "has 10 numbers"),
        (numbers(-9, 9, 9, multiple=9), _told(8, bytes(64)), "has 8 numbers"),
        (numbers(-9, 9, 2**40), _told(2**32 - 1, bytes(80)), "ends too early"),
        (exactly(-9, 9, 1), struct.pack("<d", math.nan), "number from"),
        (exactly(-9, 9, 2), bytes(8), "ends too early"),
        (text(3), _told(4, b"abcd"), "has 4 characters, more than 3"),
        (text(3), _told(13, bytes(13)), "a text of 13 bytes"),
        (text(3), _told(3, b"ab"), "a text of 3 bytes"),
        (text(9), _told(3, b"\xed\xa0\x80"), "no text in UTF-8"),
        (text(9), _told(2, b"\xc0\x80"), "no text in UTF-8"),
        (name(9), _told(0, b""), "is empty"),
        (name(9), _told(2, b"a\x1b"), r"character U\+001B"),
        (name(9), _told(3, "\u202e".encode()), r"character U\+202E"),
        (name(9), _told(2, b"a\n"), r"character U\+000A"),
        (one_of("ab"), COUNT.pack(2), "is number 2 of 2"),
        (opaque(3), _told(4, b"abcd"), "has 4 entries"),
        (opaque(3), _told(3, b"ab"), "ends too early"),
        (optional(flag()), b"\1", "ends too early"),
        (several(flag(), 2), _told(3, b"\1\1\1"), "has 3 entries, more than 2"),
        (several(flag(), 2**40), _told(2**32 - 1, b"\1\1"), r"\[2\] ends too early"),
        (several(several(flag(), 2), 2), _told(1, _told(1, b"\5")), r"\[0\]\[0\] is 5"),
        (mapping(flag(), flag(), 2), _told(2, b"\1\1") + _told(2, b"\0\1"), "a key twice"),
        (mapping(flag(), flag(), 2), _told(2, b"\0\1") + _told(1, b"\0"), "not one value for each"),
        (
            repeated(flag(), 2),
            _told(1, b"\1") + _told(1, struct.pack("<q", 1)),
            "names a value that is not told",
        ),
        (
            several(PAIR, 2),
            _told(1, _told(1, b"a") + struct.pack("<d", math.nan)),
            r"\.right is nan",
        ),
    ],
)
def test_what_was_not_declared_is_not_read(codec: Codec[Any], data: bytes, words: str) -> None:
    with pytest.raises(Unfit, match=words):
        codec.decode(data)


class Sly(str):
    """A text that lies about itself."""

    def __len__(self) -> int:
        return 0

    def encode(self, *_: Any) -> bytes:
        return b"sly"


@pytest.mark.parametrize(
    ("codec", "value", "words"),
    [
        (flag(), 1, "a value of type 'int', not true or false"),
        (whole(0, 9), True, "a value of type 'bool', not a whole number"),
        (number(0, 9), "1", "a value of type 'str', not a number"),
        (number(0, 9), math.nan, "is nan"),
        (text(3), b"a", "not a text"),
        (text(3), "\ud800", "cannot be written"),
        (numbers(0, 9, 3), ("1",), "no number"),
        (numbers(0, 9, 3), (math.nan,), "not a number from"),
        (numbers(0, 9, 3), 7, "not numbers"),
        (exactly(0, 9, 3), (1.0,), "is not 3 numbers"),
        (one_of("ab"), "c", "none of 2"),
        (one_of("ab"), [], "none of 2"),
        (several(flag(), 2), {True}, "not a row of values"),
        (several(PAIR, 2), (Pair("a"), Pair("b" * 21)), r"\[1\]\.left has 21 characters"),
        (mapping(TEXT, flag(), 2), (1,), "not a mapping"),
        (row(flag(), flag()), (True,), "not 2 values"),
        (PAIR, ("a", 1.0), "not Pair"),
        (nothing(), 0, "not nothing"),
    ],
)
def test_what_was_not_declared_is_not_written(codec: Codec[Any], value: Any, words: str) -> None:
    with pytest.raises(Unfit, match=words):
        codec.encode(value)


def test_a_text_is_measured_and_not_asked() -> None:
    assert text(5).decode(text(5).encode(Sly("abc"))) == "abc"


def test_a_field_that_nobody_declared_is_seen_at_once() -> None:
    with pytest.raises(TypeError, match="the fields of Pair are left, right"):
        record(Pair, left=TEXT)
    assert record(Pair, ("right",), left=TEXT).decode(_told(1, b"a")) == Pair("a")


@pytest.mark.parametrize(
    "error",
    [
        HostError("gone"),
        WorldError("unknown", None, "Did you mean table?"),
        RunRefused("no", Place("a.json", 3, 4), "Mend it."),
        ReadError("odd", Place("\udc80", 1, 1)),
        StudioError("x" * 10**6),
    ],
)
def test_an_error_arrives_as_what_it_was(error: StudioError) -> None:
    told = REFUSED.decode(REFUSED.encode(error))
    assert type(told) is type(error)
    assert told.advice == error.advice
    assert told.sentence[:1000] == error.sentence[:1000]
    assert (told.place is None) == (error.place is None)


def _opened() -> tuple[RunAnswers, OpenedWorld]:
    blueprint = blueprint_of(LAMP)
    opened = LocalHost(blueprint, "table").open({"LAMP": "State_0"})
    answers = RunAnswers(blueprint)
    assert answers.of["open"].decode(answers.of["open"].encode((opened, {}, ())))[0] == opened
    answers.opened(opened)
    return answers, opened


def test_only_a_sensor_of_the_world_can_speak() -> None:
    answers, opened = _opened()
    (sensor,) = opened.sensors
    known = Sample("LAMP", 0, sensor.name, "1", 0.05, 1)
    tick = Tick(0.05, Outcome.IDLE, (known,))
    codec = answers.of["tick"]
    assert codec.decode(codec.encode((tick, None, None))) == (tick, None, None)
    for stranger in (
        known._replace(source="x"),
        known._replace(digit=1),
        known._replace(branch=""),
    ):
        with pytest.raises(Unfit, match="none of 1"):
            codec.encode((tick._replace(samples=(stranger,)), None, None))


def _answers() -> list[tuple[Codec[Any], bytes]]:
    answers, opened = _opened()
    tick = Tick(0.05, Outcome.IDLE, (Sample("LAMP", 0, opened.sensors[0].name, "1", 0.05, 1),))
    values: dict[str, Any] = {"open": (opened, {"a": "b"}, ()), "tick": (tick, {}, None)}
    fault = (None, ("it is wrong", Place("plugin.py", 1, 1)))
    return [
        *((answers.of[verb], answers.of[verb].encode(value)) for verb, value in values.items()),
        (REFUSED, REFUSED.encode(AddressError("x", Place("f", 1, 2), "y"))),
        (DESCRIPTION, DESCRIPTION.encode(fault)),
    ]


@pytest.mark.parametrize(("codec", "whole_one"), _answers())
def test_bytes_that_are_changed_or_cut_are_read_or_unfit(
    codec: Codec[Any], whole_one: bytes
) -> None:
    def tried(data: bytes) -> None:
        try:
            again = codec.encode(codec.decode(data))
        except Unfit:
            return
        assert again == data

    for at in range(len(whole_one)):
        with pytest.raises(Unfit):
            codec.decode(whole_one[:at])
        for byte in (0, 1, 127, 255):
            tried(whole_one[:at] + bytes([byte]) + whole_one[at + 1 :])
    tried(whole_one + b"\0")
