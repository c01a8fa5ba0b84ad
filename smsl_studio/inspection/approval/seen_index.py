"""The index of the records that the store has seen: small files that are quick to look through."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from smsl_studio.errors import SealError
from smsl_studio.inspection.approval.store_files import read_stored, store_folder

Json = Any
ENTRY, ENVELOPE = ".json", ".envelope"
"""The suffix of an entry of the index, and of the file beside it that has the record itself."""

_TEXTS = ("person", "key", "file", "time", "closure")


def entries() -> Iterator[tuple[str, Mapping[str, Json]]]:
    """Yield the entries by the digests of their records. SealError if one is not believed."""
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
    """Return the digest of the newest record that was seen for a file, or for a closure, and of a
    person if one is named. Empty if there is none."""
    real, best, when = os.path.realpath(file), "", ""
    for digest, one in entries():
        fits = one["file"] == real or (closure and one["closure"] == closure)
        if fits and (person is None or one["person"] == person) and one["time"] > when:
            best, when = digest, one["time"]
    return best


def records_folder() -> Path:
    """Return the folder of the records. It need not exist."""
    return store_folder() / "records"


def _is_entry(found: Mapping[str, Json]) -> bool:
    follows = found.get("follows")
    texts = all(isinstance(found.get(key), str) for key in _TEXTS)
    return texts and (follows is None or isinstance(follows, str))
