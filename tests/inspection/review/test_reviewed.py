"""What is approved and open, and why nobody can sign yet."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import UsageError
from smsl_studio.inspection.reading.sections import BlueprintReading, ReadingLine, ReadingSection
from smsl_studio.inspection.review.review import Review
from smsl_studio.inspection.review.review_author import ReviewAuthor
from smsl_studio.inspection.review.reviewed import ReviewedReading

NOON = datetime(2026, 3, 1, 12, tzinfo=UTC)
SURGEON, ENGINEER = ReviewAuthor("M. Reyes", "surgeon"), ReviewAuthor("J. Lindqvist", "engineer")
FIX = ReadingLine("Fix the leg", about=(Address("A", "S0", "fix"),), key="1" * 32)
DRILL = ReadingLine("Drill", about=(Address("A", "S1", "drill"),), key="2" * 32)
HAZARD = ReadingLine("The leg moves", open_point=True, key="3" * 32)
REMOVED = ReadingLine("Removed: a check", key="4" * 32)


def told(*steps: ReadingLine) -> BlueprintReading:
    sections = (
        ReadingSection("since", "What changed", (REMOVED,)),
        ReadingSection("procedure", "The procedure", steps or (FIX, DRILL)),
        ReadingSection("hazards", "Hazards and controls", (HAZARD,)),
    )
    return BlueprintReading("Fill", "", "a.json", "0" * 64, sections)


def seen(review: Review, *steps: ReadingLine, by: ReviewAuthor = SURGEON) -> ReviewedReading:
    return ReviewedReading(told(*steps), review, by.person)


def all_approved(by: ReviewAuthor = SURGEON, review: Review | None = None) -> Review:
    whole = review or Review()
    for one in seen(whole).lines:
        note = "Accepted: it is watched." if one.line.open_point else ""
        made = by.approve(whole, one, note, NOON)
        whole = whole.merged(Review.of(made))
    return whole


def test_a_person_can_sign_when_every_line_has_an_answer() -> None:
    assert seen(Review()).why_not_signed() == (
        "3 lines have no approval of yours.", "1 open point needs your remark."
    )  # fmt: skip
    assert seen(all_approved()).why_not_signed() == ()
    # Somebody else's answers are not one's own.
    other = seen(all_approved(), by=ENGINEER)
    assert "3 lines have no approval of yours." in other.why_not_signed()
    assert [one.others[0].person for one in other.lines] == ["M. Reyes"] * 3


def test_an_open_comment_of_anybody_blocks_every_signature_until_its_writer_closes_it() -> None:
    review = all_approved()
    asked = Review.of(ENGINEER.comment(review, seen(review).lines[0], "Who helps?", NOON))
    review = review.merged(asked)
    blocked = ("1 comment is open, of J. Lindqvist.",)
    assert seen(review).why_not_signed() == blocked
    (comment,) = review.open_comments
    assert not comment.is_answered
    review = review.merged(Review.of(SURGEON.reply(review, comment, "The nurse.", NOON)))
    assert review.comments[0].is_answered
    assert seen(review).why_not_signed() == blocked
    with pytest.raises(UsageError, match=r"only be closed by J\. Lindqvist or another engineer"):
        SURGEON.close(review, comment, NOON)
    review = review.merged(Review.of(ENGINEER.close(review, comment, NOON)))
    assert seen(review).why_not_signed() == ()


def test_a_closing_by_another_role_in_the_file_counts_for_nothing() -> None:
    review = Review.of(SURGEON.comment(Review(), seen(Review()).lines[0], "Who helps?", NOON))
    (comment,) = review.comments
    (closing,) = SURGEON.close(review, comment, NOON)
    forged = replace(closing, person="J. Lindqvist", role="engineer")
    assert review.merged(Review.of([forged])).open_comments
    nobody = replace(closing, person="Somebody", role="")
    assert review.merged(Review.of([nobody])).open_comments
    assert not review.merged(Review.of([closing])).open_comments


def test_a_comment_takes_back_the_approval_and_an_approval_closes_the_comment() -> None:
    review = all_approved()
    review = review.merged(Review.of(SURGEON.comment(review, seen(review).lines[0], "Why?", NOON)))
    assert seen(review).lines[0].approval is None
    assert not seen(review).lines[0].is_answered
    review = review.merged(Review.of(SURGEON.approve(review, seen(review).lines[0], now=NOON)))
    assert seen(review).lines[0].is_answered
    assert seen(review).why_not_signed() == ()
    review = review.merged(Review.of(SURGEON.take_back(review, seen(review).lines[0], NOON)))
    assert seen(review).left == 1


def test_the_last_word_counts_even_if_the_clock_went_back() -> None:
    review = all_approved()
    before = datetime(2020, 1, 1, tzinfo=UTC)
    review = review.merged(Review.of(SURGEON.take_back(review, seen(review).lines[0], before)))
    assert seen(review).lines[0].approval is None


def test_an_open_point_needs_a_note_also_when_the_file_says_it_is_approved() -> None:
    hazard = seen(Review()).lines[2]
    with pytest.raises(UsageError, match="needs a remark"):
        SURGEON.approve(Review(), hazard, " ", NOON)
    closed = replace(hazard, line=replace(HAZARD, open_point=False))
    (plain,) = SURGEON.approve(Review(), closed, now=NOON)
    assert seen(Review.of([plain])).lines[2].approval is None


def test_an_answer_is_void_when_its_line_changed_and_the_comment_goes_along() -> None:
    review = all_approved()
    review = review.merged(Review.of(ENGINEER.comment(review, seen(review).lines[0], "Who?", NOON)))
    changed = replace(FIX, text=("Two people do it.",), key="5" * 32)
    line = seen(review, changed, DRILL).lines[0]
    assert line.approval is None
    assert line.was_approved
    assert [one.entry.text for one in line.open_comments] == ["Who?"]
    assert not seen(review, changed, DRILL).loose
    # The other step has kept its answer at another place.
    assert seen(review, DRILL, changed).lines[0].is_answered


def test_a_comment_on_a_line_that_is_gone_is_not_lost_and_still_blocks() -> None:
    review = all_approved()
    review = review.merged(Review.of(ENGINEER.comment(review, seen(review).lines[0], "Who?", NOON)))
    without = seen(review, DRILL)
    assert [one.entry.heading for one in without.loose] == ["Fix the leg"]
    assert without.why_not_signed() == ("1 comment is open, of J. Lindqvist.",)


def test_what_changed_since_needs_no_answer() -> None:
    assert [one.line for one in seen(Review()).lines] == [FIX, DRILL, HAZARD]
