"""Canonical JSON (RFC 8785): equal values give equal bytes, in every program."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from decimal import Decimal
from typing import Any

from smsl_studio.errors import UsageError

Json = Any
_LARGEST = 2**53 - 1
"""The largest whole number. A larger number may have no exact double, so two numbers could have the
same digest."""


def canonical(values: Json) -> bytes:
    """Return the canonical bytes of plain values (dicts, lists, texts, numbers, booleans, None).

    UsageError for a value without a canonical form: a number that is no exact double, a text with
    half a surrogate pair, a key that is no text, an object of another type.
    """
    return _written(values).encode("utf-8")


def _written(value: Json) -> str:
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, Mapping):
        return _map(value)
    if value is None or isinstance(value, bool):
        return json.dumps(value)
    if isinstance(value, int):
        return _whole(value)
    if isinstance(value, float):
        return _number(value)
    if isinstance(value, Sequence) and not isinstance(value, bytes):
        return f"[{','.join(map(_written, value))}]"
    raise UsageError(f"a {type(value).__name__} has no canonical form")


def _map(value: Mapping[Json, Json]) -> str:
    for key in value:
        if not isinstance(key, str):
            raise UsageError(f"the key {key!r} is no text, so it has no canonical form")
    parts = [f"{_text(key)}:{_written(value[key])}" for key in sorted(value, key=_utf16)]
    return f"{{{','.join(parts)}}}"


def _utf16(key: str) -> bytes:
    """Return the sort key of a key: RFC 8785 orders keys by UTF-16 code units, not by code
    points."""
    return key.encode("utf-16-be", "surrogatepass")


def _text(value: str) -> str:
    if not value.isascii() and any("\ud800" <= char <= "\udfff" for char in value):
        raise UsageError(f"the text {value!r} holds half a character, so it has no canonical form")
    return json.dumps(value, ensure_ascii=False)


def _whole(value: int) -> str:
    if abs(value) > _LARGEST:
        raise UsageError(
            f"the number {value} is too large to be sealed exactly", advice="Write it as a text."
        )
    return str(value)


def _number(value: float) -> str:
    """Write a double as ECMAScript does: with the fewest digits that give the same double."""
    if not math.isfinite(value):
        raise UsageError(f"{value} is no number that JSON can hold")
    if value == 0:
        return "0"
    sign, digits, exponent = Decimal(repr(value)).normalize().as_tuple()
    assert isinstance(exponent, int), "a finite number has a whole exponent"
    return ("-" if sign else "") + _laid_out("".join(map(str, digits)), exponent)


def _laid_out(digits: str, exponent: int) -> str:
    point = len(digits) + exponent
    if len(digits) <= point <= 21:
        return digits + "0" * exponent
    if 0 < point <= 21:
        return f"{digits[:point]}.{digits[point:]}"
    if -6 < point <= 0:
        return f"0.{'0' * -point}{digits}"
    fraction = f".{digits[1:]}" if digits[1:] else ""
    return f"{digits[0]}{fraction}e{point - 1:+d}"
