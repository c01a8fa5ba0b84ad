"""Opens files for reading. Only ordinary files are opened, so that no read blocks or has other
effects.

A device or a named pipe may have no end, may block a reader for ever, and may act when it is
opened. The one exception is a pipe without a name, such as that of ``<(command)`` in a shell: only
the person who started the program can have given it. All errors here are OSErrors.
"""

from __future__ import annotations

import errno
import os
import stat
from dataclasses import dataclass, field
from pathlib import PurePath

ODD = "it is no ordinary file"
_READ = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
_FOLDER = getattr(os, "O_PATH", os.O_RDONLY) | getattr(os, "O_DIRECTORY", 0)
_NO_LINK = getattr(os, "O_NOFOLLOW", 0)
_CHUNK = 1 << 20
_TRIES = 3


@dataclass(frozen=True, slots=True)
class Seen:
    """The file at a path at one moment: its identity and its bytes.

    If the file is larger than the limit, ``raw`` is its beginning. ``changed`` is the time of its
    last change of any kind (nanoseconds). It does not count when two objects are compared.
    """

    device: int
    inode: int
    raw: bytes
    changed: int = field(default=0, compare=False)

    def still_at(self, path: str) -> bool:
        """Return whether nothing has happened to the file since then. This reads no bytes."""
        try:
            now = os.lstat(path)
        except FileNotFoundError:
            return not self.inode
        return (now.st_dev, now.st_ino, now.st_ctime_ns) == (self.device, self.inode, self.changed)


NOTHING = Seen(0, 0, b"")
"""There was no file."""


def open_ordinary(path: str | os.PathLike[str], inside: str = "") -> int:
    """Open an ordinary file for reading. The caller must close the handle.

    With ``inside`` (a real path), ``path`` is a real path below that folder, and no link from there
    on is followed. So the opened file is below the folder, whatever is exchanged in the meantime.
    """
    if inside:
        handle = _open_inside(inside, os.fspath(path))
    else:
        # Opening may act already, so this comes first.
        _must_be_ordinary(os.stat(path), path)  # noqa: PTH116
        handle = os.open(path, _READ)
    try:
        found = os.fstat(handle)
        _must_be_ordinary(found, path)
        if stat.S_ISFIFO(found.st_mode):
            os.set_blocking(handle, True)
    except BaseException:
        os.close(handle)
        raise
    return handle


def read_ordinary(path: str | os.PathLike[str], most: int, inside: str = "") -> Seen:
    """Return the bytes of an ordinary file, at most one more than ``most`` (see ``open_ordinary``).

    If somebody writes the file meanwhile, it is read again, because the bytes may be mixed.
    """
    for _ in range(_TRIES):
        handle = open_ordinary(path, inside)
        try:
            before = os.fstat(handle)
            raw = _read(handle, most + 1)
            if _is_whole(before, os.fstat(handle), len(raw), most):
                return Seen(before.st_dev, before.st_ino, raw, before.st_ctime_ns)
        finally:
            os.close(handle)
    raise OSError(errno.EBUSY, "another program is writing it")


def seen_at(path: str | os.PathLike[str], most: int) -> Seen:
    """Return the file at a path, or ``NOTHING`` if there is none."""
    try:
        return read_ordinary(path, most)
    except FileNotFoundError:
        return NOTHING


def _open_inside(folder: str, path: str) -> int:
    if not PurePath(path).is_relative_to(folder) or path == folder:
        raise OSError(errno.EXDEV, "it does not lie in the folder it belongs to")
    *parts, name = PurePath(path).relative_to(folder).parts
    if os.open not in os.supports_dir_fd:
        return os.open(path, _READ | _NO_LINK)
    at = os.open(folder, _FOLDER)
    try:
        for part in parts:
            inner = os.open(part, _FOLDER | _NO_LINK, dir_fd=at)
            os.close(at)
            at = inner
        _must_be_ordinary(os.stat(name, dir_fd=at, follow_symlinks=False), path)
        return os.open(name, _READ | _NO_LINK, dir_fd=at)
    finally:
        os.close(at)


def _must_be_ordinary(found: os.stat_result, path: str | os.PathLike[str]) -> None:
    kind = stat.S_IFMT(found.st_mode)
    if kind == stat.S_IFDIR:
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if kind != stat.S_IFREG and not (kind == stat.S_IFIFO and _is_nameless(os.fspath(path))):
        raise OSError(errno.EINVAL, ODD)


def _is_nameless(path: str) -> bool:
    """Return whether a pipe is in no folder, and only among the open files of a process."""
    return path.startswith("/dev/fd/") or not os.path.exists(os.path.realpath(path))  # noqa: PTH110


def _read(handle: int, most: int) -> bytes:
    parts = []
    while most and (part := os.read(handle, min(most, _CHUNK))):
        parts.append(part)
        most -= len(part)
    return b"".join(parts)


def _is_whole(before: os.stat_result, after: os.stat_result, length: int, most: int) -> bool:
    """Return whether a file has not changed while its bytes were read.

    Some files of the system have size 0 although they have bytes.
    """
    if not stat.S_ISREG(before.st_mode):
        return True
    stayed = (before.st_size, before.st_mtime_ns) == (after.st_size, after.st_mtime_ns)
    return stayed and (after.st_size in (0, length) or length > most)
