"""The content of a journal; anything else in its file is rejected."""

from __future__ import annotations

import json
import random
from hashlib import sha256

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.errors import ReadError
from smsl_studio.studio.document.journal.entry import MAGIC, JournalEntry, KeptText, decode, encode
from tests.counts import share_of

names = st.text(st.characters(exclude_characters="\0"), max_size=30)
texts = st.text(st.characters(), max_size=60)
kept = st.builds(KeptText, names, texts, names)
entries = st.builds(
    JournalEntry, names, names, names, names, st.integers(0, 10**9),
    st.lists(kept, min_size=1, max_size=4).map(tuple),
)  # fmt: skip
KEPT = (KeptText("/x/a.json", "{}\r\n", "d"), KeptText("/x/b.smsl", "\ufeff// ü\n"))
ENTRY = JournalEntry("a.json", "/x/a.json", "/x/a.json", "2026-01-02T03:04:05", 7, KEPT)


@given(entries)
@settings(max_examples=share_of(60))
def test_what_was_written_is_read(entry: JournalEntry) -> None:
    assert decode(encode(entry)) == entry


@given(entries, st.randoms(use_true_random=False))
@settings(max_examples=share_of(60))
def test_a_journal_that_was_cut_or_damaged_is_refused_or_reads_as_a_whole(
    entry: JournalEntry, chance: random.Random
) -> None:
    raw = encode(entry)
    cut = raw[: chance.randrange(len(raw))]
    with pytest.raises(ReadError):
        decode(cut)
    mixed = bytearray(raw)
    for _ in range(chance.randint(1, 3)):
        mixed[chance.randrange(len(mixed))] = chance.randrange(256)
    try:
        read = decode(bytes(mixed))
    except ReadError:
        return
    # Words of the head may be others; a text never is.
    assert [one.text for one in read.texts] == [one.text for one in entry.texts]


@given(st.binary(max_size=200))
@settings(max_examples=share_of(60))
def test_any_other_bytes_are_refused_with_a_sentence(raw: bytes) -> None:
    for odd in (raw, MAGIC + raw, MAGIC + b"{" + raw + b"}\n"):
        with pytest.raises(ReadError, match="journal cannot be read"):
            decode(odd)


def head(**other: object) -> bytes:
    """A journal with one text, and other words in its head."""
    body = b"{}"
    text = {"file": "a", "saved": "", "bytes": 2, "sha256": sha256(body).hexdigest()}
    said: dict[str, object] = {
        "name": "a", "path": "", "file": "a", "when": "", "changes": 1, "texts": [text],
    }  # fmt: skip
    return MAGIC + json.dumps({**said, **other}).encode() + b"\n" + body


def test_the_entry_made_for_these_tests_is_valid() -> None:
    assert decode(head()).texts == (KeptText("a", "{}"),)


@pytest.mark.parametrize(
    "other",
    [
        {"name": 1}, {"path": None}, {"file": "x" * 5000}, {"when": []}, {"name": "a\0b"},
        {"changes": True}, {"changes": -1}, {"changes": "1"}, {"changes": 1.5},
        {"texts": []}, {"texts": {}}, {"texts": [3]}, {"texts": [{}]},
        {"texts": [{"file": "a", "saved": "", "bytes": 10**30, "sha256": ""}]},
        {"texts": [{"file": "a", "saved": "", "bytes": -1, "sha256": ""}]},
        {"texts": [{"file": "a", "saved": "", "bytes": True, "sha256": ""}]},
        {"texts": [{"file": "a", "saved": "", "bytes": 2, "sha256": "0"}]},
    ],
)  # fmt: skip
def test_a_head_that_does_not_fit_is_refused(other: dict[str, object]) -> None:
    with pytest.raises(ReadError):
        decode(head(**other))


def test_a_head_of_any_depth_or_length_is_refused() -> None:
    for odd in (b"[" * 100_000, b"7" * 100_000, b'"' + b"x" * (5 << 20)):
        with pytest.raises(ReadError):
            decode(MAGIC + odd + b"\n")
