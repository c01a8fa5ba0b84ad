"""The index of the records that the store has seen.

Each record has a small file, so that a search is quick.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from operator import itemgetter
from pathlib import Path
from typing import Any

from smsl_studio.errors import SealError
from smsl_studio.inspection.approval.store_files import read_stored, store_folder

Json = Any
ENTRY, ENVELOPE = ".json", ".envelope"
"""The suffix of an entry's file, and that of the file beside it with the whole record."""

_TEXTS = ("person", "key", "file", "time", "closure")
COPY = ("apart", "behind")
"""What an entry has besides if its record was signed in a copy (see ``SeenRecord``)."""


def entries() -> Iterator[tuple[str, Mapping[str, Json]]]:
    """Yield each entry with the digest of its record.

    SealError if another person could have written an entry, or if it is not what Studio writes.
    """
    folder = records_folder()
    try:
        names = sorted(path for path in folder.iterdir() if path.suffix == ENTRY)
    except (FileNotFoundError, NotADirectoryError):
        return
    for path in names:
        found = read_stored(path)
        if found is None:
            continue
        if not isinstance(found, dict) or not _is_entry(found):
            raise SealError(f"{path} is not what Studio wrote", advice="Put back your copy of it.")
        yield path.stem, found


def newest_entry(file: str, closure: str = "", person: str | None = None) -> str:
    """Return the digest of the newest record that was seen for a file; empty if there is none.

    If there is none, a record with the same ``closure`` counts, wherever its file was. If that file
    is gone it was moved, and then its record counts like one for this file. ``person`` limits the
    search to the records of one person.
    """
    real, best, rank = os.path.realpath(file), "", (False, "")
    for digest, one in entries():
        here = one["file"] == real
        if not here and not (closure and one["closure"] == closure):
            continue
        if person is None or one["person"] == person:
            found = (here or not os.path.lexists(one["file"]), one["time"])
            best, rank = max((best, rank), (digest, found), key=itemgetter(1))
    return best


def is_followed(digest: str, file: str) -> bool:
    """Return whether a record was seen that comes after this one in the chain of a person.

    One that was signed in a copy of ``file`` does not count.
    """
    real = os.path.realpath(file)
    return any(one["follows"] == digest and one.get("apart") != real for _, one in entries())


def copied_from(digest: str, file: str) -> str:
    """Return the file of which ``file`` is a copy; empty if it is none.

    It is one if a record was seen for a file at another place that still stands. If nothing stands
    there, the file was moved.
    """
    found = read_stored(records_folder() / f"{digest}{ENTRY}")
    former = found["file"] if isinstance(found, dict) and _is_entry(found) else ""
    return former if former != os.path.realpath(file) and os.path.lexists(former) else ""


def records_folder() -> Path:
    """Return the folder of the records. It exists only after the first record was seen."""
    return store_folder() / "records"


def _is_entry(found: Mapping[str, Json]) -> bool:
    follows = found.get("follows")
    texts = all(isinstance(found.get(key), str) for key in _TEXTS)
    copy = all(isinstance(found.get(key, ""), str) for key in COPY)
    return texts and copy and (follows is None or isinstance(follows, str))
