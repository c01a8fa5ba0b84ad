"""Reads files, and saves them completely or not at all."""

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
    """The content of a file: the ``raw`` bytes that count, and the bytes ``seen`` at its path.

    They differ only if a save of several files is not finished. Then the bytes that count are those
    of the file ``stands_in``.
    """

    raw: bytes
    seen: Seen
    stands_in: str = ""


def read_document(path: str | os.PathLike[str]) -> Document:
    """Return the document in a file. ReadError, with a place, if there is none.

    If a save of several files is not finished, all of them are read as before it, or all as after
    it (see ``pending_saves``). ``stands_in`` names the file with the new text.
    """
    return document_of(read_content(path), os.fspath(path))


def document_of(content: Content, file: str) -> Document:
    """Return the document in the content of a file. ReadError if there is none."""
    document = parse_bytes(content.raw, file)
    return replace(document, stands_in=content.stands_in) if content.stands_in else document


def read_content(path: str | os.PathLike[str], inside: str = "") -> Content:
    """Return the content of an ordinary file. ReadError if it cannot be read.

    With ``inside``, ``path`` is a real path below that folder (see ``inputs``).
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
    """Return the same as ``read_content``. OSError or ValueError if the file cannot be read.

    Of a file that is too large, slightly more bytes than the limit are read, so that readers notice
    it.
    """
    real = Path(path if inside else os.path.realpath(path))
    for _ in range(2):
        pending = _pending_at(real) if real.name else None
        seen = NOTHING
        with suppress(*((FileNotFoundError,) if pending else ())):
            seen = read_ordinary(path, LARGEST_FILE, inside)
        if pending is None or pending[0].untouched:
            break
        # The new bytes have replaced the file in the meantime.
    if pending is None:
        return Content(seen.raw, seen)
    file, raw = pending
    return Content(raw, seen, str(file.part))


def _pending_at(real: Path) -> tuple[PendingFile, bytes] | None:
    """Return the new bytes for a path (see ``pending_saves``). Nearly always no save is
    unfinished.
    """
    try:
        if not os.path.lexists(saving_folder()):
            return None
    except OSError:  # the current folder is not known
        return None
    from smsl_studio.smsl.pending_saves import pending_at

    return pending_at(real)


def parse_bytes(raw: bytes, file: str) -> Document:
    """Return the document in the bytes of a file. ``file`` is the name in messages.

    The form is known from the suffix of ``file``, or else from the beginning of the text. ReadError
    if the bytes are not in this form.
    """
    return parse_text(_text_of(raw, file), file)


def text_of(content: Content, file: str) -> str:
    """Return the text of a file. ReadError if it is too large or not UTF-8."""
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
    """Return the document in the text of a file (see ``parse_bytes``)."""
    with uncollected():
        try:
            return form_named(form_of(file, text)).parse(text, file)
        except ReadError as error:
            from smsl_studio.smsl.document.conflict_markers import told_of_markers

            told = told_of_markers(error, text, file)
            if told is error:
                raise
            raise told from None


def save_document(
    document: Document | str | bytes,
    path: str | os.PathLike[str],
    over: Seen | None = None,
    made_of: Inputs = (),
) -> None:
    """Write a document (or a text, or bytes) to ``path``, completely or not at all.

    The bytes go to a new file in the same folder. It replaces the old one only after its length was
    checked and the disk has it. SaveError if that fails; then the old file is unchanged. A symbolic
    link stays, and the file behind it keeps its mode.

    ``over`` is what was seen at ``path`` when it was read. FileChanged if there is something else
    now. ``made_of`` are the files that an output was made of. UsageError if ``path`` leads to one
    of them.
    """
    # Most commands only read, so these are loaded here.
    from smsl_studio.smsl.disk import settle
    from smsl_studio.smsl.outputs import refuse_inputs, replace_file

    shown = os.fspath(path)
    try:
        # A link that is put at this name from now on is not followed.
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
    """Return the bytes of a document or a text. ValueError if it has half a surrogate pair."""
    if isinstance(document, bytes):
        return document
    try:
        return document.encode() if isinstance(document, str) else document.encoded()
    except UnicodeEncodeError as error:
        odd = f"U+{ord(error.object[error.start]):04X}"
        raise ValueError(f"the text holds half a character ({odd})") from None
