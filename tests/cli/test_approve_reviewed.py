"""``approve`` asks about the comments in ``FILE.review.json``: nobody signs while one is open."""

from __future__ import annotations

from pathlib import Path

import smsl_studio as smsl
from smsl_studio.front.review_matter import review_matter
from smsl_studio.front.reviews import keep_answers, review_of
from smsl_studio.inspection.review.review_author import ReviewAuthor
from smsl_studio.inspection.review.reviewed import ReviewedLine, ReviewedReading
from tests.cli.people import Desk

SURGEON, ENGINEER = ReviewAuthor("M. Reyes", "surgeon"), ReviewAuthor("J. Lindqvist", "engineer")


def line_of(desk: Desk) -> ReviewedLine:
    """The first line of the reading, as the surgeon sees it."""
    review = review_of(desk.file)
    return ReviewedReading(review_matter(smsl.read(desk.file)).reading, review, "M. Reyes").lines[0]


def asked(desk: Desk, text: str) -> None:
    """Let the surgeon comment on a line."""
    keep_answers(desk.file, SURGEON.comment(review_of(desk.file), line_of(desk), text))


def test_an_open_comment_refuses_until_its_writer_closes_it(desk: Desk) -> None:
    asked(desk, "Which door is it?")
    refused = desk.approve("ada", "--format", "json")
    assert refused.status == 1
    assert "a comment of M. Reyes (surgeon) is open" in refused.err
    assert "Which door is it?" in refused.err
    assert "Answer each comment in Review" in refused.err
    assert refused.json["record"] is None
    assert not desk.record.exists()
    (comment,) = review_of(desk.file).open_comments
    keep_answers(desk.file, ENGINEER.reply(review_of(desk.file), comment, "The left one."))
    assert desk.approve("ada").status == 1, "an answer does not close it"
    (comment,) = review_of(desk.file).open_comments
    keep_answers(desk.file, SURGEON.close(review_of(desk.file), comment))
    assert desk.approve("ada").status == 0
    assert desk.codes() == []


def test_a_comment_whose_line_has_changed_is_still_open(desk: Desk) -> None:
    asked(desk, "Which door is it?")
    text = Path(desk.file).read_text("utf-8")
    Path(desk.file).write_text(text.replace("State_1", "State_2"), "utf-8")
    assert "is open" in desk.approve("ada").err
    assert not desk.record.exists()


def test_every_reason_is_said_and_a_rejection_may_have_open_comments(desk: Desk) -> None:
    asked(desk, "Which door is it?")
    asked(desk, "And who opens it?\nA porter?")
    text = Path(desk.file).read_text("utf-8")
    Path(desk.file).write_text(text.replace('"State_1"', '"State_9"', 1), "utf-8")
    refused = desk.approve("ada").err
    assert refused.count("a comment of M. Reyes") == 2
    assert "R02" in refused or "R03" in refused
    assert "Mend each error" in refused
    assert "Answer each comment" in refused
    assert desk.approve("ada", "--verdict", "rejected").status == 0


def test_a_review_that_cannot_be_read_is_no_review_without_comments(desk: Desk) -> None:
    Path(f"{desk.file}.review.json").write_text("{", "utf-8")
    answer = desk.approve("ada")
    assert answer.status != 0
    assert "review.json" in answer.err
    assert not desk.record.exists()
