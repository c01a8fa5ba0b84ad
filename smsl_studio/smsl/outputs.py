"""Writes files: which may be replaced, and only if they have not changed meanwhile.

An output is an ordinary file. It must not be one of the files that it was made of, under any name.
If it is a link, the file behind it must be of the same kind.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

from smsl_studio.errors import FileChanged, UsageError
from smsl_studio.smsl.disk import short, write_new
from smsl_studio.smsl.document.limits import LARGEST_FILE
from smsl_studio.smsl.inputs import NOTHING, Seen, seen_at
from smsl_studio.smsl.traits import traits_of

_APPEND = os.O_WRONLY | os.O_APPEND | os.O_CREAT
_CAREFUL = ("O_NOFOLLOW", "O_NONBLOCK", "O_BINARY", "O_NOCTTY")
Inputs = Iterable[str | int]
"""Files that were read: their names, or numbers of open files, such as 0."""


def replace_file(target: Path, raw: bytes, over: Seen | None, shown: str) -> None:
    """Write these bytes to ``target`` (a real path), completely or not at all (OSError).

    ``over`` is the file that the writer has seen there. FileChanged, with the name ``shown``, if
    another file or other bytes are there right before the replacement. If it is ``NOTHING``, of
    several writers at the same moment only the first one writes. None replaces any file.
    """
    traits = traits_of(target)
    fresh = target.with_name(f".{short(target.name)}.{os.urandom(6).hex()}.part")
    try:
        write_new(fresh, raw, traits)
        if not (over == NOTHING and _put_first(fresh, target, shown)):
            put(fresh, target, over, shown)
    except BaseException:
        with suppress(OSError):
            fresh.unlink()
        raise


def put(fresh: Path, target: Path, over: Seen | None, shown: str) -> None:
    """Let a new file replace the file at ``target``.

    FileChanged if that is not ``over``. The bytes are compared first. At the last moment it is
    checked that nothing has happened to the file since they were read.
    """
    if over is None:
        fresh.replace(target)
        return
    now = seen_at(target, LARGEST_FILE)
    source, goal = os.fspath(fresh), os.fspath(target)
    if now == over and now.still_at(goal):
        os.replace(source, goal)  # noqa: PTH105 -- right after the check
    else:
        raise FileChanged(shown)


def _put_first(fresh: Path, target: Path, shown: str) -> bool:
    """Put a new file where none is, in one step. FileChanged if there is one.

    Return False if the file system cannot do this. Then no file was changed.
    """
    try:
        target.hardlink_to(fresh)
    except FileExistsError:
        raise FileChanged(shown) from None
    except OSError:  # a file cannot have two names here
        return False
    fresh.unlink()
    return True


def refuse_inputs(target: Path, shown: str, inputs: Inputs) -> None:
    """Raise UsageError if an output (its real path, and its name) is one of the files that it was
    made of, or if its name is a link to a file of another kind.
    """
    for one in inputs:
        with suppress(OSError, ValueError):
            if os.path.samestat(target.stat(), os.stat(one)):  # noqa: PTH116 -- takes numbers
                read = "the file on standard input" if isinstance(one, int) else one
                raise UsageError(
                    f"{shown} is the same file as {read}, and would take its place",
                    advice="Name another file.",
                )
    if target.suffix.lower() != Path(shown).suffix.lower():
        raise UsageError(
            f"{shown} leads to {target}, which is a file of another kind",
            advice="Name another file, or take that link away.",
        )


def open_new(path: Path) -> BinaryIO:
    """Open a file for appending that is new, or ordinary and empty.

    UsageError if anything else is there; no link is followed. OSError if it cannot be opened.
    """
    with suppress(FileNotFoundError):
        _must_be_empty(path.lstat(), path)
    flags = _APPEND
    for name in _CAREFUL:
        flags |= getattr(os, name, 0)
    handle = os.open(path, flags, 0o666)
    try:
        _must_be_empty(os.fstat(handle), path)
        return os.fdopen(handle, "ab", buffering=0)
    except BaseException:
        os.close(handle)
        raise


def _must_be_empty(found: os.stat_result, path: Path) -> None:
    if stat.S_ISLNK(found.st_mode):
        words = "is a link, and what is written has to stand under its own name"
    elif not stat.S_ISREG(found.st_mode):
        words = "is no ordinary file, and would not keep what is written"
    elif found.st_size:
        words = "holds something already, and a record is never written over"
    else:
        return
    raise UsageError(f"{path} {words}", advice="Name a new file, or take that one away first.")
