"""The brackets and words of a PDDL file, each with its place.

PDDL knows no capitals: every word is in small letters here. The file may come from anywhere, so its
size and its depth are limited, and it is read without recursion.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from smsl_studio.errors import Place, ReadError
from smsl_studio.stop import heed

LARGEST = 1 << 20
"""The largest size of a PDDL file (bytes)."""
DEEPEST = 100
"""The largest depth of brackets."""
_TOKEN = re.compile(r"[ \t\r\n\f]+|;[^\n]*|(?P<sign>[()])|(?P<word>[^\s();]+)")
_WORD = re.compile(r"[:?]?[a-z0-9_@.+*/<>=-]+")
_SHOWN = 40


@dataclass(slots=True)
class Expression:
    """A word, or brackets with expressions in them (then ``word`` is empty)."""

    word: str
    place: Place
    parts: list[Expression] = field(default_factory=list)

    @property
    def head(self) -> str:
        """The first word in brackets. Empty if it is none."""
        return self.parts[0].word if self.parts else ""

    @property
    def rest(self) -> list[Expression]:
        """What stands behind the first part."""
        return self.parts[1:]

    @property
    def shown(self) -> str:
        """The word or the begin of the brackets, as a message shows it."""
        text = self.word or f"({self.head} ...)"
        return repr(text if len(text) <= _SHOWN else f"{text[:_SHOWN]}...")

    def fault(self, sentence: str, advice: str = "") -> ReadError:
        """Return an error at this place."""
        return ReadError(sentence, self.place, advice)


def read_expression(raw: bytes, file: str) -> Expression:
    """Return the one expression of a file. ReadError, with its place, for anything else."""
    start = Place(file, 1, 1)
    if len(raw) > LARGEST:
        raise ReadError("the file is longer than 1 MB", start, "Take a smaller problem.")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        raise ReadError("this is no UTF-8 text", Place(file, line, 1)) from None
    found: Expression | None = None
    open_ones: list[Expression] = []
    for word, place in _words(text, file):
        heed()
        if found is not None:
            raise ReadError(
                "more stands behind the last bracket", place, "A file is one (define ...)."
            )
        if word == ")":
            if not open_ones:
                raise ReadError("a bracket is closed that was not opened", place)
            done = open_ones.pop()
            if not open_ones:
                found = done
            continue
        one = Expression("" if word == "(" else word, place)
        if open_ones:
            open_ones[-1].parts.append(one)
        elif word != "(":
            raise ReadError(
                "the file does not begin with '('", place, "A file is one (define ...)."
            )
        if word == "(":
            open_ones.append(one)
            if len(open_ones) > DEEPEST:
                raise ReadError(f"brackets stand in each other more than {DEEPEST} deep", place)
    if found is None:
        place = open_ones[-1].place if open_ones else start
        raise ReadError("a bracket is not closed" if open_ones else "the file is empty", place)
    return found


def _words(text: str, file: str) -> Iterator[tuple[str, Place]]:
    line, begin, at = 1, 0, 0
    while at < len(text):
        match = _TOKEN.match(text, at)
        place = Place(file, line, at - begin + 1)
        if match is None:
            raise ReadError(f"{text[at]!r} can be no part of PDDL", place)
        word = match["sign"] or (match["word"] or "").lower()
        if match["word"] and not _WORD.fullmatch(word):
            shown = repr(word if len(word) <= _SHOWN else f"{word[:_SHOWN]}...")
            raise ReadError(
                f"{shown} is no word of PDDL", place, "Names have letters, digits, - and _."
            )
        if word:
            yield word, place
        lines = match[0].count("\n")
        if lines:
            line += lines
            begin = match.start() + match[0].rfind("\n") + 1
        at = match.end()
