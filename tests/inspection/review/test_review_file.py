"""The file of a review is hostile until it was checked."""

from __future__ import annotations

import json
from pathlib import Path
from random import Random
from typing import Any

import pytest

from smsl_studio.errors import ReadError
from smsl_studio.inspection.review.review import Review
from smsl_studio.inspection.review.review_file import read_review, written_review
from tests.inspection.review.answers import random_entries

ENTRY: dict[str, Any] = {
    "kind": "comment",
    "line": "a" * 32,
    "section": "procedure",
    "heading": "Fix the leg",
    "person": "M. Reyes",
    "role": "surgeon",
    "time": "2026-03-01T12:00:00.000000Z",
    "text": "Who is the second person?",
    "to": "",
    "about": ["SB1/State_0/Op"],
}


def raw_of(*entries: Any, form: Any = "SMSL Studio review 1", **more: Any) -> bytes:
    return json.dumps({"form": form, "entries": list(entries), **more}, indent=1).encode()


def refused(raw: bytes, file: str = "a.json.review.json") -> ReadError:
    with pytest.raises(ReadError) as caught:
        read_review(raw, file)
    assert caught.value.place is not None
    assert caught.value.place.file == file
    assert "move it away" in caught.value.advice
    return caught.value


def test_a_fair_entry_is_read() -> None:
    (entry,) = read_review(raw_of(ENTRY), "a.review.json").entries
    assert (entry.person, entry.text, entry.about) == (
        "M. Reyes", "Who is the second person?", ("SB1/State_0/Op",)
    )  # fmt: skip


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"kind": "signed"}, "its kind is not one of"),
        ({"line": "A" * 32}, "no key of a line"),
        ({"line": "a" * 32 + "\n"}, "no key of a line"),
        ({"person": " "}, "names no person"),
        ({"person": 3}, "person is no text"),
        ({"heading": "x" * 1001}, "heading is no text of at most 1,000"),
        ({"text": "x" * 10_001}, "text is no text of at most 10,000"),
        ({"text": " "}, "has no text"),
        ({"time": "2026-03-01T12:00:00Z"}, "no time with microseconds"),
        ({"time": "2026-02-30T12:00:00.000000Z"}, "day"),
        ({"time": "yesterday"}, "no time such as"),
        ({"to": "b" * 32}, "belongs to no comment"),
        ({"kind": "reply"}, "which comment"),
        ({"kind": "reply", "to": "b" * 32}, "answers a comment that is not in the review"),
        ({"about": "SB1"}, "about is no list"),
        ({"about": [1]}, "about is no text"),
        ({"about": ["x"] * 21}, "about is no list"),
        ({"more": 1}, "exactly the keys"),
    ],
)
def test_an_entry_that_does_not_fit_is_refused_with_its_place(
    wrong: dict[str, Any], words: str
) -> None:
    error = refused(raw_of(ENTRY, {**ENTRY, **wrong}))
    assert words in error.sentence
    assert error.sentence.startswith("entry 2")
    assert error.place is not None
    assert error.place.line > len(ENTRY)


@pytest.mark.parametrize(
    ("raw", "words"),
    [
        (b"", "no JSON"),
        (b"\xff", "no JSON"),
        (b"[" * 100_000, "no JSON"),
        (b"[]", "not of the form"),
        (raw_of(ENTRY, form="another"), "the form of the review"),
        (raw_of(ENTRY, person="M. Reyes"), "not of the form"),
        (b'{"form": "SMSL Studio review 1", "entries": {}}', "entries is no list"),
        (b'{"form": "SMSL Studio review 1", "form": 1, "entries": []}', "twice"),
        (b'{"form": "SMSL Studio review 1", "entries": [NaN]}', "NaN"),
        (raw_of([ENTRY]), "exactly the keys"),
        (b" " * ((32 << 20) + 1), "larger than 32 MB"),
    ],
)
def test_a_file_that_is_no_review_is_refused(raw: bytes, words: str) -> None:
    assert words in refused(raw).sentence


def test_no_damage_of_a_file_is_read_as_something_else_or_crashes() -> None:
    review = Review.of(random_entries(Random(5), 12))
    raw = written_review(review)
    chance = Random(6)
    for _ in range(60):
        at = chance.randrange(len(raw))
        broken = raw[:at] + bytes([chance.randrange(256)]) + raw[at + chance.randrange(3) :]
        try:
            found = read_review(broken, "a.review.json")
        except ReadError:
            refused(broken, "a.review.json")
        else:  # a changed letter in a text is another text
            assert len(found.entries) <= len(review.entries)


def test_names_of_every_kind_are_kept_as_they_are(tmp_path: Path) -> None:
    odd = {**ENTRY, "person": "<b>\u202eR\u0000", "text": "\ud800 </script>", "heading": "\n"}
    review = read_review(raw_of(odd), "a.review.json")
    assert read_review(written_review(review), "a.review.json") == review
    assert written_review(review).isascii()
