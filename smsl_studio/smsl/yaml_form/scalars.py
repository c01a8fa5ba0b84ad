"""Single values: reads and writes them.

They are read by the YAML 1.2 core schema. They are written so that a reader of YAML 1.1 also reads
every text as a text. There ``on`` is true and ``12:30`` a number.
"""

from __future__ import annotations

import json
import re
from math import isfinite
from typing import Any

from smsl_studio.smsl.document.limits import MAX_DIGITS

Json = Any

_MAX_BASED = 3000

_NULL = {"", "~", "null", "Null", "NULL"}
_TRUE = {"true", "True", "TRUE"}
_FALSE = {"false", "False", "FALSE"}
_INT = re.compile(r"[-+]?[0-9]+")
_BASED = re.compile(r"0o[0-7]+|0x[0-9a-fA-F]+")
_FLOAT = re.compile(r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?")
_NO_NUMBER = re.compile(r"[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)")

_SAFE = re.compile(r"[^\W\d](?:[\w./+()>-]| (?=[\w./+()>-]))*")
_TAKEN = {"y", "n", "yes", "no", "on", "off", "true", "false", "null"}
_HIDDEN = re.compile("[\x7f-\x9f\u2028\u2029\ufeff\ufffe\uffff]")

LONGEST_NAME = 900
"""The longest name on one line. YAML finds the colon of a name only within 1,024 characters."""


def is_null(text: str) -> bool:
    """Return whether a plain text is YAML's spelling of null."""
    return text in _NULL


def resolved(text: str) -> Json:
    """Return the value of a plain text. ValueError, with a sentence, if JSON cannot express it."""
    if text in _NULL:
        return None
    if text in _TRUE:
        return True
    if text in _FALSE:
        return False
    if text[0].isalpha():
        return text
    return _number(text, text)


def tagged(text: str, tag: str) -> Json:
    """Return the value of a text with a core tag. ValueError, with a sentence, if it does not fit
    the tag.
    """
    if tag == "str":
        return text
    if tag == "null" and text in _NULL:
        return None
    if tag == "bool" and text in _TRUE | _FALSE:
        return text in _TRUE
    value = _number(text, None) if tag in ("int", "float") else None
    if tag == "float" and isinstance(value, int | float):
        return float(value)
    if tag == "int" and isinstance(value, int):
        return value
    raise ValueError(f"this is no value for the tag !!{tag}")


def _number(text: str, otherwise: Json) -> Json:
    if _INT.fullmatch(text):
        if len(text) > MAX_DIGITS:
            raise ValueError("the number is too large")
        return int(text)
    if _BASED.fullmatch(text):
        if len(text) > _MAX_BASED:
            raise ValueError("the number is too large")
        return int(text, 0)
    if _FLOAT.fullmatch(text):
        value = float(text)
        if not isfinite(value):
            raise ValueError("the number is too large")
        return value
    if _NO_NUMBER.fullmatch(text):
        raise ValueError(f"{text} is no number that SMSL can hold")
    return otherwise


def written(value: Json) -> str:
    """Return a text, number, boolean or null as YAML. ValueError if it is no such value."""
    if isinstance(value, str):
        return _text(value)
    if value is None:
        return "null"
    if isinstance(value, float):
        return _float(value)
    return json.dumps(value)


def _text(value: str) -> str:
    if _SAFE.fullmatch(value) and value.lower() not in _TAKEN:
        return value
    quoted = json.dumps(value, ensure_ascii=False)
    return _HIDDEN.sub(lambda match: f"\\u{ord(match[0]):04x}", quoted)


def _float(value: float) -> str:
    """Return a float with a point and a signed exponent. YAML 1.1 reads others as a text."""
    if not isfinite(value):
        raise ValueError(value)
    digits, mark, exponent = repr(value).partition("e")
    if not mark:
        return digits
    point = "" if "." in digits else ".0"
    sign = "" if exponent[0] in "+-" else "+"
    return f"{digits}{point}e{sign}{exponent}"
