"""What a save needs of the disk: new files written whole, lasting names, locked folders."""

from __future__ import annotations

import os
import time
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from smsl_studio.smsl.traits import Traits, give

try:
    import fcntl
except ImportError:  # a system without it holds nothing, and saves all the same
    fcntl = None  # type: ignore[assignment]

_CHUNK = 1 << 20
_LONGEST = 120
"""So many bytes of a name fit into that of a file beside it."""

_NAP = 0.02


def short(name: str) -> str:
    """A file's name, or a shorter one of its own where nothing could be added to it."""
    raw = os.fsencode(name)
    if len(raw) <= _LONGEST:
        return name
    import hashlib  # seldom needed, and slow to load

    return f"{name[:20]}~{hashlib.sha256(raw).hexdigest()[:20]}"


def write_new(path: Path, raw: bytes, mode: int | Traits | None = None) -> None:
    """Write all bytes to a new file and wait until the disk has them.

    A write may be short without an error (a full disk, a quota): what is missing is written
    again, and a file of another length than its bytes is a failure. A file that is to have a
    ``mode``, or all traits of another, can be read by nobody else until it has them.
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
    """Have the disk keep the new names. A system that cannot do this for a folder keeps them
    anyway in its own time, and each file is whole under its old or its new bytes.
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
    """Lock folders for one save; False where another process has locked one of them.

    ``patience`` is how long (wall seconds) to wait for it. The hold ends with the process, however
    it ends, and leaves nothing behind.
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
    except PermissionError:  # a folder that may be written in, but not read
        return True
    stack.callback(os.close, handle)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:  # a file system that holds nothing
        return True
    return True
