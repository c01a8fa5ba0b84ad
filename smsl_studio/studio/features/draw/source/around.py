"""What lies around a place in a text, even if the text cannot be read at the moment.

Half-typed text has no spans. So this looks from the place back to the open brackets (in YAML also
the indentation), and tells the names on the path to it and what may be written there.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

_STRING = r'"(?:[^"\\\n]|\\.)*"?'
_TOKENS = {
    "json": re.compile(_STRING + r"|[{}\[\]:,]|[^\s{}\[\]:,\"]+"),
    "smsl": re.compile(_STRING + r"|//.*|#.*|->|[{}\[\]:,]|(?:[^\s{}\[\]:,#/\"()>-]|-(?!>))+|."),
    "yaml": re.compile(
        _STRING + r"|'[^'\n]*'?|(?<!\S)#.*|[{}\[\],]|:(?=\s|$)|(?:[^\s{}\[\],:#\"'-]|-(?=\S))"
        r"(?:[^{}\[\],:#\n]|:(?=\S)|(?<=\S)#)*"
    ),
}
HEADER = "HEADER"
_BRACKET = re.compile(r"[{}\[\]]")
_CLOSING = re.compile(r"\s*[}\]],?\s*")
_OPENING = re.compile(r'\s*"?[\w.-]+"?\s*:?\s*[{\[]\s*')
"""Most lines with brackets match one of these patterns, which is fast to test."""
_HEADER = re.compile(r"\s*#[ \t]*([^:\s]*)(?:\s*:\s*(.*?))?\s*$")
_INDENTED = re.compile(r"(\s*(?:- +)*)(.*)")


@dataclass(frozen=True)
class TextToken:
    """A word or sign of one line, and the column where it begins."""

    text: str
    start: int

    @property
    def end(self) -> int:
        """The column after its last character."""
        return self.start + len(self.text)

    @property
    def name(self) -> str:
        """The name without its quotes."""
        return unquoted(self.text)


@dataclass(frozen=True)
class Around:
    """A place in a text: the path of names it lies in, and the word that is written there.

    ``key`` is the name whose value is written here; empty if the place is for a name itself.
    ``start`` and ``end`` are the columns of the ``word`` with its quotes. ``typed`` is the part of
    the word before the place.
    """

    path: tuple[str, ...]
    key: str
    word: str
    typed: str
    start: int
    end: int
    is_value: bool


def around(
    lines: Sequence[str], at: int, column: int, form: str, path: tuple[str, ...] | None = None
) -> Around:
    """What lies around a column of a line. ``path`` saves time if the caller knows it."""
    found = tokens(lines[at], form)
    here = next((t for t in found if t.start < column <= t.end and _is_word(t)), None)
    here = here or next((t for t in found if t.start == column and _is_word(t)), None)
    start, end = (here.start, here.end) if here else (column, column)
    before = [token for token in found if token.end <= start]
    if path is None:
        path = path_at(lines, at, start, form)
    header = _HEADER.match(lines[at]) if form == "smsl" else None
    if header:
        return _in_header(header, path, column)
    word = here.name if here else ""
    typed = unquoted(here.text[: column - start]) if here else ""
    if before and before[-1].text in (":", "->"):
        key = before[-2].name if len(before) > 1 else ""
        return Around(path, key, word, typed, start, end, True)
    return Around(path, "", word, typed, start, end, False)


def _in_header(header: re.Match[str], path: tuple[str, ...], column: int) -> Around:
    """What lies around a place in a header line of native text."""
    key, value = header[1], header[2] or ""
    if header[2] is None or column < header.start(2):
        typed = key[: max(0, column - header.start(1))]
        return Around((*path[:1], HEADER), "", key, typed, *header.span(1), False)
    found = [one for one in tokens(value, "smsl") if _is_word(one) and one.text not in "()"]
    at = column - header.start(2)
    here = next((one for one in found if one.start <= at <= one.end), TextToken("", at))
    start, end = header.start(2) + here.start, header.start(2) + here.end
    inner = (*path[:1], HEADER, key) if value.startswith("(") else (*path[:1], HEADER)
    typed = unquoted(here.text[: at - here.start])
    return Around(inner, "" if inner[2:] else key, here.name, typed, start, end, not inner[2:])


def tokens(line: str, form: str) -> list[TextToken]:
    """The words and signs of a line."""
    pattern = _TOKENS.get(form, _TOKENS["json"])
    found = pattern.finditer(line.rstrip("\r\n"))
    return [TextToken(match[0].rstrip(), match.start()) for match in found if match[0].strip()]


def path_at(lines: Sequence[str], at: int, column: int, form: str) -> tuple[str, ...]:
    """The names of the path to a place, the outermost first."""
    if form == "smsl":
        return _native_path(lines, at, column)
    names, line = _names_before(lines, at, column, form)
    if form == "yaml":
        names += _by_indentation(lines, line if names else at, column if not names else None)
    return tuple(name for name in reversed(names) if name)


def key_at(line: str, column: int, form: str) -> TextToken | None:
    """The name to which the text at a column of a line belongs."""
    found = tokens(line, form)
    keys = [one for one, mark in pairwise(found) if mark.text in (":", "->")]
    return next((key for key in reversed(keys) if key.start <= column), None)


def unquoted(word: str) -> str:
    """A name without its quotes; the closing quote may be missing."""
    if word[:1] == "'":
        return word[1:].removesuffix("'").replace("''", "'")
    if word[:1] != '"':
        return word
    closed = word if len(word) > 1 and word.endswith('"') else word + '"'
    try:
        return str(json.loads(closed))
    except ValueError:
        return word.strip('"')


def _is_word(token: TextToken) -> bool:
    return token.text not in ("{", "}", "[", "]", ":", ",", "->") and token.text[:2] != "//"


def _names_before(lines: Sequence[str], at: int, column: int, form: str) -> tuple[list[str], int]:
    """The names of the brackets around a place, the innermost first, and the line of the last."""
    names, outermost = [], at
    for bracket, line in _open_brackets(lines, at, column, form):
        name, outermost = _name_before(lines, line, bracket.start, form)
        names.append(name)
    return names, outermost


def _open_brackets(
    lines: Sequence[str], at: int, column: int, form: str
) -> Iterator[tuple[TextToken, int]]:
    """The brackets that are open at a place, the innermost first, each with its line."""
    closed = 0
    for number in range(at, -1, -1):
        line = lines[number][:column] if number == at else lines[number]
        if _CLOSING.fullmatch(line):
            closed += 1
            continue
        if closed and _OPENING.fullmatch(line):
            closed -= 1
            continue
        if not _BRACKET.search(line):
            continue
        for token in reversed(tokens(line, form)):
            if token.text in ("}", "]"):
                closed += 1
            elif token.text in ("{", "["):
                if not closed:
                    yield token, number
                closed = max(0, closed - 1)


def _name_before(lines: Sequence[str], at: int, column: int, form: str) -> tuple[str, int]:
    """The name whose value a bracket opens, and its line; an empty name if it has none."""
    number, found = at, [one for one in tokens(lines[at], form) if one.end <= column]
    while not found and number and number > at - 3:
        number -= 1
        found = tokens(lines[number], form)
    if len(found) > 1 and found[-1].text == ":":
        return found[-2].name, number
    return "", at


def _native_path(lines: Sequence[str], at: int, column: int) -> tuple[str, ...]:
    state = ""
    for bracket, number in _open_brackets(lines, at, column, "smsl"):
        if bracket.text == "{":
            branch = _native_name(lines, number, at)
            return (branch, state) if state else (branch,)
        state = _name_before(lines, number, bracket.start, "smsl")[0]
    return ()


def _native_name(lines: Sequence[str], first: int, last: int) -> str:
    """The NAME in the header after the bracket that opens an SB."""
    for number in range(first, min(len(lines), max(last, first + 20) + 1)):
        header = _HEADER.search(lines[number].partition("{")[2] or lines[number])
        if header and header[1] == "NAME":
            return unquoted(header[2] or "")
    return ""


def _by_indentation(lines: Sequence[str], at: int, column: int | None) -> list[str]:
    """The names of the blocks in which a line of YAML is indented, the innermost first."""
    indent = _indent(lines[at]) if column is None else min(_indent(lines[at], column), column)
    names = []
    for number in range(at - 1, -1, -1):
        line = lines[number]
        if not indent:
            break
        if not line.strip() or line.lstrip().startswith("#") or _indent(line) >= indent:
            continue
        indent = _indent(line)
        found = tokens(line, "yaml")
        names += [found[0].name] if len(found) == 2 and found[1].text == ":" else []
    return names


def _indent(line: str, blank: int = 0) -> int:
    match = _INDENTED.match(line)
    return len(match[1]) if match and match[2] else blank
