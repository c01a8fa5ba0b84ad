"""The review beside a blueprint: kept at once, merged, journalled, and what has changed since."""

from __future__ import annotations

import json
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import ReadError, SaveError
from smsl_studio.front import read
from smsl_studio.front.key_ring import make_key
from smsl_studio.front.review_matter import review_matter
from smsl_studio.front.reviews import keep_answers, review_in, review_of
from smsl_studio.front.signatures import ApprovalRequest, approve
from smsl_studio.inspection.review.entry import ReviewEntry
from smsl_studio.inspection.review.review import Review
from smsl_studio.inspection.review.review_author import ReviewAuthor
from smsl_studio.inspection.review.review_file import read_review
from smsl_studio.inspection.review.reviewed import ReviewedReading
from tests.approval import DOOR

SURGEON, ENGINEER = ReviewAuthor("M. Reyes", "surgeon"), ReviewAuthor("J. Lindqvist", "engineer")


def door_at(folder: Path, **titles: str) -> Blueprint:
    folder.mkdir(exist_ok=True)
    notes = {"_operations": {name: {"title": title} for name, title in titles.items()}}
    values: dict[str, Any] = {"DOOR": {**DOOR["DOOR"], **(notes if titles else {})}}
    file = folder / "door.json"
    file.write_text(json.dumps(values), "utf-8")
    return read(str(file))


def approved(blueprint: Blueprint, who: ReviewAuthor, at: int) -> tuple[ReviewEntry, ...]:
    review = review_of(blueprint.file)
    line = ReviewedReading(review_matter(blueprint).reading, review, who.person).lines[at]
    return who.approve(review, line, "It is so." if line.line.open_point else "")


def test_every_answer_is_kept_at_once_and_what_others_wrote_meanwhile_stays(tmp_path: Path) -> None:
    blueprint = door_at(tmp_path)
    one, two = approved(blueprint, SURGEON, 0), approved(blueprint, ENGINEER, 1)
    keep_answers(blueprint.file, one)
    assert keep_answers(blueprint.file, two) == Review.of([*one, *two])
    assert review_of(blueprint.file) == Review.of([*one, *two])
    assert read_review((tmp_path / "door.json.review.json").read_bytes(), "") == review_of(
        blueprint.file
    )
    # The blueprint itself is untouched.
    assert json.loads((tmp_path / "door.json").read_text("utf-8")) == DOOR


def test_two_machines_exchange_their_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    theirs, mine = door_at(tmp_path / "theirs"), door_at(tmp_path / "mine")
    monkeypatch.setenv("SMSL_STUDIO_HOME", str(tmp_path / "home of theirs"))
    keep_answers(theirs.file, approved(theirs, SURGEON, 0))
    monkeypatch.setenv("SMSL_STUDIO_HOME", str(tmp_path / "home of mine"))
    keep_answers(mine.file, approved(mine, ENGINEER, 0))
    whole = keep_answers(mine.file, review_in(f"{theirs.file}.review.json").entries)
    assert [one.person for one in whole.entries] == ["M. Reyes", "J. Lindqvist"]
    assert keep_answers(theirs.file, review_in(f"{mine.file}.review.json").entries) == whole
    both = [Path(f"{one.file}.review.json").read_bytes() for one in (theirs, mine)]
    assert both[0] == both[1]


def test_an_answer_that_cannot_be_written_is_in_the_journal_and_comes_with_the_next_one(
    tmp_path: Path,
) -> None:
    blueprint = door_at(tmp_path)
    place = tmp_path / "door.json.review.json"
    first, second = approved(blueprint, SURGEON, 0), approved(blueprint, SURGEON, 1)
    # A folder stands where the file should be.
    place.mkdir()
    with pytest.raises((SaveError, ReadError)):
        keep_answers(blueprint.file, first)
    place.rmdir()
    assert review_of(blueprint.file) == Review.of(first)
    assert not place.exists()
    keep_answers(blueprint.file, second)
    assert read_review(place.read_bytes(), "") == Review.of([*first, *second])


def test_a_file_that_is_no_review_is_never_replaced(tmp_path: Path) -> None:
    blueprint = door_at(tmp_path)
    entries = approved(blueprint, SURGEON, 0)
    place = tmp_path / "door.json.review.json"
    place.write_text('{"mine": 1}\n', "utf-8")
    with pytest.raises(ReadError) as caught:
        keep_answers(blueprint.file, entries)
    assert str(caught.value.place) == f"{place}:1:1"
    assert place.read_text("utf-8") == '{"mine": 1}\n'
    with pytest.raises(ReadError):
        review_of(blueprint.file)


def test_a_review_that_does_not_exist_is_told(tmp_path: Path) -> None:
    with pytest.raises(ReadError, match="does not exist"):
        review_in(str(tmp_path / "none.review.json"))


def test_only_the_lines_that_changed_since_the_signature_are_marked(tmp_path: Path) -> None:
    blueprint = door_at(tmp_path, open="Open the door", close="Close the door")
    assert review_matter(blueprint).former == ""
    key = make_key("J. Lindqvist", "engineer", b"a passphrase").id
    now = datetime(2026, 3, 1, 12, tzinfo=UTC)
    approve(ApprovalRequest(blueprint, key, b"a passphrase", now=now))
    matter = review_matter(blueprint)
    assert matter.former == "the record of J. Lindqvist of 2026-03-01T12:00:00Z"
    assert (matter.changed, matter.since) == (frozenset(), ())
    answers = approved(blueprint, SURGEON, 2)
    keep_answers(blueprint.file, answers)
    other = door_at(tmp_path, open="Open the gate", close="Close the door")
    matter = review_matter(other)
    lines = [line for _, line in matter.reading.lines() if line.key in matter.changed]
    assert {"Open the gate"} < {line.heading for line in lines}
    assert "Close the door" not in {line.heading for line in lines}
    assert [line.heading[:8] for line in matter.since] == ["Changed:"]
    seen = ReviewedReading(matter.reading, review_of(other.file), SURGEON.person)
    assert all(one.section.key != "since" for one in seen.lines)


def test_a_record_that_cannot_be_read_does_not_hide_the_reading(tmp_path: Path) -> None:
    blueprint = door_at(tmp_path)
    (tmp_path / "door.json.record.json").write_text("no record", "utf-8")
    matter = review_matter(blueprint)
    assert "no JSON" in matter.fault
    assert list(matter.reading.lines())
