"""Reads and keeps the review beside a blueprint.

Each answer is written at once: first to a journal in the user's folder, then to the file of the
review, each completely or not at all. If the file cannot be written, the journal keeps the answer,
and the next answer brings it to the file. What somebody else has written meanwhile is merged.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

from smsl_studio.errors import ReadError, SaveError
from smsl_studio.home import user_folder
from smsl_studio.inspection.review.entry import ReviewEntry
from smsl_studio.inspection.review.review import Review
from smsl_studio.inspection.review.review_file import (
    LARGEST,
    read_review,
    review_beside,
    written_review,
)
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.smsl.disk import held
from smsl_studio.smsl.files import save_document
from smsl_studio.smsl.inputs import NOTHING, Seen, read_ordinary

PATIENCE = 2.0
"""The longest time to wait for another program that keeps answers in this folder (wall seconds)."""
_EMPTY = Review()
_SHOWN = 200
"""So many letters of a comment and of its line are said in a refusal."""


def review_of(file: str) -> Review:
    """Return the review of a blueprint's file: the one beside it, and answers in the journal.

    ReadError, with a place and an advice, if a file is there and is no review.
    """
    return _read(review_beside(file))[0].merged(_journalled(file))


def waiting_answers(file: str) -> Review:
    """Return the answers that wait in the journal until the file of the review can be written."""
    return _journalled(file)


def open_comments_said(file: str) -> tuple[str, ...]:
    """Return a sentence about each open comment on a blueprint's file. ReadError as ``review_of``.

    Nobody signs while there is one.
    """
    return tuple(
        f"a comment of {one.person}{f' ({one.role})' if one.role else ''} is open, about "
        f"“{one.heading[:_SHOWN]}”: {one.text[:_SHOWN]}"
        for one in (comment.entry for comment in review_of(file).open_comments)
    )


def review_in(path: str) -> Review:
    """Return the review in a file, such as one from another computer. ReadError if it is none."""
    found, seen = _read(path)
    if seen == NOTHING:
        raise ReadError(f"{path} does not exist", advice="Choose a file that ends in .review.json.")
    return found


def keep_answers(file: str, entries: Iterable[ReviewEntry]) -> Review:
    """Add entries to the review of a blueprint's file, and return the review with all entries.

    SaveError if the file cannot be written: then the entries are kept in the journal. ReadError if
    the file that is there is no review.
    """
    path = review_beside(file)
    journal = _journal(file)
    wanted = _journalled(file).merged(Review.of(entries))
    with suppress(SaveError, OSError):
        journal.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        save_document(written_review(wanted), journal)
    with held([Path(path).absolute().parent], PATIENCE) as alone:
        if not alone:
            raise SaveError(
                f"{path} was not saved: another program is writing in this folder",
                advice="The answer is kept. It is written with the next answer.",
            )
        present, seen = _read(path)
        whole = present.merged(wanted)
        if whole != present or seen == NOTHING:
            save_document(written_review(whole), path, seen)
    if _journalled(file) == wanted:  # no other window has added to it meanwhile
        with suppress(OSError):
            journal.unlink()
    return whole


def _read(path: str) -> tuple[Review, Seen]:
    try:
        seen = read_ordinary(path, LARGEST)
    except FileNotFoundError:
        return _EMPTY, NOTHING
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ReadError(
            f"{path} cannot be read: {reason}",
            advice="Check the right to read it, or move it away.",
        ) from None
    return read_review(seen.raw, path), seen


def _journal(file: str) -> Path:
    """Return the file that keeps answers until they stand beside the blueprint."""
    name = sha256_hex(os.fsencode(os.path.realpath(file)))
    return user_folder() / "reviews" / f"{name[:32]}.json"


def _journalled(file: str) -> Review:
    """Return the answers in the journal. One that cannot be read has none to offer."""
    try:
        return _read(str(_journal(file)))[0]
    except ReadError:
        return _EMPTY
