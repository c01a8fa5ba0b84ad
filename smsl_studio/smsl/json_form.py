"""The JSON form: text to Document, and where everything stands in it.

Values come from the standard library's parser. Spans are found by walking one object at a time and
letting the C scanner jump over each value, so that finding one element in a megabyte costs
milliseconds, and nothing is spent on the rest.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any, NoReturn

from smsl_studio.errors import ReadError
from smsl_studio.smsl.document import Document, Member

MAX_BYTES = 256 * 1024 * 1024
MAX_DEPTH = 64

_SPACE = re.compile(r"[ \t\n\r]*")
_STRING = re.compile(r'"(?:[^"\\\x00-\x1f]|\\.)*"')
_SCALAR = re.compile(r"[^ \t\n\r,\]}]+")
_BRACKET = re.compile(r'"(?:[^"\\]|\\.)*"|[\[{]|[\]}]')


def parse_json(text: str, file: str) -> Document:
    """Read a JSON text; ReadError with file:line:column where it is no JSON object."""
    doubled = False

    def keep(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        nonlocal doubled
        found = dict(pairs)
        if len(found) != len(pairs):
            doubled = True
        return found

    def no_constant(name: str) -> NoReturn:
        raise ValueError(name)

    body = text[1:] if text.startswith("\ufeff") else text
    shift = len(text) - len(body)
    blank = Document(text, file, "json", {})
    _check_depth(blank)
    try:
        values = json.loads(body, object_pairs_hook=keep, parse_constant=no_constant)
    except json.JSONDecodeError as error:
        raise ReadError(
            f"no valid JSON: {_plain(error.msg)}",
            blank.place_at(min(error.pos + shift, len(text))),
            "Check the commas, quotes and braces around this place.",
        ) from None
    except ValueError as error:
        at = text.find(str(error)) if str(error) in {"NaN", "Infinity", "-Infinity"} else -1
        raise ReadError(
            f"no valid JSON: {error}", blank.place_at(max(at, 0)), "Use a plain number."
        ) from None
    if not isinstance(values, dict):
        raise ReadError(
            "the file holds no State Branches",
            blank.place_at(skip_space(text, shift)),
            "An SMSL file is one JSON object whose members are State Branches.",
        )
    return Document(text, file, "json", values, doubled)


def write_json(values: Mapping[str, Any]) -> str:
    """Values as a new text in the canonical layout: four spaces, one member a line."""
    from smsl_studio.smsl.style import CANONICAL, render

    return render(dict(values), CANONICAL, "", 0) + "\n"


def skip_space(text: str, at: int) -> int:
    """The offset of the first character that is no white space."""
    match = _SPACE.match(text, at)
    return match.end() if match else at


def scan_container(text: str, start: int) -> Iterator[Member]:
    """The members of the object or list that opens at ``start`` in a text known to be valid JSON.

    The elements of a list have their index for a key, which takes no room in the text.
    """
    mark = text[start : start + 1]
    if mark not in ("{", "["):
        raise KeyError(start)
    at = skip_space(text, start + 1)
    if mark == "[":
        yield from _elements(text, at)
        return
    while text[at] != "}":
        key, key_end = json.decoder.scanstring(text, at + 1)  # type: ignore[attr-defined]
        value = skip_space(text, skip_space(text, key_end) + 1)
        end = _value_end(text, value)
        yield Member(key, at, key_end, value, end)
        at = skip_space(text, end)
        if text[at] == ",":
            at = skip_space(text, at + 1)


def _elements(text: str, at: int) -> Iterator[Member]:
    index = 0
    while text[at] != "]":
        end = _value_end(text, at)
        yield Member(str(index), at, at, at, end)
        index += 1
        at = skip_space(text, end)
        if text[at] == ",":
            at = skip_space(text, at + 1)


def _value_end(text: str, at: int) -> int:
    char = text[at]
    if char in "{[":
        return _SKIP.raw_decode(text, at)[1]
    match = (_STRING if char == '"' else _SCALAR).match(text, at)
    assert match is not None, "the text was parsed before it is scanned"
    return match.end()


_SKIP = json.JSONDecoder()


def _check_depth(document: Document) -> None:
    """Refuse texts that nest so deep that a recursive parser would exhaust the stack."""
    text = document.text
    if len(text) > MAX_BYTES:
        raise ReadError(
            f"the file is larger than {MAX_BYTES >> 20} MiB",
            document.place_at(0),
            "Split it into several files.",
        )
    if text.count("[") + text.count("{") <= MAX_DEPTH:
        return
    depth = 0
    for match in _BRACKET.finditer(text):
        mark = match[0]
        if mark in "[{":
            depth += 1
            if depth > MAX_DEPTH:
                raise ReadError(
                    f"nested deeper than {MAX_DEPTH} levels",
                    document.place_at(match.start()),
                    "SMSL needs three levels and a few for annotations.",
                )
        elif mark in "]}":
            depth -= 1


def _plain(message: str) -> str:
    return message[:1].lower() + message[1:]
