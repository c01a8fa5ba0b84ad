"""The conflict markers of a merge by lines, as git writes them, and the versions between them."""

from __future__ import annotations

import re
from dataclasses import dataclass

from smsl_studio.errors import Place, ReadError

OURS, BASE, MIDDLE, THEIRS = "<", "|", "=", ">"
_MARKER = re.compile(r"^(?:<{7}|\|{7}|>{7})(?: .*)?$|^={7}$")
_BEGIN = re.compile(r"^<{7}(?: .*)?\r?$", re.MULTILINE)
ADVICE = (
    "Open it in the window and choose on the page Merge, or write one version in place of each "
    "piece from <<<<<<< to >>>>>>>."
)
REPAIR = "Take out the markers that do not belong together, or get the file from git again."


@dataclass(frozen=True)
class MarkedText:
    """The versions of a text with conflict markers.

    ``base`` is None if the markers do not tell it: only those of the style diff3 do. ``lines`` are
    the lines of the first marker of each conflict, from 1.
    """

    ours: str
    theirs: str
    base: str | None
    lines: tuple[int, ...]


def is_marked(text: str) -> bool:
    """Return whether a line of the text is a marker that begins a conflict."""
    return "<<<<<<<" in text and _BEGIN.search(text) is not None


def unmarked(text: str, file: str) -> MarkedText:
    """Return the versions of a text with conflict markers.

    ReadError, with its line, if there is no marker, or if one is missing, stands inside another
    conflict or at a wrong place.
    """
    ours: list[str] = []
    theirs: list[str] = []
    base: list[str] = []
    begins: list[int] = []
    part, has_base, lacks_base = "", False, False
    for number, line in enumerate(_lines(text), start=1):
        bare = line.rstrip("\r\n")
        sign = bare[0] if _MARKER.match(bare) else ""
        if sign and (sign != MIDDLE or part):
            part = _next(part, sign, Place(file, number, 1))
            if sign == OURS:
                begins.append(number)
            elif sign == BASE:
                has_base = True
            elif sign == MIDDLE:
                lacks_base = lacks_base or not has_base
            else:
                has_base = False
            continue
        if part in ("", OURS):
            ours.append(line)
        if part in ("", THEIRS):
            theirs.append(line)
        if part in ("", BASE):
            base.append(line)
    if part:
        raise ReadError(
            f"the conflict that begins in line {begins[-1]} has no end, a line >>>>>>>",
            Place(file, begins[-1], 1),
            REPAIR,
        )
    if not begins:
        raise ReadError("there are no conflict markers", Place(file, 1, 1))
    known = None if lacks_base else "".join(base)
    return MarkedText("".join(ours), "".join(theirs), known, tuple(begins))


def _lines(text: str) -> list[str]:
    """The lines with their ends. Other ends of line than those of git count as text."""
    *lines, last = text.split("\n")
    return [f"{line}\n" for line in lines] + ([last] if last else [])


def _next(part: str, sign: str, place: Place) -> str:
    """Return the part of a conflict that a marker begins; empty after its end."""
    allowed = {"": OURS, OURS: BASE + MIDDLE, BASE: MIDDLE, THEIRS: THEIRS}[part]
    if sign not in allowed:
        what = "stands inside another conflict" if part and sign == OURS else "has no beginning"
        if part and sign != OURS:
            what = "stands at a wrong place of its conflict"
        raise ReadError(f"the conflict marker {sign * 7} {what}", place, REPAIR, length=7)
    return {OURS: OURS, BASE: BASE, MIDDLE: THEIRS, THEIRS: ""}[sign]


def told_of_markers(error: ReadError, text: str, file: str) -> ReadError:
    """Return the error about a text that cannot be read: about its conflict markers if it has some,
    else the error itself."""
    if not is_marked(text):
        return error
    try:
        marked = unmarked(text, file)
    except ReadError as odd:
        return odd
    number = len(marked.lines)
    places = "1 place" if number == 1 else f"{number:,} places"
    return ReadError(
        f"the conflict markers of a merge by lines stand in the file, in {places}",
        Place(file, marked.lines[0], 1),
        ADVICE,
        length=7,
    )
