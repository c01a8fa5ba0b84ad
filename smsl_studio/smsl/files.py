"""Bytes in, bytes out: reading a file, and a save that is whole or not at all."""

from __future__ import annotations

import os
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from smsl_studio.errors import Place, ReadError, SaveError
from smsl_studio.home import saving_folder
from smsl_studio.smsl.document import Document, decode
from smsl_studio.smsl.document.limits import LARGEST_FILE
from smsl_studio.smsl.forms import form_named, form_of
from smsl_studio.smsl.garbage import uncollected
from smsl_studio.smsl.inputs import NOTHING, Seen, read_ordinary

if TYPE_CHECKING:
    from smsl_studio.smsl.outputs import Inputs
    from smsl_studio.smsl.pending_saves import PendingFile


class Content(NamedTuple):
    """What a file holds: the ``raw`` bytes that count, and what was ``seen`` at its path.

    These are the same bytes, but where a save of several files has not come to its end: then the
    bytes that count are those of the file ``stands_in``.
    """

    raw: bytes
    seen: Seen
    stands_in: str = ""


def read_document(path: str | os.PathLike[str]) -> Document:
    """The document in a file; ReadError, with a place, where there is none.

    Where a save of several files has been left unfinished, all of them read as they were before
    it, or all as they are after it (see ``pending_saves``): ``stands_in`` tells of it.
    """
    return document_of(read_content(path), os.fspath(path))


def document_of(content: Content, file: str) -> Document:
    """The document in what a file holds; ReadError where there is none."""
    document = parse_bytes(content.raw, file)
    return replace(document, stands_in=content.stands_in) if content.stands_in else document


def read_content(path: str | os.PathLike[str], inside: str = "") -> Content:
    """What an ordinary file holds; ReadError where it cannot be read.

    ``inside``: ``path`` is a real path below that folder (see ``inputs``).
    """
    try:
        return content_of(path, inside)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
    raise ReadError(
        f"the file cannot be read: {reason}",
        Place(os.fspath(path), 1, 1),
        "Check the path and the right to read it.",
    )


def content_of(path: str | os.PathLike[str], inside: str = "") -> Content:
    """Like ``read_content``; OSError or ValueError where the file cannot be read.

    Of a file that is too large, a little more than the most: whoever reads on says so.
    """
    real = Path(path if inside else os.path.realpath(path))
    for _ in range(2):
        pending = _pending_at(real) if real.name else None
        seen = NOTHING
        with suppress(*((FileNotFoundError,) if pending else ())):
            seen = read_ordinary(path, LARGEST_FILE, inside)
        if pending is None or pending[0].untouched:
            break
        # The new bytes have taken their place in the meantime.
    if pending is None:
        return Content(seen.raw, seen)
    file, raw = pending
    return Content(raw, seen, str(file.part))


def _pending_at(real: Path) -> tuple[PendingFile, bytes] | None:
    """See ``pending_saves``; nearly always no save of this user waits for its end."""
    try:
        if not os.path.lexists(saving_folder()):
            return None
    except OSError:  # nobody knows in which folder this program runs
        return None
    from smsl_studio.smsl.pending_saves import pending_at

    return pending_at(real)


def parse_bytes(raw: bytes, file: str) -> Document:
    """The document in the bytes of a file; ``file`` is the name that messages show.

    Its form is told by the suffix of ``file``, else by how the text begins.
    """
    return parse_text(_text_of(raw, file), file)


def text_of(content: Content, file: str) -> str:
    """The text of what a file holds, whatever it says; ReadError where it is none."""
    return _text_of(content.raw, file)


def _text_of(raw: bytes, file: str) -> str:
    if len(raw) > LARGEST_FILE:
        raise ReadError(
            f"the file is larger than {LARGEST_FILE >> 20} MB",
            Place(file, 1, 1),
            "Split it into several files.",
        )
    return decode(raw, file)


def parse_text(text: str, file: str) -> Document:
    """The document in the text of a file; see ``parse_bytes``."""
    with uncollected():
        return form_named(form_of(file, text)).parse(text, file)


def save_document(
    document: Document | str | bytes,
    path: str | os.PathLike[str],
    over: Seen | None = None,
    made_of: Inputs = (),
) -> None:
    """Write the bytes of a document (or a plain text, or bytes) to ``path``, whole or not at all.

    The bytes go to a new file in the same folder, which takes the place of the old one only when
    its length is right and the disk has it. SaveError where that fails: the old file still
    stands. A symbolic link keeps pointing, and the file behind it keeps its mode.

    ``over`` is what was seen at ``path`` when it was read: where something else stands there by
    now, FileChanged. ``made_of`` are the files that an output was made of: UsageError where
    ``path`` leads to one of them.
    """
    # Most commands only read.
    from smsl_studio.smsl.disk import settle
    from smsl_studio.smsl.outputs import refuse_inputs, replace_file

    shown = os.fspath(path)
    try:
        # What is put under the name from here on is not followed any more.
        target = Path(os.path.realpath(path))
        if made_of:
            refuse_inputs(target, shown, made_of)
        replace_file(target, bytes_to_save(document), over, shown)
    except (OSError, ValueError) as error:
        raise SaveError(
            f"{shown} was not saved: {getattr(error, 'strerror', None) or error}",
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
