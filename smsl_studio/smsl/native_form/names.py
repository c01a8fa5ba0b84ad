"""Reads faulty names: quotes that are not closed, and names that need quotes."""

from __future__ import annotations

import json
import re

from smsl_studio.errors import TextFix
from smsl_studio.smsl.native_form.faults import Faults
from smsl_studio.smsl.native_form.tokens import NEEDS_QUOTES, NO_TEXT, bare, decoded, quoted

BEFORE_BRACKET = re.compile(r"[^\S\r\n]*+:")
BEFORE_ARROW = re.compile(r"[^\S\r\n]*+(?:->|=>)")
BEFORE_COMMA = re.compile(r"[^\S\r\n]*+(?:[,\]\r\n]|//|$)")
"""The text that follows the name of a state, the name of an operation, and a target."""

_LINE = re.compile(r"[^\r\n]*+")
_RUN = re.compile(r'[^\r\n{}\[\],#"]*+')


def read(text: str, at: int, faults: Faults, behind: re.Pattern[str]) -> tuple[str, int] | None:
    """Return the name at ``at`` and the offset after it, None if there is no name.

    If the quotes are not closed, or are missing, a fault is reported. The name then ends before the
    text that should follow it (``behind``).
    """
    if text[at : at + 1] == '"':
        return _quoted(text, at, faults, behind)
    match = bare.match(text, at)
    if match is None:
        return None
    end = match.end()
    if behind.match(text, end) or text[end : end + 1] in ("", "[", "]", "{", "}", ",", ":"):
        return match[0], end
    run = _RUN.match(text, at)
    stop = _cut(run[0], behind) if run else None
    if stop is None or at + stop <= end:
        return match[0], end
    whole = text[at : at + stop].rstrip()
    if "//" in whole:
        return match[0], end
    _tell(faults, at, whole)
    return whole, at + len(whole)


def torn_target(text: str, before: tuple[int, int], at: int, faults: Faults) -> int | None:
    """Report a target with a space or a sign in it, written without quotes. Return the offset after
    it.

    None if it is no such target. ``before`` is the span of the part that was read as the target.
    ``at`` is the offset of the rest.
    """
    start, end = before
    if text[end:at].strip(" \t") or text[start] == '"' or text[at] in "#[]{}":
        return None
    run = _RUN.match(text, start)
    if run is None or "->" in run[0] or "//" in run[0] or ":" in run[0]:
        return None
    whole = run[0].rstrip()
    _tell(faults, start, whole)
    return start + len(whole)


def _tell(faults: Faults, at: int, whole: str) -> None:
    end = at + len(whole)
    fix = TextFix("Write it in quotes", at, end, json.dumps(whole, ensure_ascii=False))
    faults.add(at, end, f"{whole!r} is no name without quotes", NEEDS_QUOTES, fix)


def _cut(run: str, behind: re.Pattern[str]) -> int | None:
    """Return the length of the name at the beginning of ``run``. It ends before ``behind``."""
    match = behind.search(run)
    if match is None and behind is BEFORE_COMMA:
        return len(run)
    return match.start() if match else None


def _quoted(text: str, at: int, faults: Faults, behind: re.Pattern[str]) -> tuple[str, int] | None:
    match = quoted.match(text, at)
    if match:
        try:
            return decoded(match[0]), match.end()
        except ValueError:
            faults.add(at, match.end(), *NO_TEXT)
            return match[0][1:-1].encode("utf-8", "replace").decode(), match.end()
    line = _LINE.match(text, at + 1)
    run = line[0] if line else ""
    stop = behind.search(run)
    inside = re.split(r"[{}\[\],:]|->|//", run, maxsplit=1)[0]
    length = stop.start() if stop and stop.start() <= len(inside) else len(inside)
    name = run[:length].rstrip()
    end = at + 1 + len(name)
    fix = TextFix("Close the quotes", end, end, '"')
    faults.add(at, end, "the quotes are not closed", 'Put " behind the name.', fix)
    return name, end
