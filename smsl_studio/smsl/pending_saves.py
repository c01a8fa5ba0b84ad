"""Saves of several files that have begun and not ended: which bytes of a file count.

A save keeps a record in the user's folder, in ``saving/``: for each file where it stands, what it
held before and what it is to hold, as digests. A record that ends in ``.draft`` says what may be
cleared away. One that ends in ``.journal`` says that the new bytes count; they stand beside each
file until they have taken its place. A record is believed only where nobody but the user can have
written it, and bytes beside a file only where they have the digest that the record says. Nothing
here writes.
"""

from __future__ import annotations

import json
import os
import re
import stat
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from smsl_studio.home import is_private, saving_folder
from smsl_studio.smsl.document.limits import LARGEST_FILE
from smsl_studio.smsl.inputs import open_ordinary, read_ordinary

JOURNAL, DRAFT = ".journal", ".draft"
_NAME = re.compile(r"(?P<token>[0-9a-f]{12})\.(?:journal|draft)")
_DIGEST = re.compile(r"[0-9a-f]{64}")
_LARGEST, _MOST_FILES, _MOST_RECORDS = 1 << 22, 10_000, 1000
"""Bytes of a record, files of one, records: more than any save or crash leaves are not read."""


@dataclass(frozen=True)
class PendingFile:
    """One file of a save: ``before`` is the digest of what stood there (None: no file), ``after``
    that of its new bytes.
    """

    target: Path
    token: str
    index: int
    before: str | None
    after: str

    @property
    def part(self) -> Path:
        """The file that holds the new bytes until they take their place."""
        return self._beside("part")

    @property
    def old(self) -> Path:
        """The file that keeps the former bytes as long as they may have to come back."""
        return self._beside("old")

    @property
    def untouched(self) -> bool:
        """Whether what stood there before the save still does."""
        with suppress(OSError):
            return self.holds(self.before)
        return False

    def holds(self, digest: str | None) -> bool:
        """Whether the file, which is no link by now, has this digest (None: is not there).

        OSError where that cannot be seen.
        """
        return os.path.realpath(self.target) == str(self.target) and (
            digest_at(self.target) == digest
        )

    def new_bytes(self) -> bytes | None:
        """The new bytes, None where they do not stand beside the file as they were written."""
        with suppress(OSError):
            raw = read_ordinary(self.part, LARGEST_FILE, str(self.part.parent)).raw
            return raw if digest_of_bytes(raw) == self.after else None
        return None

    def _beside(self, ending: str) -> Path:
        from smsl_studio.smsl.disk import short  # nearly always there is no such save

        name = f".{short(self.target.name)}.{self.token}-{self.index}.{ending}"
        return self.target.with_name(name)


@dataclass(frozen=True)
class PendingSave:
    """One save and its record; ``begun`` is when, in seconds since 1970."""

    record: Path
    files: tuple[PendingFile, ...]
    begun: float = 0.0

    @property
    def folders(self) -> tuple[Path, ...]:
        """The folders of its files, each once."""
        return tuple(dict.fromkeys(file.target.parent for file in self.files))

    @property
    def counts(self) -> bool:
        """Whether its new bytes count instead of the former ones."""
        return self.record.suffix == JOURNAL

    def renamed(self, suffix: str) -> PendingSave:
        """The same save under another ending of its record's name."""
        return PendingSave(self.record.with_suffix(suffix), self.files, self.begun)

    def encoded(self) -> bytes:
        """What its record says."""
        files = [[str(one.target), one.before, one.after] for one in self.files]
        return json.dumps({"smsl-studio": "saving", "files": files}).encode("ascii")


def digest_of_bytes(raw: bytes) -> str:
    """The SHA-256 of some bytes, in hex."""
    import hashlib  # needed only where several files are saved, and slow to load

    return hashlib.sha256(raw).hexdigest()


def digest_at(target: Path) -> str | None:
    """The digest of a file's bytes, None where there is no file; OSError where it has none."""
    import hashlib

    try:
        handle = open_ordinary(target)
    except FileNotFoundError:
        return None
    with os.fdopen(handle, "rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def pending_saves(suffix: str = JOURNAL) -> Iterator[PendingSave]:
    """The saves of this user that have not ended; with ``DRAFT`` those that do not count."""
    with suppress(OSError, ValueError):
        folder = saving_folder()
        if not is_safe(folder):
            return
        paths = sorted(path for path in folder.iterdir() if path.name.endswith(suffix))
        for path in paths[:_MOST_RECORDS]:
            save = _read(path) if _NAME.fullmatch(path.name) else None
            if save is not None:
                yield save


def is_safe(folder: Path) -> bool:
    """Whether a folder is one, and nobody but the user can write in it."""
    found = folder.lstat()
    return stat.S_ISDIR(found.st_mode) and is_private(found)


def pending_at(target: Path) -> tuple[PendingFile, bytes] | None:
    """The new bytes that count instead of what stands at ``target`` (a real path).

    None where what stands there counts.
    """
    for save in pending_saves():
        for file in save.files:
            if file.target == target and (raw := file.new_bytes()) is not None:
                return (file, raw) if file.untouched else None
    return None


def _read(path: Path) -> PendingSave | None:
    """The save of a record; None where it is none that this program has written for this user."""
    with suppress(OSError, ValueError, RecursionError):
        handle = open_ordinary(path, str(path.parent))
        with os.fdopen(handle, "rb") as stream:
            found = os.fstat(handle)
            if not is_private(found) or found.st_nlink != 1 or found.st_size > _LARGEST:
                return None
            written = json.loads(stream.read(_LARGEST))
        files = _files(written, path.name[:12])
        return PendingSave(path, tuple(files), found.st_mtime) if files else None
    return None


def _files(written: Any, token: str) -> list[PendingFile]:
    """The files that a record lists; none at all where one of them makes no sense."""
    listed = written.get("files") if isinstance(written, dict) else None
    if not isinstance(listed, list) or len(listed) > _MOST_FILES:
        return []
    files = []
    for index, item in enumerate(listed):
        if not isinstance(item, list) or len(item) != 3:
            return []
        target, before, after = item
        if not (_is_whole(target) and (before is None or _is_digest(before)) and _is_digest(after)):
            return []
        files.append(PendingFile(Path(target), token, index, before, after))
    return files


def _is_whole(target: Any) -> bool:
    """Whether this is the name of a file from the root on."""
    if not isinstance(target, str) or "\0" in target or not Path(target).name:
        return False
    return Path(target).is_absolute() and os.path.normpath(target) == target


def _is_digest(value: Any) -> bool:
    return isinstance(value, str) and _DIGEST.fullmatch(value) is not None
