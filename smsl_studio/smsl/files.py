"""Bytes in, bytes out: reading a file, and a save that is whole or not at all."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from smsl_studio.errors import Place, ReadError, SaveError
from smsl_studio.smsl.disk import mode_of, settle, short, write_new
from smsl_studio.smsl.document import Document, decode
from smsl_studio.smsl.forms import form_named, form_of
from smsl_studio.smsl.pending import standing

LARGEST = 1 << 26
"""So many bytes of a file are read at most: ten times the largest that anybody has drawn."""


def read_document(path: str | os.PathLike[str]) -> Document:
    """The document in a file; ReadError, with a place, where there is none.

    Where a save of several files has been left unfinished, all of them read as they were before
    it, or all as they are after it (see ``pending``).
    """
    return parse_bytes(read_bytes(path), os.fspath(path))


def read_bytes(path: str | os.PathLike[str]) -> bytes:
    """The bytes of a file, as ``read_document`` reads them; ReadError where there are none."""
    file = os.fspath(path)
    try:
        return _bytes_of(Path(path))
    except OSError as error:
        reason = error.strerror or str(error)
    except ValueError as error:
        reason = str(error)
    raise ReadError(
        f"the file cannot be read: {reason}",
        Place(file, 1, 1),
        "Check the path and the right to read it.",
    )


def _bytes_of(path: Path) -> bytes:
    """A little more than the most that is read: what goes on for ever is not followed."""
    real = Path(os.path.realpath(path))
    counts = standing(real)
    if counts is not real:
        with suppress(FileNotFoundError), counts.open("rb") as stream:
            return stream.read(LARGEST + 1)
        # It has taken its place in the meantime.
    with path.open("rb") as stream:
        return stream.read(LARGEST + 1)


def parse_bytes(raw: bytes, file: str) -> Document:
    """The document in the bytes of a file; ``file`` is the name that messages show.

    Its form is told by the suffix of ``file``, else by how the text begins.
    """
    return parse_text(_text_of(raw, file), file)


def read_text(path: str | os.PathLike[str]) -> str:
    """The text of a file, whatever it says; ReadError where it cannot be read or is none."""
    return _text_of(read_bytes(path), os.fspath(path))


def _text_of(raw: bytes, file: str) -> str:
    if len(raw) > LARGEST:
        raise ReadError(
            f"the file is larger than {LARGEST >> 20} MB",
            Place(file, 1, 1),
            "Split it into several files.",
        )
    return decode(raw, file)


def parse_text(text: str, file: str) -> Document:
    """The document in the text of a file; see ``parse_bytes``."""
    return form_named(form_of(file, text)).parse(text, file)


def save_document(document: Document | str | bytes, path: str | os.PathLike[str]) -> None:
    """Write the bytes of a document (or a plain text, or bytes) to ``path``, whole or not at all.

    The bytes go to a new file in the same folder, which takes the place of the old one only when
    its length is right and the disk has it. SaveError where that fails: the old file still
    stands. A symbolic link keeps pointing, and the file behind it keeps its mode.
    """
    try:
        target = Path(os.path.realpath(path))
        raw = bytes_to_save(document)
        mode = mode_of(target)
        fresh = target.with_name(f".{short(target.name)}.{os.urandom(6).hex()}.part")
        try:
            write_new(fresh, raw, mode)
            fresh.replace(target)
        except BaseException:
            with suppress(OSError):
                fresh.unlink()
            raise
    except (OSError, ValueError) as error:
        raise SaveError(
            f"{os.fspath(path)} was not saved: {getattr(error, 'strerror', None) or error}",
            advice="What stood there before still stands. Free some room, or save elsewhere.",
        ) from error
    settle([target.parent])


def bytes_to_save(document: Document | str | bytes) -> bytes:
    """The bytes of a document or of a plain text; ValueError where it has none."""
    if isinstance(document, bytes):
        return document
    try:
        return document.encode() if isinstance(document, str) else document.encoded()
    except UnicodeEncodeError as error:
        odd = f"U+{ord(error.object[error.start]):04X}"
        raise ValueError(f"the text holds half a character ({odd})") from None
