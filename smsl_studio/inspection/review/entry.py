"""One entry of a review: what one person says about one line of the reading."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass
from functools import cached_property

APPROVED, TAKEN_BACK, COMMENT, REPLY, CLOSED = KINDS = (
    "approved",
    "taken back",
    "comment",
    "reply",
    "closed",
)
"""A line is approved, an approval is taken back, a comment is written, answered and closed."""
TO_COMMENT = (REPLY, CLOSED)
"""The kinds that belong to a comment."""


@dataclass(frozen=True)
class ReviewEntry:
    """What one person says about one line.

    ``line`` is the key of the line, ``section`` that of its section, and ``heading`` the words of
    the line at that time. ``about`` are the addresses that the line tells, as texts. ``time`` is
    UTC in the form of RFC 3339, with microseconds. ``text`` is empty only if the kind needs no
    words. ``to`` is the ``id`` of the comment that is answered or closed.
    """

    kind: str
    line: str
    section: str
    heading: str
    person: str
    role: str
    time: str
    text: str = ""
    to: str = ""
    about: tuple[str, ...] = ()

    @cached_property
    def id(self) -> str:
        """The name of the entry. Equal entries have equal names, on every computer."""
        text = json.dumps(asdict(self), sort_keys=True)
        return hashlib.sha256(text.encode("ascii")).hexdigest()[:32]

    @property
    def order(self) -> tuple[str, str, str]:
        """The key by which entries are sorted: time, person, name of the entry."""
        return self.time, self.person, self.id
