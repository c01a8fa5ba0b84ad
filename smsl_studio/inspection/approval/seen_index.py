"""The index of the records that the store has seen.

Each record has a small file, so that a search is quick.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from smsl_studio.errors import SealError
from smsl_studio.inspection.approval.store_files import read_stored, store_folder

Json = Any
ENTRY, ENVELOPE = ".json", ".envelope"
"""The suffix of an entry's file, and that of the file beside it with the whole record."""

_TEXTS = ("person", "key", "file", "time", "closure")


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

    A record with the same ``closure`` counts, too, wherever its file was. ``person`` limits the
    search to the records of one person.
    """
    real, best, when = os.path.realpath(file), "", ""
    for digest, one in entries():
        fits = one["file"] == real or (closure and one["closure"] == closure)
        if fits and (person is None or one["person"] == person) and one["time"] > when:
            best, when = digest, one["time"]
    return best


def is_followed(digest: str) -> bool:
    """Return whether a record was seen that comes after this one in the chain of a person."""
    return any(one["follows"] == digest for _, one in entries())


def records_folder() -> Path:
    """Return the folder of the records. It exists only after the first record was seen."""
    return store_folder() / "records"


def _is_entry(found: Mapping[str, Json]) -> bool:
    follows = found.get("follows")
    texts = all(isinstance(found.get(key), str) for key in _TEXTS)
    return texts and (follows is None or isinstance(follows, str))
