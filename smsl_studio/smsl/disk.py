"""Disk operations of a save: write new files completely, make names durable, and lock folders."""

from __future__ import annotations

import os
import time
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from smsl_studio.smsl.traits import Traits, give

try:
    import fcntl
except ImportError:  # without it no folder can be locked, and saving works all the same
    fcntl = None  # type: ignore[assignment]

_CHUNK = 1 << 20
_LONGEST = 120
"""The largest number of bytes of a name that is part of the name of a file beside it."""

_NAP = 0.02


def short(name: str) -> str:
    """Return a file's name, or a shorter one if it is too long to be extended."""
    raw = os.fsencode(name)
    if len(raw) <= _LONGEST:
        return name
    import hashlib  # rarely needed, and slow to load

    return f"{name[:20]}~{hashlib.sha256(raw).hexdigest()[:20]}"


def write_new(path: Path, raw: bytes, mode: int | Traits | None = None) -> None:
    """Write all bytes to a new file and wait until the disk has them.

    A write may be short without an error (a full disk, a quota). Then the rest is written again,
    and a wrong length at the end is an OSError. If the file gets a ``mode``, or the traits of
    another file, nobody else can read it before.
    """
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    handle = os.open(path, flags, 0o666 if mode is None else 0o600)
    try:
        left = memoryview(raw)
        while left:
            written = os.write(handle, left[:_CHUNK])
            if written <= 0:
                raise OSError(28, "the disk took nothing more")
            left = left[written:]
        if isinstance(mode, Traits):
            give(handle, mode)
        elif mode is not None:
            os.chmod(path, mode)  # noqa: PTH101
        os.fsync(handle)
        if os.fstat(handle).st_size != len(raw):
            raise OSError(28, "the disk holds less than was written")
    finally:
        os.close(handle)


def settle(folders: Iterable[Path]) -> None:
    """Make the disk keep the new names. Some systems cannot do this for a folder. They keep the
    names later, and each file then has its old or its new bytes, complete.
    """
    for folder in folders:
        with suppress(OSError):
            handle = os.open(folder, os.O_RDONLY)
            try:
                os.fsync(handle)
            finally:
                os.close(handle)


@contextmanager
def held(folders: Iterable[Path], patience: float = 0.0) -> Iterator[bool]:
    """Lock folders for one save. The value is False if another process has locked one of them.

    ``patience`` is the longest time to wait for it (wall seconds). The lock ends with the process
    in any case, and leaves nothing behind.
    """
    wanted = list(dict.fromkeys(folders))
    last = time.monotonic() + patience
    with ExitStack() as stack:
        while not all(_hold(folder, stack) for folder in wanted):
            stack.close()
            if time.monotonic() >= last:
                yield False
                return
            time.sleep(_NAP)
        yield True


def _hold(folder: Path, stack: ExitStack) -> bool:
    if fcntl is None:
        return True
    try:
        handle = os.open(folder, os.O_RDONLY)
    except PermissionError:  # a folder that can be written but not read
        return True
    stack.callback(os.close, handle)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:  # a file system without locks
        return True
    return True
