"""The ``#`` lines: ``# KEY: value``, ``# _KEY: json``, ``# HEADER._KEY: json``."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any, Literal, NamedTuple

from smsl_studio.errors import TextFix
from smsl_studio.smsl.document import Member
from smsl_studio.smsl.document.limits import MAX_DIGITS
from smsl_studio.smsl.native_form.json_values import BadJson, one_line, read_json
from smsl_studio.smsl.native_form.tokens import (
    BARE,
    NAME,
    NEEDS_QUOTES,
    NO_TEXT,
    QUOTED,
    bare,
    decoded,
    quoted,
)

Json = Any
Level = Literal["name", "header", "field"]

NAME_KEYS = ("INITIAL", "ACTIVATING")
"""Header keys whose value is always read as the name of a state."""

INTEGER = r"-?(?:0|[1-9][0-9]*+)"
ENTRY = rf"({NAME})\s*+:\s*+({INTEGER})(?=[\s,)])"

_SPACE = r"[^\S\r\n]*+"
_PREFIX = "HEADER."
_LINE = re.compile(rf"#{_SPACE}((?:HEADER\.)?{QUOTED}|{BARE}){_SPACE}:{_SPACE}([^\r\n]*+)")
_SCALAR = re.compile(
    r"(?:true|false|null|-?(?:0|[1-9][0-9]*+)(?:\.[0-9]++)?(?:[eE][+-]?[0-9]++)?)(?=[\s,]|$)"
)
_MAP = re.compile(rf"\((?>(?:[\s,]*+{ENTRY.replace('(' + NAME, '(?:' + NAME)})*)[\s,]*+\)")
_ENTRY = re.compile(ENTRY)
_TRAIL = re.compile(r"[\s,]*+(?://.*)?", re.DOTALL)
_BEFORE_BRACKET = re.compile(r"\s*+[{}\[\]#]")
_COMMENT = re.compile(r"(?:^|(?<=\s))//")


class HashLine(NamedTuple):
    """A ``#`` line, as offsets into the text. ``end`` is the end of the line."""

    level: Level
    key: str
    start: int
    key_start: int
    key_end: int
    value_start: int
    end: int


class Value(NamedTuple):
    """The value of a line, the offset after it, and whether a key is doubled in it."""

    value: Json
    end: int
    doubled: bool = False


class BadValue(Exception):  # noqa: N818
    """A value that cannot be read.

    ``guess`` is its probable value, None if there is none. ``resume`` is the offset at which
    reading goes on, 0 for the next line.
    """

    def __init__(
        self,
        span: tuple[int, int],
        sentence: str,
        advice: str,
        fix: TextFix | None = None,
        guess: Json = None,
        resume: int = 0,
    ) -> None:
        super().__init__(sentence)
        self.at, self.end = span
        self.sentence, self.advice = sentence, advice
        self.fix, self.guess, self.resume = fix, guess, resume


def line_at(text: str, at: int) -> HashLine | None:
    """Return the line whose ``#`` is at ``at``, None if there is no such line."""
    match = _LINE.match(text, at)
    if match is None:
        return None
    raw = match[1]
    inside = raw.startswith(_PREFIX) and len(raw) > len(_PREFIX)
    try:
        key = decoded(raw.removeprefix(_PREFIX) if inside else raw)
    except ValueError:
        return None
    level: Level = "header" if inside or not key.startswith("_") else "field"
    if key == "NAME" and not inside:
        level = "name"
    return HashLine(level, key, at, match.start(1), match.end(1), match.start(2), match.end())


def read_value(text: str, line: HashLine, depth: int) -> Value:
    """Return the value of a line that is ``depth`` levels deep. BadValue if it cannot be read."""
    raw = text[line.value_start : line.end]
    if line.key.startswith("_") and line.level != "name":
        return _field(text, raw, line, depth)
    if line.level == "name" or line.key in NAME_KEYS:
        if raw[:1] in ("{", "[") and line.level != "name":
            return _json(raw, line, depth)
        return _name(raw, line)
    if raw[:1] in ("{", "["):
        return _json(raw, line, depth)
    if raw[:1] == '"':
        return _quoted(raw, line)
    if raw[:1] == "(" and (found := _map(raw, line)):
        return found
    return _scalar(raw, line) or _text(raw, line)


def is_map(raw: str) -> bool:
    """Return whether a value is a map in round brackets, and not a text that begins with one."""
    return _MAP.fullmatch(raw) is not None


def entries(text: str, start: int) -> Iterator[Member]:
    """Yield the members of the map in round brackets that opens at ``start``. It is known to be
    valid.
    """
    match = _MAP.match(text, start)
    for entry in _ENTRY.finditer(text, start, match.end() if match else start):
        (key_start, key_end), (value_start, value_end) = entry.span(1), entry.span(2)
        yield Member(decoded(entry[1]), key_start, key_end, value_start, value_end)


def _field(text: str, raw: str, line: HashLine, depth: int) -> Value:
    """Return a value in JSON. A value over several lines is a BadValue with a repair."""
    try:
        return _json(raw, line, depth)
    except BadValue as error:
        if error.at < line.value_start + len(raw.rstrip()):
            raise
        try:
            value, length, _ = read_json(text[line.value_start :], depth)
        except BadJson:
            raise error from None
        end = line.value_start + length
        fix = TextFix("Write it on one line", line.value_start, end, one_line(value))
        sentence = f"the value of {line.key} goes over several lines"
        advice = "A header line ends with its line: write the value on one."
        raise BadValue((line.value_start, end), sentence, advice, fix, value, end) from None


def _json(raw: str, line: HashLine, depth: int) -> Value:
    start = line.value_start
    try:
        value, end, doubled = read_json(raw, depth)
    except BadJson as error:
        at = min(start + error.at, line.end)
        raise BadValue((at, at + error.length), error.sentence, error.advice) from None
    _check_trail(raw, end, line)
    return Value(value, start + end, doubled)


def _name(raw: str, line: HashLine) -> Value:
    if raw.startswith('"'):
        return _quoted(raw, line)
    match = bare.match(raw)
    if match and _TRAIL.fullmatch(raw, match.end()):
        return Value(match[0], line.value_start + match.end())
    words = _without_comment(raw)
    words = _BEFORE_BRACKET.split(words, maxsplit=1)[0] or words
    at, end = line.value_start, line.value_start + len(words)
    if not words:
        raise BadValue(
            (line.key_start, line.key_end),
            f"{line.key} has no value",
            f"Write a name behind the colon: # {line.key}: State0.",
        )
    behind = raw[match.end() :].lstrip() if match else ""
    if match and behind[:1] in ("}", "{", "#"):
        cut = line.end - len(behind)
        fix = TextFix("Break the line", cut, cut, "\n")
        raise BadValue(
            (cut, cut + 1),
            "a header line ends with its line",
            "Break the line here.",
            fix,
            match[0],
        )
    fix = TextFix("Write it in quotes", at, end, json.dumps(words, ensure_ascii=False))
    sentence = f"{words!r} is no name without quotes"
    raise BadValue((at, end), sentence, NEEDS_QUOTES, fix, words)


def _quoted(raw: str, line: HashLine) -> Value:
    match = quoted.match(raw)
    start = line.value_start
    if match is None:
        end = start + len(_without_comment(raw))
        fix = TextFix("Close the quotes", end, end, '"')
        sentence, advice = "the quotes are not closed", 'Put " behind the text.'
        raise BadValue((start, end), sentence, advice, fix, raw[1 : end - start])
    try:
        value = decoded(match[0])
    except ValueError:
        raise BadValue((start, start + match.end()), *NO_TEXT) from None
    _check_trail(raw, match.end(), line)
    return Value(value, start + match.end())


def _map(raw: str, line: HashLine) -> Value | None:
    match = _MAP.match(raw)
    if match is None or not _TRAIL.fullmatch(raw, match.end()):
        if line.key != "SUB_SBS":
            return None
        at = line.value_start
        raise BadValue(
            (at, at + len(_without_comment(raw))),
            "SUB_SBS is no map from sub-SBs to digits",
            "Write it as (SB2: 1, SB3: 0), digits from 0 at the left.",
        )
    found: dict[str, int] = {}
    count = 0
    for entry in _ENTRY.finditer(match[0]):
        count += 1
        if len(entry[2]) > MAX_DIGITS:
            raise _too_large(line.value_start + entry.start(2), len(entry[2]))
        try:
            found[decoded(entry[1])] = int(entry[2])
        except ValueError:
            at = line.value_start + entry.start(1)
            raise BadValue((at, at + len(entry[1])), *NO_TEXT) from None
    return Value(found, line.value_start + match.end(), len(found) != count)


def _scalar(raw: str, line: HashLine) -> Value | None:
    match = _SCALAR.match(raw)
    if match is None or not _TRAIL.fullmatch(raw, match.end()):
        return None
    try:
        value = read_json(match[0], 0)[0]
    except BadJson:
        raise _too_large(line.value_start, match.end()) from None
    return Value(value, line.value_start + match.end())


def _text(raw: str, line: HashLine) -> Value:
    words = _without_comment(raw)
    return Value(words, line.value_start + len(words))


def _without_comment(raw: str) -> str:
    """Return the text of a line without its comment.

    A comment is at the beginning or after white space.
    """
    comment = _COMMENT.search(raw)
    return (raw[: comment.start()] if comment else raw).rstrip()


def _check_trail(raw: str, at: int, line: HashLine) -> None:
    if _TRAIL.fullmatch(raw, at):
        return
    behind = raw[at:].lstrip()
    start = line.end - len(behind)
    fix = None
    if behind[:1] in ("}", "{", "#", "]"):
        fix = TextFix("Break the line", start, start, "\n")
    raise BadValue(
        (start, line.end),
        f"more stands behind the value of {line.key}",
        "A header line holds one value, and ends with its line.",
        fix,
    )


def _too_large(at: int, length: int) -> BadValue:
    return BadValue((at, at + length), "the number is too large", "Write a shorter number.")
