"""A reading with its answers: what is approved, what is asked, and why nobody can sign yet."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

from smsl_studio.inspection.reading.plain_names import counted
from smsl_studio.inspection.reading.sections import BlueprintReading, ReadingLine, ReadingSection
from smsl_studio.inspection.review.entry import APPROVED, ReviewEntry
from smsl_studio.inspection.review.review import Review, ReviewComment

SINCE = "since"
"""The key of the section "What changed". Its lines are read and need no answer."""


@dataclass(frozen=True)
class ReviewedLine:
    """One line with its answers.

    ``approval`` is that of the person who reads, None if there is none. ``others`` are the
    approvals of other people. ``comments`` are those on this line, and those on its former words if
    the line has changed since. ``was_approved`` says that this person approved the line before it
    changed.
    """

    section: ReadingSection
    line: ReadingLine
    approval: ReviewEntry | None = None
    others: tuple[ReviewEntry, ...] = ()
    comments: tuple[ReviewComment, ...] = ()
    was_approved: bool = False

    @property
    def open_comments(self) -> tuple[ReviewComment, ...]:
        """The comments that are not closed."""
        return tuple(one for one in self.comments if one.is_open)

    @property
    def is_answered(self) -> bool:
        """Whether the person has approved the line and no comment on it is open."""
        return self.approval is not None and not self.open_comments


class ReviewedReading:
    """A reading and a review, as one person sees them."""

    def __init__(self, reading: BlueprintReading, review: Review, person: str) -> None:
        self.reading, self.review, self.person = reading, review, person
        self._keys = {line.key for _, line in reading.lines()}

    @cached_property
    def lines(self) -> tuple[ReviewedLine, ...]:
        """All lines that need an answer, in the order of the reading."""
        moved = self._moved()
        return tuple(
            self._reviewed(section, line, moved.get(line.key, ()))
            for section, line in self.reading.lines()
            if section.key != SINCE
        )

    @cached_property
    def loose(self) -> tuple[ReviewComment, ...]:
        """Comments on lines that the reading does not have any more, and no line takes their
        place.
        """
        placed = {one.entry.id for line in self.lines for one in line.comments}
        return tuple(one for one in self.review.comments if one.entry.id not in placed)

    @property
    def sections(self) -> tuple[ReadingSection, ...]:
        """The parts with lines that need an answer."""
        return tuple(one for one in self.reading.sections if one.key != SINCE and one.lines)

    def of_section(self, key: str) -> tuple[ReviewedLine, ...]:
        """Return the lines of a section."""
        return tuple(one for one in self.lines if one.section.key == key)

    @property
    def left(self) -> int:
        """The number of lines that this person has not approved."""
        return sum(one.approval is None for one in self.lines)

    def why_not_signed(self) -> tuple[str, ...]:
        """Return why this person cannot sign yet, one sentence a reason. Empty: nothing is open.

        Every line must have an approval of this person, an open point with a note. No comment may
        be open, whoever wrote it.
        """
        return tuple(self._reasons())

    def _reasons(self) -> Iterator[str]:
        if not self.lines:
            yield "There is nothing to sign: the procedure has no lines."
        comments = self.review.open_comments
        if comments:
            who = ", ".join(dict.fromkeys(one.entry.person for one in comments))
            verb = "is" if len(comments) == 1 else "are"
            yield f"{counted(len(comments), 'comment')} {verb} open, of {who}."
        open_points = sum(one.line.open_point and one.approval is None for one in self.lines)
        if self.left:
            verb = "has" if self.left == 1 else "have"
            yield f"{counted(self.left, 'line')} {verb} no approval of yours."
        if open_points:
            verb = "needs" if open_points == 1 else "need"
            yield f"{counted(open_points, 'open point')} {verb} your remark."

    def _reviewed(
        self, section: ReadingSection, line: ReadingLine, moved: tuple[ReviewComment, ...]
    ) -> ReviewedLine:
        approval = self.review.approval(line.key, self.person)
        if approval is not None and line.open_point and not approval.text.strip():
            # Somebody else may have written the file: an open point without a note is not approved.
            approval = None
        return ReviewedLine(
            section,
            line,
            approval,
            tuple(one for one in self.review.approvals(line.key) if not self._is_mine(one)),
            (*moved, *self.review.about_line(line.key)),
            approval is None and self._before(section, line),
        )

    def _is_mine(self, entry: ReviewEntry) -> bool:
        return self.review.approval(entry.line, self.person) == entry

    def _before(self, section: ReadingSection, line: ReadingLine) -> bool:
        return any(
            self._is_mine(one) and stands_for(one, section, line)
            for one in self.review.entries
            if one.kind == APPROVED and one.line not in self._keys
        )

    def _moved(self) -> dict[str, tuple[ReviewComment, ...]]:
        """Return by the key of a line the comments on its former words."""
        found: dict[str, tuple[ReviewComment, ...]] = {}
        lines = [one for one in self.reading.lines() if one[0].key != SINCE]
        for comment in self.review.comments:
            if comment.entry.line in self._keys:
                continue
            for section, line in lines:
                if stands_for(comment.entry, section, line):
                    found[line.key] = (*found.get(line.key, ()), comment)
                    break
        return found


class SaidOfLine(Protocol):
    """What somebody has said of a line: the key of its section, its words, and its elements."""

    @property
    def section(self) -> str:
        """The key of the section."""

    @property
    def heading(self) -> str:
        """The words of the line at that time."""

    @property
    def about(self) -> tuple[str, ...]:
        """The addresses that the line tells."""


def stands_for(entry: SaidOfLine, section: ReadingSection, line: ReadingLine) -> bool:
    """Return whether a line tells what an entry was about, perhaps in other words.

    It has the same heading, or it is about the same operation or situation.
    """
    if entry.section != section.key:
        return False
    about = {str(one) for one in line.about if one.state}
    return entry.heading == line.heading or not about.isdisjoint(entry.about)
