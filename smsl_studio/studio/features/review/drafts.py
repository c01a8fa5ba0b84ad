"""What people have begun to write in Review and have neither kept nor left.

A draft belongs to a person and a line. It is stored at every letter, so that no rebuilt page, other
mode, other file or end of the program takes it away.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass, replace
from typing import Any

from smsl_studio.inspection.review.review_file import LONG_NAME, LONGEST, MOST_ABOUT
from smsl_studio.inspection.review.reviewed import ReviewedLine, stands_for
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.studio.base.settings import Settings

COMMENT, NOTE, REPLY = KINDS = ("comment", "note", "reply")
"""A comment, the note that approves an open point, the answer to a comment."""
MOST = 100
"""At most so many drafts of a file are read."""
_PLACE = "review_drafts/"


@dataclass(frozen=True)
class ReviewDraft:
    """A text that a person has begun at a line.

    ``line``, ``section``, ``heading`` and ``about`` say where, as in an entry of the review. ``to``
    is the id of the comment that is answered.
    """

    kind: str
    person: str
    line: str
    section: str
    heading: str
    about: tuple[str, ...] = ()
    to: str = ""
    text: str = ""


class ReviewDrafts:
    """The drafts of one window, at most one for each person and line.

    ``file`` gives the path of the open file, empty if it has none; the drafts of a file are stored
    in the settings.
    """

    def __init__(self, settings: Settings, file: Callable[[], str]) -> None:
        self._settings, self._file = settings, file
        self._at = ""
        self._drafts: dict[tuple[str, str], ReviewDraft] = {}
        self.load()

    def load(self) -> None:
        """Take the drafts of the file that is open now."""
        self._at = self._file()
        text = self._settings.text_of(_place(self._at)) if self._at else ""
        self._drafts = {(one.person, one.line): one for one in _read(text)}

    def follow(self) -> None:
        """Take the drafts along, because the file has another path now."""
        if self._file() != self._at:
            if self._at:
                self._settings.store_text(_place(self._at), "")
            self._at = self._file()
            self._store()

    def begun(self, person: str) -> tuple[ReviewDraft, ...]:
        """The drafts of a person in which something is written."""
        mine = (one for one in self._drafts.values() if one.person == person)
        return tuple(one for one in mine if one.text.strip())

    def put(self, draft: ReviewDraft) -> None:
        """Keep a draft in the place of the one before."""
        self._drafts[draft.person, draft.line] = replace(draft, text=draft.text[:LONGEST])
        self._store()

    def drop(self, person: str, line: str) -> None:
        """Forget the draft of a person at a line, because its text was kept or left."""
        if self._drafts.pop((person, line), None) is not None:
            self._store()

    def of_line(
        self, one: ReviewedLine, lines: Iterable[ReviewedLine], person: str
    ) -> ReviewDraft | None:
        """The draft of a person that belongs to a line; None if there is none.

        The draft of a line that is gone belongs to the line that stands for it now, else to the
        first of its section, else to the first of all. It then has the key of that line.
        """
        found = self._drafts.get((person, one.line.key))
        if found is not None:
            return found
        lines = tuple(lines)
        keys = {line.line.key for line in lines}
        for lost in [one for one in self._drafts.values() if one.person == person]:
            if lost.line not in keys and _home(lost, lines) is one:
                del self._drafts[person, lost.line]
                self.put(replace(lost, line=one.line.key))
                return self._drafts[person, one.line.key]
        return None

    def _store(self) -> None:
        if self._at:
            kept = [asdict(one) for one in self._drafts.values() if one.text.strip()]
            self._settings.store_text(_place(self._at), json.dumps(kept) if kept else "")


def _home(lost: ReviewDraft, lines: tuple[ReviewedLine, ...]) -> ReviewedLine | None:
    standing = [one for one in lines if stands_for(lost, one.section, one.line)]
    beside = [one for one in lines if one.section.key == lost.section]
    return next(iter((*standing, *beside, *lines)), None)


def _place(file: str) -> str:
    return _PLACE + sha256_hex(file.encode("utf-8", "surrogateescape"))[:32]


def _read(text: str) -> tuple[ReviewDraft, ...]:
    """The drafts in a text of the settings; what does not fit is left out."""
    try:
        found = json.loads(text or "[]")
    except (ValueError, RecursionError):
        return ()
    rows = found[:MOST] if isinstance(found, list) else []
    return tuple(draft for row in rows if (draft := _draft(row)) is not None)


def _draft(row: Any) -> ReviewDraft | None:
    try:
        made = ReviewDraft(**{**row, "about": tuple(row["about"])})
    except (TypeError, KeyError):
        return None
    names = (made.person, made.line, made.section, made.heading, made.to, *made.about)
    if not all(isinstance(one, str) for one in (*names, made.text)):
        return None
    fits = len(made.about) <= MOST_ABOUT and max(map(len, names)) <= LONG_NAME
    return made if made.kind in KINDS and fits and 0 < len(made.text) <= LONGEST else None
