"""Reads JSON and base64 from other programs. Only one spelling of each value is accepted."""

from __future__ import annotations

import base64
import binascii
import json
from collections.abc import Callable
from typing import Any, NoReturn

from smsl_studio.errors import SealError

Json = Any
LARGEST = 64 << 20
"""The longest text that is read, in bytes."""


def strict_decoder(
    wrong: Callable[[str], Exception], twice: str = "a key stands twice in one object"
) -> json.JSONDecoder:
    """Return a decoder that takes no key twice in one object and no number that is none (``NaN``).

    ``wrong`` makes the error from a sentence; ``twice`` is the sentence about a key.
    """

    def once(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
        found = dict(pairs)
        if len(found) < len(pairs):
            raise wrong(twice)
        return found

    def no_number(word: str) -> NoReturn:
        raise wrong(f"{word} is no number")

    return json.JSONDecoder(object_pairs_hook=once, parse_constant=no_number)


_JSON = strict_decoder(SealError)


def read_strictly(raw: bytes, what: str) -> Json:
    """Return the values of a JSON text. Messages call the text ``what``.

    SealError if it is no JSON in UTF-8, if a key appears twice, if a number is not finite
    (``NaN``), or if the text is too long.
    """
    if len(raw) > LARGEST:
        raise SealError(f"{what} is larger than {LARGEST >> 20} MB")
    try:
        return _JSON.decode(raw.decode("utf-8"))
    except SealError as error:
        raise SealError(f"{what} is no clear JSON: {error.sentence}") from None
    except (ValueError, RecursionError) as error:
        raise SealError(f"{what} is no JSON: {error}") from None


def base64_text(raw: bytes) -> str:
    """Return bytes as base64."""
    return base64.b64encode(raw).decode("ascii")


def from_base64(text: Json, what: str) -> bytes:
    """Return the bytes of a base64 text. SealError if ``base64_text`` writes it differently."""
    if not isinstance(text, str):
        raise SealError(f"{what} is no text")
    try:
        raw = base64.b64decode(text, validate=True)
    except (binascii.Error, ValueError):
        raise SealError(f"{what} is no base64") from None
    if base64_text(raw) != text:
        raise SealError(f"{what} is no canonical base64")
    return raw
