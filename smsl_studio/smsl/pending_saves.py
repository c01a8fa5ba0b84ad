"""Unfinished saves of several files: which bytes of a file count.

A save keeps a record in the folder ``saving/`` of the user. For each file it has the path, and the
digests of the old and the new bytes. A record named ``.draft`` lists the files that may be removed.
A record named ``.journal`` says that the new bytes count. They are in a file beside each old file
until they replace it. A record is used only if nobody but the user can have written it. Bytes
beside a file are used only if they have the digest in the record. This module writes nothing.
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
"""The limits of a record's bytes, of its files, and of the records that are read. No save or crash
leaves more.
"""


@dataclass(frozen=True)
class PendingFile:
    """One file of a save. ``before`` is the digest of the old bytes (None: there was no file), and
    ``after`` that of the new bytes.
    """

    target: Path
    token: str
    index: int
    before: str | None
    after: str

    @property
    def part(self) -> Path:
        """The file with the new bytes until they replace the old ones."""
        return self._beside("part")

    @property
    def old(self) -> Path:
        """The file with the old bytes as long as they may be needed."""
        return self._beside("old")

    @property
    def untouched(self) -> bool:
        """Whether the file still has its old bytes."""
        with suppress(OSError):
            return self.holds(self.before)
        return False

    def holds(self, digest: str | None) -> bool:
        """Return whether the file is no link and has this digest (None: whether there is no file).

        OSError if that cannot be checked.
        """
        return os.path.realpath(self.target) == str(self.target) and (
            digest_at(self.target) == digest
        )

    def new_bytes(self) -> bytes | None:
        """Return the new bytes, None if they are not beside the file as they were written."""
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
    """One save and its record. ``begun`` is its time, in seconds since 1970."""

    record: Path
    files: tuple[PendingFile, ...]
    begun: float = 0.0

    @property
    def folders(self) -> tuple[Path, ...]:
        """The folders of its files, each once."""
        return tuple(dict.fromkeys(file.target.parent for file in self.files))

    @property
    def counts(self) -> bool:
        """Whether its new bytes count instead of the old ones."""
        return self.record.suffix == JOURNAL

    def renamed(self, suffix: str) -> PendingSave:
        """Return the same save with another suffix of its record."""
        return PendingSave(self.record.with_suffix(suffix), self.files, self.begun)

    def encoded(self) -> bytes:
        """Return the bytes of its record."""
        files = [[str(one.target), one.before, one.after] for one in self.files]
        return json.dumps({"smsl-studio": "saving", "files": files}).encode("ascii")


def digest_of_bytes(raw: bytes) -> str:
    """Return the SHA-256 of some bytes, in hexadecimal."""
    import hashlib  # needed only to save several files, and slow to load

    return hashlib.sha256(raw).hexdigest()


def digest_at(target: Path) -> str | None:
    """Return the digest of a file's bytes, None if there is no file. OSError if it cannot be
    read.
    """
    import hashlib

    try:
        handle = open_ordinary(target)
    except FileNotFoundError:
        return None
    with os.fdopen(handle, "rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def pending_saves(suffix: str = JOURNAL) -> Iterator[PendingSave]:
    """Yield the unfinished saves of this user. With ``DRAFT``, yield those that do not count."""
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
    """Return whether this is a folder in which nobody but the user can write."""
    found = folder.lstat()
    return stat.S_ISDIR(found.st_mode) and is_private(found)


def pending_at(target: Path) -> tuple[PendingFile, bytes] | None:
    """Return the new bytes that count instead of those at ``target`` (a real path).

    None if the bytes at ``target`` count.
    """
    for save in pending_saves():
        for file in save.files:
            if file.target == target and (raw := file.new_bytes()) is not None:
                return (file, raw) if file.untouched else None
    return None


def _read(path: Path) -> PendingSave | None:
    """Return the save of a record. None if it is not a record that this program wrote for this
    user.
    """
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
    """Return the files in a record. Empty if one of them is not valid."""
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
    """Return whether this is an absolute, normalised name of a file."""
    if not isinstance(target, str) or "\0" in target or not Path(target).name:
        return False
    return Path(target).is_absolute() and os.path.normpath(target) == target


def _is_digest(value: Any) -> bool:
    return isinstance(value, str) and _DIGEST.fullmatch(value) is not None
