"""The person who answers: makes the entries of a review."""

from __future__ import annotations

from dataclasses import dataclass, replace
from datetime import UTC, datetime, timedelta

from smsl_studio.blueprint.person_names import same_name
from smsl_studio.errors import UsageError
from smsl_studio.inspection.approval.times import read_time, written_time
from smsl_studio.inspection.review.entry import (
    APPROVED,
    CLOSED,
    COMMENT,
    REPLY,
    TAKEN_BACK,
    ReviewEntry,
)
from smsl_studio.inspection.review.review import Review, ReviewComment, may_close
from smsl_studio.inspection.review.review_file import LONG_NAME, MOST_ABOUT, checked
from smsl_studio.inspection.review.reviewed import ReviewedLine


@dataclass(frozen=True)
class ReviewAuthor:
    """A person with a role, who answers lines of a reading.

    Each method returns the new entries; nothing is written. UsageError, with an advice, if the
    answer is not possible. ``now`` is the time of the answer, by default that of the clock.
    """

    person: str
    role: str = ""

    def approve(
        self, review: Review, at: ReviewedLine, note: str = "", now: datetime | None = None
    ) -> tuple[ReviewEntry, ...]:
        """Approve a line, and close the comments on it that this person may close.

        An open point can only be approved with a note, which says why.
        """
        if at.line.open_point and not note.strip():
            raise UsageError(
                f"“{at.line.heading}” is open, so approving it needs a remark",
                advice="Write why it may stay as it is, or write a comment.",
            )
        when = self._after(review, now)
        own = [one.entry for one in at.open_comments if self.may_close(one)]
        return (
            *(self._to(CLOSED, one, "", when) for one in own),
            self._on(APPROVED, at, note.strip(), when),
        )

    def take_back(
        self, review: Review, at: ReviewedLine, now: datetime | None = None
    ) -> tuple[ReviewEntry, ...]:
        """Take an approval back. Nothing happens if this person has not approved the line."""
        if review.approval(at.line.key, self.person) is None:
            return ()
        return (self._on(TAKEN_BACK, at, "", self._after(review, now)),)

    def comment(
        self, review: Review, at: ReviewedLine, text: str, now: datetime | None = None
    ) -> tuple[ReviewEntry, ...]:
        """Write a comment on a line. An approval of the line by this person is taken back."""
        when = self._after(review, now)
        back = self.take_back(review, at, read_time(when))
        return (*back, self._on(COMMENT, at, text.strip(), when))

    def reply(
        self, review: Review, comment: ReviewComment, text: str, now: datetime | None = None
    ) -> tuple[ReviewEntry, ...]:
        """Answer a comment."""
        return (self._to(REPLY, comment.entry, text.strip(), self._after(review, now)),)

    def close(
        self, review: Review, comment: ReviewComment, now: datetime | None = None
    ) -> tuple[ReviewEntry, ...]:
        """Close a comment. Only its writer, or a person with the role of the writer, can do so."""
        if not self.may_close(comment):
            who = comment.entry.person
            role = f" or another {comment.entry.role}" if comment.entry.role else ""
            raise UsageError(
                f"the comment of {who} can only be closed by {who}{role}",
                advice="Answer it. The writer of the comment then closes it.",
            )
        return (self._to(CLOSED, comment.entry, "", self._after(review, now)),)

    def may_close(self, comment: ReviewComment) -> bool:
        """Return whether this person may close a comment."""
        return may_close(replace(comment.entry, person=self.person, role=self.role), comment.entry)

    def _after(self, review: Review, now: datetime | None) -> str:
        """Return the time of a new entry. It is later than all entries of this person, so that the
        person's last word counts even after the clock was set back.
        """
        when = now or datetime.now(UTC)
        own = [
            one.time for one in review.entries if same_name(one.person) == same_name(self.person)
        ]
        if own:
            when = max(when, read_time(max(own)) + timedelta(microseconds=1))
        return written_time(when)

    def _on(self, kind: str, at: ReviewedLine, text: str, when: str) -> ReviewEntry:
        line = at.line
        about = tuple(str(one)[:LONG_NAME] for one in line.about[:MOST_ABOUT])
        heading = line.heading[:LONG_NAME]
        entry = ReviewEntry(
            kind, line.key, at.section.key, heading, self.person, self.role, when, text, about=about
        )
        return _valid(entry)

    def _to(self, kind: str, comment: ReviewEntry, text: str, when: str) -> ReviewEntry:
        own = replace(
            comment, kind=kind, person=self.person, role=self.role, time=when, text=text,
            to=comment.id,
        )  # fmt: skip
        return _valid(own)


def _valid(entry: ReviewEntry) -> ReviewEntry:
    try:
        return checked(entry)
    except ValueError as error:
        raise UsageError(
            f"this answer cannot be kept: {error}",
            advice="Say who you are, and write some words.",
        ) from None
