"""The lines of one element in several versions, side by side."""

from __future__ import annotations

import json
from collections.abc import Sequence
from difflib import SequenceMatcher
from typing import Any, NamedTuple

from smsl_studio.blueprint.merge.conflict import ABSENT, Path
from smsl_studio.blueprint.merge.trees import value_at
from smsl_studio.blueprint.model import Blueprint

Json = Any
MOST = 400
"""The largest number of lines of a version that are compared."""


class ColumnLine(NamedTuple):
    """One line of a version: its number in the file (0 if it is not known) and its text."""

    number: int
    text: str


Row = tuple[ColumnLine | None, ...]
"""One line of each version. None is a line that this version does not have."""


def lines_of(version: Blueprint, path: Path, is_exact: bool) -> tuple[ColumnLine, ...]:
    """Return the lines in which the map around a value is written, an empty tuple if it is missing.

    With ``is_exact`` they are those of the file; otherwise the file is not that of this version,
    and the lines are written anew, without numbers.
    """
    document = version.document
    way = path[:-1] if len(path) > 2 else path
    if value_at(document.values, way) is ABSENT:
        return ()
    if not is_exact:
        text = json.dumps(value_at(document.values, way), indent=4, ensure_ascii=False)
        lines = f"{way[-1]}: {text}".splitlines() if way else text.splitlines()
        return tuple(ColumnLine(0, line) for line in lines[:MOST])
    try:
        member = document.member(way)
    except KeyError:
        return ()
    start = document.place_at(min(member.key_start, member.value_start)).line
    end = document.place_at(max(member.value_end - 1, 0)).line
    written = document.text.splitlines()[start - 1 : end]
    return tuple(ColumnLine(start + at, line) for at, line in enumerate(written[:MOST]))


def aligned_lines(columns: Sequence[Sequence[ColumnLine]]) -> tuple[Row, ...]:
    """Return the lines of all versions in rows; equal lines stand beside each other."""
    if not columns:
        return ()
    rows: list[list[ColumnLine | None]] = [[one] for one in columns[0]]
    for width, column in enumerate(columns[1:], start=1):
        rows = _joined(rows, column, width)
    return tuple(tuple(row) for row in rows)


def _joined(
    rows: list[list[ColumnLine | None]], column: Sequence[ColumnLine], width: int
) -> list[list[ColumnLine | None]]:
    left = [_key(next(one.text for one in row if one is not None)) for row in rows]
    right = [_key(one.text) for one in column]
    found: list[list[ColumnLine | None]] = []
    for what, a, b, c, d in SequenceMatcher(None, left, right, autojunk=False).get_opcodes():
        ours, theirs = rows[a:b], list(column[c:d])
        if what == "equal":
            found += [[*row, line] for row, line in zip(ours, theirs, strict=True)]
        else:
            found += [[*row, None] for row in ours]
            found += [[*([None] * width), line] for line in theirs]
    return found


def _key(text: str) -> str:
    """The part of a line that names it, so that another value stands beside it."""
    key = text.strip().strip(",")
    for mark in ("->", ":"):
        if mark in key:
            return key.partition(mark)[0].strip().strip('"')
    return key
