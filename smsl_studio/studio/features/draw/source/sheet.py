"""The exact text of one file as the lines that a text widget shows, kept in step with typing.

Each block of the widget stands for one exact piece: a line with its line end. A line that is too
long for a widget is cut into several pieces; the text stays the same. A keystroke changes only the
pieces of its lines. The whole text and the offsets of the pieces are computed when asked for.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Sequence
from itertools import accumulate

from smsl_studio.studio.features.draw.source.patches import common_prefix, common_suffix
from smsl_studio.studio.features.draw.source.shown_text import (
    BOM,
    CR_SHOWN,
    exact_column,
    is_plain,
    shown,
    shown_column,
)

LONG = 4000
"""Lines longer than this (in characters) are cut; a piece has at least half as many."""
_CUT = re.compile(r"[, \t}\])]")


class TextSheet:
    """The pieces of one text, one for each block of the widget. Columns are those shown."""

    def __init__(self, text: str = "") -> None:
        self.pieces: list[str] = cut(text)
        self.newline = "\r\n" if "\r\n" in text else "\n"
        self._text: str | None = text
        self._starts: list[int] | None = None
        self._lines: list[int] | None = None
        self._cuts = _has_cuts(self.pieces)

    @property
    def text(self) -> str:
        """The exact text."""
        if self._text is None:
            self._text = "".join(self.pieces)
        return self._text

    @property
    def shown(self) -> str:
        """The whole shown text."""
        return "\n".join(self.shown_lines(0, len(self.pieces) - 1))

    def shown_piece(self, at: int) -> str:
        """What is shown of one piece, without its line end."""
        return shown(self.pieces[at], at == 0).removesuffix("\n")

    def shown_lines(self, first: int, last: int) -> list[str]:
        """What is shown of some pieces, the last one included."""
        pieces = self.pieces[first : last + 1]
        if is_plain("".join(pieces)):
            return [piece.removesuffix("\n") for piece in pieces]
        return [self.shown_piece(at) for at in range(first, last + 1)]

    def where(self, offset: int) -> tuple[int, int]:
        """The piece and column at which an offset of the exact text is shown."""
        at = self._piece_at(offset)
        return at, shown_column(self.pieces[at], offset - self._start_of(at), at == 0)

    def offset(self, at: int, column: int) -> int:
        """The offset in the exact text of a column of a piece."""
        at = max(0, min(at, len(self.pieces) - 1))
        return self._start_of(at) + exact_column(self.pieces[at], column, at == 0)

    def line_of(self, at: int) -> int:
        """The line of the text, from 0, to which a piece belongs."""
        return self._line_numbers()[at] if self._cuts else at

    def piece_of(self, line: int) -> int:
        """The first piece of a line of the text, from 0."""
        if self._cuts:
            line = bisect_right(self._line_numbers(), line - 1)
        return max(0, min(line, len(self.pieces) - 1))

    def begins_line(self, at: int) -> bool:
        """Whether a piece begins a line; false for the later pieces of a line that was cut."""
        return at == 0 or not self._cuts or self.pieces[at - 1].endswith("\n")

    def typed(self, first: int, last: int, lines: Sequence[str], column: int) -> bool:
        """Take over that the pieces ``first`` to ``last`` are now shown as these lines.

        The change is at ``column`` of ``first`` or later. Unchanged parts keep their exact
        characters. Returns whether the exact text has changed.
        """
        old, new = "\n".join(self.shown_lines(first, last)), "\n".join(lines)
        if old == new:
            return False
        head = common_prefix(old, new, column)
        tail = common_suffix(old, new, min(len(old), len(new)) - head)
        (p, start), (q, end) = self._walk(first, head), self._walk(first, len(old) - tail)
        parts = new[head : len(new) - tail].split("\n")
        before, after = self.pieces[p][:start], self.pieces[q][end:]
        gone = "".join(self.pieces[p : q + 1])
        fresh = [part + self.newline for part in parts]
        fresh[-1] = parts[-1] + after
        fresh[0] = before + fresh[0]
        known = p - first
        for at, piece in enumerate(fresh):
            fresh[at] = _spelt(piece, lines[known + at], p + at == 0)
        self._replace(p, q, fresh)
        return gone != "".join(fresh)

    def put(self, start: int, end: int, part: str) -> tuple[int, list[str], list[str]]:
        """Replace the text between two offsets with ``part``.

        Returns the first piece that changed, the lines shown from there before, and the lines shown
        now.
        """
        first, last = self._piece_at(start), self._piece_at(end)
        before, base = self.pieces[first : last + 1], self._start_of(first)
        exact = "".join(before)
        old = self.shown_lines(first, last)
        fresh = cut(exact[: start - base] + part + exact[end - base :])
        if before[-1].endswith("\n") and not fresh[-1]:
            fresh.pop()
        self._replace(first, last, fresh)
        return first, old, self.shown_lines(first, first + len(fresh) - 1)

    def _walk(self, at: int, count: int) -> tuple[int, int]:
        """The piece, and the exact column in it, ``count`` shown characters after the start of a
        piece."""
        while count > len(line := self.shown_piece(at)):
            count -= len(line) + 1
            at += 1
        return at, exact_column(self.pieces[at], count, at == 0)

    def _replace(self, first: int, last: int, fresh: list[str]) -> None:
        whole = last == len(self.pieces) - 1
        self._cuts = self._cuts or _has_cuts(fresh if whole else [*fresh, ""])
        self.pieces[first : last + 1] = fresh
        self._text = self._starts = self._lines = None

    def _piece_at(self, offset: int) -> int:
        self._start_of(0)
        assert self._starts is not None
        return min(bisect_right(self._starts, offset) - 1, len(self.pieces) - 1)

    def _start_of(self, at: int) -> int:
        if self._starts is None:
            self._starts = [0, *accumulate(map(len, self.pieces))]
        return self._starts[at]

    def _line_numbers(self) -> list[int]:
        if self._lines is None:
            ends = (piece.endswith("\n") for piece in self.pieces[:-1])
            self._lines = [0, *accumulate(ends)]
        return self._lines


def cut(text: str) -> list[str]:
    """The pieces of a text: its lines; long lines are cut after a comma, bracket or white space."""
    lines = [line + "\n" for line in text.split("\n")]
    lines[-1] = lines[-1][:-1]
    if len(text) <= LONG or max(map(len, lines)) <= LONG:
        return lines
    pieces: list[str] = []
    for line in lines:
        pieces.extend(_cut_line(line))
    return pieces


def _cut_line(line: str) -> list[str]:
    pieces, at = [], 0
    while len(line) - at > LONG:
        match = _CUT.search(line, at + LONG // 2, at + LONG)
        end = match.end() if match else at + LONG
        end -= line[end - 1] == "\r"
        pieces.append(line[at:end])
        at = end
    return [*pieces, line[at:]]


def _has_cuts(pieces: Sequence[str]) -> bool:
    return any(not piece.endswith("\n") for piece in pieces[:-1])


def _spelt(piece: str, line: str, first: bool) -> str:
    """The exact piece that is shown as this line.

    A lone CR must not become part of a line end. A BOM typed at the beginning of the file stays
    visible, after a real BOM.
    """
    if first and line.startswith(BOM) and not piece.startswith(2 * BOM):
        piece = BOM + piece
    lone = line.endswith(CR_SHOWN) and piece.endswith("\r\n") and not piece.endswith("\r\r\n")
    return piece[:-1] + "\r\n" if lone else piece
