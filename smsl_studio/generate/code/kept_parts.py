"""Parts of generated files that people write, between marks. They stay when code is made again.

::

    # <yours: REGISTRATION/Register>
    ...
    # </yours>
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from smsl_studio.errors import Place, UsageError

LONGEST_KEY = 120
_BEGIN = re.compile(r"\s*(?:#|//) <yours: (.*)>\s*")
_END = re.compile(r"\s*(?:#|//) </yours>\s*")


def mark_key(text: str) -> str:
    """Return the key of a mark: one line of ASCII. A very long one is cut, with its digest."""
    shown = text.encode("unicode_escape").decode("ascii")
    if len(shown) <= LONGEST_KEY:
        return shown
    return f"{shown[:LONGEST_KEY]}~{hashlib.sha256(shown.encode()).hexdigest()[:12]}"


@dataclass(frozen=True)
class KeptPart:
    """A part between marks: its key, its lines, and the line (from 1) of its first mark."""

    key: str
    lines: tuple[str, ...]
    line: int


def parts_of(text: str, file: str) -> dict[str, KeptPart]:
    """Return the parts of a file by their keys. UsageError for marks without a match, or twice."""
    found: dict[str, KeptPart] = {}
    begun: tuple[str, int] | None = None
    lines = text.splitlines()
    for number, line in enumerate(lines, 1):
        if begun is None:
            opening = _BEGIN.fullmatch(line)
            begun = (opening[1], number) if opening else None
            if opening is None and _END.fullmatch(line):
                raise _wrong(file, number, "a part ends here that has not begun")
        elif _BEGIN.fullmatch(line):
            raise _wrong(file, number, f"the part {begun[0]} of line {begun[1]} has no end")
        elif _END.fullmatch(line):
            key, first = begun
            if key in found:
                raise _wrong(file, first, f"the part {key} stands twice")
            found[key] = KeptPart(key, tuple(lines[first : number - 1]), first)
            begun = None
    if begun is not None:
        raise _wrong(file, begun[1], f"the part {begun[0]} has no end")
    return found


def with_parts(text: str, kept: Mapping[str, KeptPart]) -> str:
    """Return a new text with the lines that people have written in place of the usual ones."""
    return "\n".join(_woven(text.split("\n"), kept))


def _woven(lines: list[str], kept: Mapping[str, KeptPart]) -> Iterator[str]:
    skips = False
    for line in lines:
        skips = skips and not _END.fullmatch(line)
        if skips:
            continue
        yield line
        opening = _BEGIN.fullmatch(line)
        if opening and opening[1] in kept:
            yield from kept[opening[1]].lines
            skips = True


def refuse_lost(old: Mapping[str, KeptPart], new: Mapping[str, KeptPart], file: str) -> None:
    """Raise UsageError for a part that somebody has written and that has no place any more."""
    usual = {part.lines for part in new.values()}
    for part in old.values():
        if part.key not in new and part.lines and part.lines not in usual:
            raise UsageError(
                f"{Place(file, part.line, 1)}: the blueprint has no {part.key} any more, and this "
                "part of yours would be lost",
                advice="Move it to the function that takes its place, or delete it.",
            )


def _wrong(file: str, line: int, sentence: str) -> UsageError:
    return UsageError(
        f"{Place(file, line, 1)}: {sentence}",
        advice="Every <yours: KEY> has one </yours>, and every key stands once.",
    )
