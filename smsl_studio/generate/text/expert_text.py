"""Expert texts as numbered lines, and citations of them.

A text comes from outside, so its size, its lines and its encoding are bounded before it is read.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import PurePath
from typing import Any

from smsl_studio.errors import Place, ReadError
from smsl_studio.generate.text.pdf_text import pages_of
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.smsl.inputs import read_ordinary

Json = Any
LARGEST_TEXT = 4 << 20
"""The largest size of a text file (bytes): a book of a thousand pages has half of it."""
LARGEST_PDF = 32 << 20
"""The largest size of a PDF (bytes)."""
MOST_LINES = 40_000
LONGEST_LINE = 10_000
LONGEST_QUOTE = 300
"""A citation quotes at most so many characters. A reader compares it with the page."""


@dataclass(frozen=True, slots=True)
class SourceLine:
    """One line of a text. ``number`` counts from 1, in a PDF on its ``page`` (0 elsewhere)."""

    file: str
    number: int
    text: str
    page: int = 0


@dataclass(frozen=True, slots=True)
class Citation:
    """Words that stand in a text: the file, the line (in a PDF on the page), the quoted words."""

    file: str
    line: int
    words: str
    page: int = 0

    def __str__(self) -> str:
        page = f"page {self.page}, " if self.page else ""
        return f"{self.file}, {page}line {self.line}: “{self.words}”"

    def as_json(self) -> dict[str, Json]:
        """Return the citation as a blueprint keeps it."""
        page = {"page": self.page} if self.page else {}
        return {"file": self.file, **page, "line": self.line, "words": self.words}


@dataclass(frozen=True)
class ExpertText:
    """A text that somebody who knows the procedure has written. ``file`` is its name without its
    folder."""

    file: str
    lines: tuple[SourceLine, ...]
    digest: str

    @cached_property
    def known(self) -> dict[tuple[int, int], str]:
        """The text of each line, by page and number."""
        return {(line.page, line.number): " ".join(line.text.split()) for line in self.lines}

    def has(self, citation: Citation) -> bool:
        """Return whether the quoted words stand in the line that the citation names."""
        line = self.known.get((citation.page, citation.line), "")
        return bool(citation.words) and " ".join(citation.words.split()) in line


def read_text(raw: bytes, file: str, called: str = "") -> ExpertText:
    """Return the text in the bytes of a file. ReadError if they are no text, or too many. Citations
    name it as it is ``called``, or else by the name of the file."""
    name, place = called or PurePath(file).name, Place(file, 1, 1)
    if name.lower().endswith(".pdf"):
        pages = pages_of(raw, file)
    else:
        pages = [(0, _decoded(raw, file).splitlines())]
    lines = []
    for page, texts in pages:
        for number, text in enumerate(texts, 1):
            if len(text) > LONGEST_LINE:
                raise ReadError(
                    f"the line has {len(text):,} characters, more than {LONGEST_LINE:,}",
                    Place(file, number, 1),
                    "Break it into lines, so that a citation can name one.",
                )
            lines.append(SourceLine(name, number, text.rstrip(), page))
    if len(lines) > MOST_LINES:
        advice = "Give the part that describes the procedure."
        raise ReadError(f"the text has more than {MOST_LINES:,} lines", place, advice)
    if not any(line.text.strip() for line in lines):
        raise ReadError("the text is empty", place, "Write the steps of the procedure into it.")
    return ExpertText(name, tuple(lines), sha256_hex(raw))


def text_at(path: str | os.PathLike[str], called: str = "") -> ExpertText:
    """Return the text in a file. ReadError if it cannot be read. ``called`` is as in
    ``read_text``."""
    file = os.fspath(path)
    most = LARGEST_PDF if file.lower().endswith(".pdf") else LARGEST_TEXT
    try:
        raw = read_ordinary(path, most).raw
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ReadError(
            f"the file cannot be read: {reason}",
            Place(file, 1, 1),
            "Check the path and the right to read it.",
        ) from None
    if len(raw) > most:
        raise ReadError(
            f"the text is larger than {most >> 20} MB",
            Place(file, 1, 1),
            "Give the part that describes the procedure.",
        )
    return read_text(raw, file, called)


def cited(texts: Iterable[ExpertText], citation: Citation) -> bool:
    """Return whether a citation names one of these texts, and words that stand there."""
    return any(text.file == citation.file and text.has(citation) for text in texts)


def digest_of_texts(texts: Sequence[ExpertText]) -> str:
    """Return one SHA-256 for several texts in their order."""
    return sha256_hex("\n".join(text.digest for text in texts).encode())


def _decoded(raw: bytes, file: str) -> str:
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        column = error.start - (raw.rfind(b"\n", 0, error.start) + 1) + 1
        raise ReadError(
            "the text is not UTF-8", Place(file, line, column), "Save it as UTF-8."
        ) from None
    if "\0" in text:
        line = text.count("\n", 0, text.index("\0")) + 1
        raise ReadError(
            "this is no text: it holds a zero byte",
            Place(file, line, 1),
            "Give a text (.txt, .md) or a PDF.",
        )
    return text
