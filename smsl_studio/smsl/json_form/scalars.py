"""The value of a single token, and its fault if it is not valid JSON."""

from __future__ import annotations

from typing import Any

from smsl_studio.errors import TextFix
from smsl_studio.smsl.document.limits import too_large
from smsl_studio.smsl.json_form.brackets import NOTHING
from smsl_studio.smsl.json_form.tokens import NUMBER, TEXT, JsonFault, JsonToken, quoted, short

Json = Any
_LITERALS: dict[str, Json] = {"true": True, "false": False, "null": None}
_OTHERS = {"True": "true", "False": "false", "None": "null", "TRUE": "true", "FALSE": "false"}
_NO_VALUES = ("NaN", "Infinity", "-Infinity", "nan", "inf", "-inf", "undefined")


def scalar_of(token: JsonToken) -> tuple[Json, JsonFault | None]:
    """Return the value of a text, number or word, and its fault."""
    found, length = token.value, token.end - token.start
    if token.kind == TEXT:
        return found, None
    if token.kind == NUMBER:
        if too_large(found):
            advice = "Write a shorter number."
            return NOTHING, JsonFault(token.start, length, "the number is too large", advice)
        return int(found) if found.lstrip("-").isdecimal() else float(found), None
    if found in _LITERALS:
        return _LITERALS[found], None
    if found in _NO_VALUES:
        words = f"{found} is no number in JSON"
        return NOTHING, JsonFault(token.start, length, words, "Write a plain number.")
    instead = _OTHERS.get(found, quoted(found))
    write = f"Write {short(instead)}"
    fix = TextFix(write, token.start, token.end, instead)
    words = f"{short(found)} is no value in JSON"
    return _LITERALS.get(instead, found), JsonFault(token.start, length, words, f"{write}.", fix)
