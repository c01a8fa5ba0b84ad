"""A review: all entries of all people about one blueprint, in the order of time.

Nothing is ever taken out, so two reviews are merged by taking all entries of both. The present
state of a line is worked out from its entries.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

from smsl_studio.blueprint.person_names import same_name
from smsl_studio.inspection.review.entry import (
    APPROVED,
    CLOSED,
    COMMENT,
    REPLY,
    TAKEN_BACK,
    ReviewEntry,
)


@dataclass(frozen=True)
class ReviewComment:
    """A comment with the answers to it, and who closed it (None while it is open)."""

    entry: ReviewEntry
    replies: tuple[ReviewEntry, ...] = ()
    closed: ReviewEntry | None = None

    @property
    def is_open(self) -> bool:
        """Whether nobody who may do so has closed the comment."""
        return self.closed is None

    @property
    def is_answered(self) -> bool:
        """Whether the last word about the comment is that of somebody else."""
        last = self.replies[-1] if self.replies else self.entry
        return same_name(last.person) != same_name(self.entry.person)


@dataclass(frozen=True)
class Review:
    """The entries of a review. Each one stands in it once, and they have their order."""

    entries: tuple[ReviewEntry, ...] = ()

    @classmethod
    def of(cls, entries: Iterable[ReviewEntry]) -> Review:
        """Return the review with these entries, sorted, each once."""
        once = {entry.id: entry for entry in entries}
        return cls(tuple(sorted(once.values(), key=lambda one: one.order)))

    def merged(self, *others: Review) -> Review:
        """Return a review with all entries of all of them. The order of the arguments has no
        effect.
        """
        return Review.of(entry for one in (self, *others) for entry in one.entries)

    def approval(self, line: str, person: str) -> ReviewEntry | None:
        """Return the approval of a line (its key) by a person, None if there is none that counts:
        the last word counts.
        """
        last = self._words.get((line, same_name(person)))
        return last if last is not None and last.kind == APPROVED else None

    def approvals(self, line: str) -> tuple[ReviewEntry, ...]:
        """Return the approvals of a line that count, one of each person, in the order of time."""
        found = [one for (key, _), one in self._words.items() if key == line]
        return tuple(
            sorted((one for one in found if one.kind == APPROVED), key=lambda one: one.order)
        )

    @cached_property
    def comments(self) -> tuple[ReviewComment, ...]:
        """All comments with their answers, in the order of time."""
        replies: dict[str, list[ReviewEntry]] = {}
        closings: dict[str, list[ReviewEntry]] = {}
        for entry in self.entries:
            if entry.kind in (REPLY, CLOSED):
                (replies if entry.kind == REPLY else closings).setdefault(entry.to, []).append(
                    entry
                )
        return tuple(
            ReviewComment(
                entry,
                tuple(replies.get(entry.id, ())),
                next((one for one in closings.get(entry.id, ()) if may_close(one, entry)), None),
            )
            for entry in self.entries
            if entry.kind == COMMENT
        )

    @cached_property
    def open_comments(self) -> tuple[ReviewComment, ...]:
        """The comments that nobody has closed yet."""
        return tuple(one for one in self.comments if one.is_open)

    def about_line(self, line: str) -> tuple[ReviewComment, ...]:
        """Return the comments on a line, by its key."""
        return tuple(one for one in self.comments if one.entry.line == line)

    @cached_property
    def _words(self) -> Mapping[tuple[str, str], ReviewEntry]:
        """The last approval, or the taking back of it, of each person for each line."""
        return {
            (entry.line, same_name(entry.person)): entry
            for entry in self.entries
            if entry.kind in (APPROVED, TAKEN_BACK)
        }


def may_close(closing: ReviewEntry, comment: ReviewEntry) -> bool:
    """Return whether an entry may close a comment: it is of the same person or of the same role.

    Nobody else can close it, so an engineer cannot close what a surgeon has asked.
    """
    if same_name(closing.person) == same_name(comment.person):
        return True
    return bool(same_name(comment.role)) and same_name(closing.role) == same_name(comment.role)
