"""Reading JSON: text to Document. Where its values stand is found later (``spans``)."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from math import isfinite
from typing import Any, NoReturn

from smsl_studio.errors import ReadError
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.json_form.spans import STRING, JsonSpans, skip_space
from smsl_studio.smsl.json_form.style import CANONICAL, render

MAX_CHARACTERS = 256 * 1024 * 1024
MAX_DEPTH = 64
MAX_DIGITS = 4000

_BRACKET = re.compile(STRING.pattern + r"|[\[{]|[\]}]", re.DOTALL)
_NUMBER = r"-?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?"
_TOKEN = re.compile(rf"{STRING.pattern}|NaN|-?Infinity|{_NUMBER}", re.DOTALL)
_SURROGATE = re.compile(r"\\u[dD][89a-fA-F]")
_ESCAPE = re.compile(r"\\(?:u([0-9a-fA-F]{4})|.)", re.DOTALL)


def parse(text: str, file: str) -> Document:
    """Read a JSON text; ReadError with file:line:column where it is no JSON object.

    A BOM is accepted and kept. A key written twice opens: the last one wins, in the place of the
    first, and ``Document.duplicates`` finds them all.
    """
    blank = Document(text, file, "json", {}, JsonSpans)
    _check_size(blank)
    _check_characters(blank)
    doubled = False

    def keep(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        nonlocal doubled
        found = dict(pairs)
        if len(found) != len(pairs):
            doubled = True
        return found

    shift = 1 if text.startswith("\ufeff") else 0
    try:
        values = json.loads(
            text[shift:], object_pairs_hook=keep, parse_constant=_no_number, parse_float=_number
        )
    except RecursionError:
        _check_depth(blank)
        raise
    except json.JSONDecodeError as error:
        raise _invalid(blank, min(error.pos + shift, len(text)), error.msg) from None
    except ValueError:
        raise _bad_number(blank) from None
    if not isinstance(values, dict):
        raise ReadError(
            "the file holds no State Branches",
            blank.place_at(skip_space(text, shift)),
            "An SMSL file is one JSON object whose members are State Branches.",
        )
    if doubled or _is_deep(values):  # what a doubled key hides is not in the values
        _check_depth(blank)
    return Document(text, file, "json", values, JsonSpans, doubled)


def write(values: Mapping[str, Any]) -> str:
    """Values as a new text in the canonical layout: four spaces, one member a line."""
    return render(dict(values), CANONICAL, "", 0) + "\n"


def _no_number(name: str) -> NoReturn:
    raise ValueError(name)


def _number(text: str) -> float:
    """A float; ValueError where it is too large for one (Python would read infinity)."""
    value = float(text)
    if not isfinite(value):
        raise ValueError(text)
    return value


def _invalid(document: Document, at: int, message: str) -> ReadError:
    if not document.text.strip("\ufeff \t\r\n"):
        sentence = "the file is empty"
        advice = "An empty blueprint is written {}."
    else:
        sentence = f"no valid JSON: {message[:1].lower()}{message[1:]}".removesuffix(" at")
        advice = "Check the commas, quotes and braces around this place."
    return ReadError(sentence, document.place_at(at), advice)


def _bad_number(document: Document) -> ReadError:
    """What is wrong with the first number that JSON or this program has no room for."""
    for match in _TOKEN.finditer(document.text):
        found = match[0]
        if found.startswith('"'):
            continue
        if found in ("NaN", "Infinity", "-Infinity"):
            sentence, advice = f"{found} is no number in JSON", "Write a plain number."
        elif _is_too_large(found):
            sentence, advice = "the number is too large", "Write a shorter number."
        else:
            continue
        return ReadError(f"no valid JSON: {sentence}", document.place_at(match.start()), advice)
    return ReadError("no valid JSON: a number cannot be read", document.place_at(0))


def _is_too_large(number: str) -> bool:
    whole = number.lstrip("-").isdecimal()
    return len(number) > MAX_DIGITS if whole else not isfinite(float(number))


def _check_size(document: Document) -> None:
    """Refuse texts so large that reading them would exhaust the machine."""
    if len(document.text) > MAX_CHARACTERS:
        raise ReadError(
            f"the file is larger than {MAX_CHARACTERS >> 20} million characters",
            document.place_at(0),
            "Split it into several files.",
        )


def _is_deep(values: Any) -> bool:
    """Whether values are nested deeper than is allowed; far quicker than looking at the text."""
    layer = [values]
    for _ in range(MAX_DEPTH):
        objects = (one.values() if isinstance(one, dict) else one for one in layer)
        layer = [value for inner in objects for value in inner if type(value) in (dict, list)]
        if not layer:
            return False
    return True


def _check_depth(document: Document) -> None:
    """Refuse texts nested so deep that working on them would exhaust the stack."""
    depth = 0
    for match in _BRACKET.finditer(document.text):
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


def _check_characters(document: Document) -> None:
    """Refuse half a surrogate pair: no file could hold what it would be written back as."""
    text = document.text
    advice = "Write the character itself, or both halves of the pair."
    try:
        text.encode("utf-8")
    except UnicodeEncodeError as error:
        place = document.place_at(error.start)
        raise ReadError("half a surrogate pair is no character", place, advice) from None
    if not _SURROGATE.search(text):
        return
    for match in STRING.finditer(text):
        at = _half_pair(text, match.start(), match.end())
        if at is not None:
            sentence = f"{text[at : at + 6]} is half a surrogate pair, which is no character"
            raise ReadError(sentence, document.place_at(at), advice)


def _half_pair(text: str, start: int, end: int) -> int | None:
    """The offset of the first escaped surrogate between start and end that stands alone."""
    high: int | None = None
    for escape in _ESCAPE.finditer(text, start, end):
        code = int(escape[1], 16) if escape[1] else 0
        if high is not None:
            if not (0xDC00 <= code < 0xE000 and escape.start() == high + 6):
                return high
            high = None
        elif 0xD800 <= code < 0xDC00:
            high = escape.start()
        elif 0xDC00 <= code < 0xE000:
            return escape.start()
    return high
