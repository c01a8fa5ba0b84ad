"""The regions that can be folded: a line, the deeper lines below it and the closing bracket."""

from __future__ import annotations

import re
from collections.abc import Sequence

from smsl_studio.studio.features.draw.source.around import tokens

_LEAD = re.compile(r"[ \t]*")
_NAME = re.compile(r"\s*#\s*NAME\s*:\s*(\S+)")
LEAST = 2
"""The fewest lines that a fold hides, because its row takes one itself."""


def depth_of(line: str) -> int | None:
    """The indentation of a line in characters; None for a blank line."""
    match = _LEAD.match(line)
    end = match.end() if match else 0
    return end if line[end:].strip() else None


def opens(lines: Sequence[str], at: int) -> bool:
    """Whether the next line is deeper."""
    depth = depth_of(lines[at])
    if depth is None or lines[at].lstrip()[:1] in "}])":
        return False
    following = depth_of(lines[at + 1]) if at + 1 < len(lines) else None
    return following is not None and following > depth


def extent(lines: Sequence[str], at: int) -> int:
    """The last line of the region that a line begins; the line itself if it begins none."""
    last = at
    if opens(lines, at):
        depth = depth_of(lines[at]) or 0
        for one in range(at + 1, len(lines)):
            inner = depth_of(lines[one])
            if inner is not None and inner <= depth:
                closes = inner == depth and lines[one].lstrip()[:1] in "}])"
                return one if closes else last
            last = one if inner is not None else last
    return last


def region(lines: Sequence[str], at: int) -> tuple[int, int] | None:
    """The first and last line that folding a line hides; None if there is nothing to fold."""
    last = extent(lines, at)
    return (at + 1, last) if last - at >= LEAST else None


def enclosing(lines: Sequence[str], at: int) -> int | None:
    """The nearest line, at or above this one, whose region holds this line."""
    depth = depth_of(lines[at])
    for one in range(at, -1, -1):
        inner = depth_of(lines[one])
        if inner is None or (depth is not None and inner > depth):
            continue
        depth = inner if depth is None else min(depth, inner)
        found = region(lines, one)
        if found and at <= found[1]:
            return one
    return None


def outermost(lines: Sequence[str], form: str) -> list[int]:
    """The lines that begin an SB."""
    written = (at for at in range(len(lines)) if depth_of(lines[at]) is not None)
    at = next(written, 0)
    if form == "json":
        at = next(written, at)
    depth, found = depth_of(lines[at]), []
    while at < len(lines):
        hidden = region(lines, at) if depth_of(lines[at]) == depth else None
        if hidden:
            found.append(at)
        at = hidden[1] + 1 if hidden else at + 1
    return found


def names_in(lines: Sequence[str], first: int, last: int, form: str) -> tuple[str, str]:
    """The names of the first and last of the outermost elements that begin in some lines."""
    names: list[str] = []
    least: int | None = None
    for at in range(first, last + 1):
        depth = depth_of(lines[at])
        if depth is None or (least is not None and depth > least):
            continue
        name = _name(lines, at, form)
        if name and (least is None or depth < least):
            names, least = [], depth
        names += [name] if name else []
    return (names[0], names[-1]) if names else ("", "")


def _name(lines: Sequence[str], at: int, form: str) -> str:
    if form == "smsl" and lines[at].strip().strip(",") == "{":
        inner = (_NAME.match(lines[one]) for one in range(at + 1, min(at + 5, len(lines))))
        return next((match[1] for match in inner if match), "")
    found = [one for one in tokens(lines[at], form) if one.text != "-"]
    return found[0].name if len(found) > 1 and found[1].text == ":" else ""
