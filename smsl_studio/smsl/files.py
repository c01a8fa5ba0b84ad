"""Bytes in, bytes out: reading a file, and a save that is whole or not at all."""

from __future__ import annotations

import os
import stat
from contextlib import suppress
from pathlib import Path

from smsl_studio.errors import Place, ReadError, SaveError
from smsl_studio.smsl.document import Document, decode
from smsl_studio.smsl.forms import form_named, form_of

_CHUNK = 1 << 20


def read_document(path: str | os.PathLike[str]) -> Document:
    """The document in a file; ReadError, with a place, where there is none."""
    return parse_text(read_text(path), os.fspath(path))


def read_text(path: str | os.PathLike[str]) -> str:
    """The text of a file, whatever it says; ReadError where it cannot be read or is none."""
    return decode(read_bytes(path), os.fspath(path))


def read_bytes(path: str | os.PathLike[str]) -> bytes:
    """The bytes of a file; ReadError where they cannot be read."""
    try:
        return Path(path).read_bytes()
    except OSError as error:
        reason = error.strerror or str(error)
    except ValueError as error:
        reason = str(error)
    raise ReadError(
        f"the file cannot be read: {reason}",
        Place(os.fspath(path), 1, 1),
        "Check the path and the right to read it.",
    )


def parse_bytes(raw: bytes, file: str) -> Document:
    """The document in the bytes of a file; ``file`` is the name that messages show.

    Its form is told by the suffix of ``file``, else by how the text begins.
    """
    return parse_text(decode(raw, file), file)


def parse_text(text: str, file: str) -> Document:
    """The document in the text of a file; see ``parse_bytes``."""
    return form_named(form_of(file, text)).parse(text, file)


def save_document(document: Document, path: str | os.PathLike[str]) -> None:
    """Write a document's bytes to ``path``, whole or not at all.

    The bytes go to a new file in the same folder, which takes the place of the old one only when
    its length is right and the disk has it. SaveError where that fails: the old file still
    stands. A symbolic link keeps pointing, and the file behind it keeps its mode.
    """
    target = Path(os.path.realpath(path))
    raw = document.encoded()
    try:
        mode = _mode_of(target)
        fresh = target.with_name(f".{target.name[:64]}.{os.urandom(6).hex()}.part")
        try:
            _write(fresh, raw, mode)
            fresh.replace(target)
        except BaseException:
            with suppress(OSError):
                fresh.unlink()
            raise
    except OSError as error:
        raise SaveError(
            f"{os.fspath(path)} was not saved: {error.strerror or error}",
            advice="What stood there before still stands. Free some room, or save elsewhere.",
        ) from error
    _settle_folder(target.parent)


def _mode_of(target: Path) -> int | None:
    """The permissions of the file that stands at ``target``, None where there is none.

    OSError where it may not be written, because a replaced file would not ask.
    """
    try:
        found = target.stat()
    except FileNotFoundError:
        return None
    if not stat.S_ISREG(found.st_mode):
        raise OSError(0, "it is no ordinary file")
    if not os.access(target, os.W_OK):
        raise PermissionError(13, "it may only be read")
    return stat.S_IMODE(found.st_mode)


def _write(path: Path, raw: bytes, mode: int | None) -> None:
    """Write all bytes to a new file and wait until the disk has them.

    A write may be short without an error (a full disk, a quota): what is missing is written
    again, and a file of another length than its bytes is a failure.
    """
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    handle = os.open(path, flags, 0o666)
    try:
        left = memoryview(raw)
        while left:
            written = os.write(handle, left[:_CHUNK])
            if written <= 0:
                raise OSError(28, "the disk took nothing more")
            left = left[written:]
        if mode is not None:
            os.chmod(path, mode)  # noqa: PTH101
        os.fsync(handle)
        if os.fstat(handle).st_size != len(raw):
            raise OSError(28, "the disk holds less than was written")
    finally:
        os.close(handle)


def _settle_folder(folder: Path) -> None:
    """Have the disk keep the new name. A system that cannot do this for a folder keeps it anyway
    in its own time, and the file is whole under its old or its new bytes.
    """
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
