"""JSON values on one line: those of ``_`` lines, and header values that have no other spelling."""

from __future__ import annotations

import json
import re
from math import isfinite
from typing import Any, NoReturn

from smsl_studio.smsl.document.limits import MAX_DEPTH, TOO_DEEP, too_large
from smsl_studio.smsl.json_form.characters import HALF_PAIR, half_pair

Json = Any

_BRACKET = re.compile(r'"[^"\\]*+(?:\\.[^"\\]*+)*+"|[\[\]{}]', re.DOTALL)


class BadJson(ValueError):  # noqa: N818
    """A value cannot be read: the reason, and the offset at which it begins to be wrong."""

    def __init__(self, at: int, length: int, sentence: str, advice: str) -> None:
        super().__init__(sentence)
        self.at, self.length, self.sentence, self.advice = at, length, sentence, advice


class _BadNumber(Exception):  # noqa: N818
    def __init__(self, sentence: str) -> None:
        super().__init__(sentence)
        self.sentence = sentence


def read_json(raw: str, depth: int) -> tuple[Json, int, bool]:
    """Return the JSON value at the beginning of a text, its end, and whether a key is doubled in
    it.

    The value is ``depth`` levels deep in its document. This counts towards the limit of nesting.
    BadJson if it cannot be read.
    """
    doubled = False

    def keep(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        """Return the object, and set ``doubled`` if a key occurs twice in it."""
        nonlocal doubled
        found = dict(pairs)
        doubled = doubled or len(found) != len(pairs)
        return found

    _check_depth(raw, MAX_DEPTH - depth)
    decoder = json.JSONDecoder(
        object_pairs_hook=keep,
        parse_constant=_no_number,
        parse_float=_float,
        parse_int=_int,
    )
    try:
        value, end = decoder.raw_decode(raw)
    except json.JSONDecodeError as error:
        words = f"{error.msg[:1].lower()}{error.msg[1:]}".removesuffix(" at")
        sentence = f"no valid JSON: {words}" if raw else "a value in JSON is missing"
        advice = 'A value in JSON stands on one line, such as {"S0": [1, 2]}, 2.5, "text" or true.'
        raise BadJson(error.pos, 1, sentence, advice) from None
    except _BadNumber as error:
        sentence = f"no valid JSON: {error.sentence}"
        raise BadJson(0, len(raw), sentence, "Write a plain, shorter number.") from None
    half = half_pair(raw, 0, end)
    if half is not None:
        raise BadJson(half, 6, *HALF_PAIR)
    return value, end, doubled


def one_line(value: Json) -> str:
    """Return a value as JSON on one line."""
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


def _no_number(name: str) -> NoReturn:
    raise _BadNumber(f"{name} is no number in JSON")


def _float(text: str) -> float:
    value = float(text)
    if not isfinite(value):
        raise _BadNumber("the number is too large")
    return value


def _int(text: str) -> int:
    if too_large(text):
        raise _BadNumber("the number is too large")
    return int(text)


def _check_depth(raw: str, most: int) -> None:
    if raw.count("[") + raw.count("{") <= most:
        return
    depth = 0
    for match in _BRACKET.finditer(raw):
        if match[0] in "[{":
            depth += 1
            if depth > most:
                raise BadJson(match.start(), 1, *TOO_DEEP)
        elif match[0] in "]}":
            depth -= 1
