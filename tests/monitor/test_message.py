"""A message counts only if every word of it is valid."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.monitor.message import (
    LARGEST,
    MOST,
    Status,
    UnreadableError,
    fact_payload,
    read_fact,
    read_status,
    status_payload,
)
from smsl_studio.monitor.sample import BAD, Sample
from smsl_studio.monitor.topics import FactTopic

TOPIC = FactTopic("lab", "main", "SB1", 2, "eye")
FACT: dict[str, Any] = {
    "version": 1, "node": "bench", "boot": 7, "sequence": 3, "time": 1.5, "value": "a",
    "quality": "good", "reason": "",
}  # fmt: skip


def _raw(**changed: Any) -> bytes:
    said = {**FACT, **changed}
    return json.dumps({key: value for key, value in said.items() if value is not ...}).encode()


def test_a_fact_is_read_as_it_was_sent() -> None:
    sample = Sample("SB1", 2, "eye", "a", 1.5, 3, 7)
    assert read_fact(TOPIC, _raw()) == ("bench", sample)
    assert read_fact(TOPIC, fact_payload("bench", sample)) == ("bench", sample)


def test_what_may_be_left_out() -> None:
    node, sample = read_fact(TOPIC, _raw(node=..., quality=..., reason=...))
    assert (node, sample.quality, sample.reason) == ("", "good", "")


def test_no_value_is_a_bad_reading_whatever_its_quality() -> None:
    _, sample = read_fact(TOPIC, _raw(value=None, reason="it is dark"))
    assert (sample.value, sample.quality, sample.reason) == (None, BAD, "it is dark")


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"version": 2}, "version is 2, not 1"),
        ({"version": 1.0}, "version is 1.0, not 1"),
        ({"version": True}, "version is True, not 1"),
        ({"version": ...}, "version is missing, not 1"),
        ({"boot": -1}, "boot is -1, not a count"),
        ({"boot": MOST + 1}, "boot is 9007199254740992, not a count"),
        ({"boot": "7"}, "boot is '7', not a count"),
        ({"boot": True}, "boot is True, not a count"),
        ({"sequence": 1.5}, "sequence is 1.5, not a count"),
        ({"sequence": ...}, "sequence is missing, not a count"),
        ({"time": "now"}, "time is 'now', not a number of seconds"),
        ({"time": 1e300}, "time is 1e+300, not a number of seconds"),
        ({"time": ...}, "time is missing, not a number of seconds"),
        ({"value": 1}, "value is 1, not a text or null"),
        ({"value": ["a"]}, "value is ['a'], not a text or null"),
        ({"value": ...}, "value is missing"),
        ({"quality": "fine"}, "quality is 'fine', not good, uncertain or bad"),
        ({"quality": []}, "quality is [], not good, uncertain or bad"),
        ({"node": 5}, "node is 5, not a text"),
        ({"reason": {}}, "reason is {}, not a text"),
        ({"value": "\ud800"}, r"value is '\\ud800', not a text or null"),
        ({"reason": "\udfff"}, r"reason is '\\udfff', not a text"),
    ],
)
def test_a_wrong_word_is_named(changed: dict[str, Any], words: str) -> None:
    with pytest.raises(UnreadableError, match=f"^{words.replace('[', '.').replace('+', '.')}"):
        read_fact(TOPIC, _raw(**changed))


@pytest.mark.parametrize(
    "payload",
    [
        b"",
        b"{",
        b"\xff\xfe",
        b"null",
        b"[]",
        b'"text"',
        b"[" * LARGEST,
        b"1" * 5000,
        b" " * (LARGEST + 1),
        b'{"version": 1, "version": 1}',
        _raw()[:-1] + b', "boot": 8}',
        _raw().replace(b"1.5", b"NaN"),
        _raw().replace(b"1.5", b"-Infinity"),
        _raw().replace(b"1.5", b"1e400"),
        "\ufeff{}".encode(),
    ],
)
def test_what_is_no_message_is_refused(payload: bytes) -> None:
    with pytest.raises(UnreadableError):
        read_fact(TOPIC, payload)
    with pytest.raises(UnreadableError):
        read_status(payload)


def test_a_status_is_read_as_it_was_sent() -> None:
    for state in ("alive", "gone"):
        assert read_status(status_payload(Status(4, state))) == Status(4, state)
    with pytest.raises(UnreadableError, match="state is 'well', not alive or gone"):
        read_status(b'{"version": 1, "boot": 1, "state": "well"}')


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=5,
)


@given(st.sampled_from([*FACT]), JSON)
def test_any_word_is_read_or_refused(name: str, value: Any) -> None:
    try:
        _, sample = read_fact(TOPIC, _raw(**{name: value}))
    except UnreadableError:
        return
    assert type(sample.boot) is int
    assert type(sample.sequence) is int
    assert type(sample.time) is float


@given(st.binary())
def test_any_bytes_are_refused_in_words(payload: bytes) -> None:
    with pytest.raises(UnreadableError):
        read_fact(TOPIC, payload)
