"""The file of a review, ``FILE.review.json``: one entry a line, in the order of time.

Everybody can write this file, so nothing in it is believed before it was checked. It is no
signature: what counts is the record that people sign.
"""

from __future__ import annotations

import json
import re
from dataclasses import asdict, fields
from typing import Any

from smsl_studio.errors import Place, ReadError, SealError
from smsl_studio.inspection.approval.times import read_time, written_time
from smsl_studio.inspection.review.entry import COMMENT, KINDS, TO_COMMENT, ReviewEntry
from smsl_studio.inspection.review.review import Review
from smsl_studio.seal.strict_json import read_strictly
from smsl_studio.stop import heed

Json = Any
SUFFIX = ".review.json"
FORM = "SMSL Studio review 1"
LARGEST = 32 << 20
"""The largest file that is read (bytes)."""
MOST = 100_000
"""The largest number of entries that are read."""
LONGEST = 10_000
"""The longest text that a person may write (characters)."""
LONG_NAME = 1_000
"""The longest name, heading or address in an entry (characters)."""
MOST_ABOUT = 20
"""The largest number of addresses in an entry."""
_KEY = re.compile(r"[0-9a-f]{32}(-[1-9][0-9]{0,5})?", re.ASCII)
_ID = re.compile(r"[0-9a-f]{32}", re.ASCII)
_NAMES = tuple(field.name for field in fields(ReviewEntry))
_ADVICE = "Put back your own copy of the file, or move it away. Nothing was changed."


def review_beside(file: str) -> str:
    """Return the path of the review that stands beside a blueprint's file."""
    return f"{file}{SUFFIX}"


def written_review(review: Review) -> bytes:
    """Return the bytes of a review. Equal reviews give equal bytes."""
    rows = [json.dumps({**asdict(one), "about": list(one.about)}) for one in review.entries]
    body = ",\n".join(rows)
    return f'{{"form": "{FORM}", "entries": [\n{body}\n]}}\n'.encode("ascii")


def read_review(raw: bytes, file: str) -> Review:
    """Return the review in the bytes of a file. ReadError, with a place, if it is none."""
    if len(raw) > LARGEST:
        raise _wrong(raw, file, f"the review is larger than {LARGEST >> 20} MB")
    try:
        values = read_strictly(raw, "the review")
    except SealError as error:
        raise _wrong(raw, file, error.sentence) from None
    if not isinstance(values, dict) or set(values) != {"form", "entries"}:
        raise _wrong(raw, file, 'the review is not of the form {"form": ..., "entries": [...]}')
    if values["form"] != FORM:
        raise _wrong(raw, file, f"the form of the review is not {FORM!r}", "form")
    listed = values["entries"]
    if not isinstance(listed, list) or len(listed) > MOST:
        raise _wrong(raw, file, f"entries is no list of at most {MOST:,} entries", "entries")
    found = []
    for number, one in enumerate(listed):
        heed()
        try:
            found.append(_entry(one))
        except ValueError as error:
            raise _wrong(
                raw, file, f"entry {number + 1}: {error}", "entries", str(number)
            ) from None
    return _joined(found, raw, file)


def _joined(found: list[ReviewEntry], raw: bytes, file: str) -> Review:
    comments = {one.id for one in found if one.kind == COMMENT}
    for number, one in enumerate(found):
        if one.kind in TO_COMMENT and one.to not in comments:
            words = f"entry {number + 1} answers a comment that is not in the review"
            raise _wrong(raw, file, words, "entries", str(number))
    return Review.of(found)


def checked(entry: ReviewEntry) -> ReviewEntry:
    """Return an entry that can be written and read again. ValueError, with a sentence, if it
    cannot.
    """
    return _entry({**asdict(entry), "about": list(entry.about)})


def _entry(values: Json) -> ReviewEntry:
    if not isinstance(values, dict) or set(values) != set(_NAMES):
        raise ValueError(f"it has not exactly the keys {', '.join(_NAMES)}")
    for name in _NAMES[:-1]:
        _check_text(name, values[name])
    about = values["about"]
    if not isinstance(about, list) or len(about) > MOST_ABOUT:
        raise ValueError(f"about is no list of at most {MOST_ABOUT} addresses")
    for one in about:
        _check_text("about", one)
    if values["kind"] not in KINDS:
        raise ValueError(f"its kind is not one of {', '.join(KINDS)}")
    if not _KEY.fullmatch(values["line"]):
        raise ValueError("its line is no key of a line")
    if not values["person"].strip():
        raise ValueError("it names no person")
    if values["kind"] in (COMMENT, TO_COMMENT[0]) and not values["text"].strip():
        raise ValueError(f"a {values['kind']} has no text")
    if values["kind"] not in TO_COMMENT and values["to"]:
        raise ValueError("it belongs to no comment and names one")
    if values["kind"] in TO_COMMENT and not _ID.fullmatch(values["to"]):
        raise ValueError("it does not say which comment it belongs to")
    _check_time(values["time"])
    return ReviewEntry(**{**values, "about": tuple(about)})


def _check_text(name: str, value: Json) -> None:
    most = LONGEST if name == "text" else LONG_NAME
    if not isinstance(value, str) or len(value) > most:
        raise ValueError(f"{name} is no text of at most {most:,} characters")


def _check_time(text: str) -> None:
    """Only one spelling of a time is taken, so that times sort as texts."""
    if written_time(read_time(text)) != text:
        raise ValueError(f"{text[:40]!r} is no time with microseconds")


def _wrong(raw: bytes, file: str, sentence: str, *path: str) -> ReadError:
    """Return the error. The place is that of the value at the path."""
    return ReadError(sentence, _place(raw, file, path), _ADVICE)


def _place(raw: bytes, file: str, path: tuple[str, ...]) -> Place:
    """Return the place of a value; without a path, or in no JSON, the beginning."""
    from smsl_studio.smsl.files import parse_text

    try:
        return parse_text(raw.decode("utf-8"), file).place(path)
    except ReadError as error:
        return error.place or Place(file, 1, 1)
    except (ValueError, RecursionError):
        return Place(file, 1, 1)
