"""The spelling of single names and values in the native form, and the errors if there is none."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from smsl_studio.errors import ConvertError
from smsl_studio.smsl.document import Path
from smsl_studio.smsl.native_form.json_values import one_line
from smsl_studio.smsl.native_form.lines import NAME_KEYS, BadValue, line_at, read_value
from smsl_studio.smsl.native_form.tokens import is_bare, spelled

Json = Any


def edge_text(branch: str, state: str, name: str, target: Json, arrow: str = " -> ") -> str:
    """Return an operation as text. ConvertError if its target is not a text."""
    if type(target) is not str:
        raise no_spelling((branch, state, name), "its target is not the name of a state")
    return f"{spelled(name)}{arrow}{spelled(target)}"


def header_key(key: str) -> str:
    """Return a header key as it is written."""
    if key.startswith("_") or key == "NAME":
        return f"HEADER.{spelled(key)}"
    return f'"{key}"' if key.startswith("HEADER.") and is_bare(key) else spelled(key)


def header_value(branch: str, key: str, value: Json) -> str:
    """Return the value of a header key as it is written. ConvertError if it cannot be written."""
    if key.startswith("_"):
        return one_line(value)
    if key in NAME_KEYS and not isinstance(value, dict | list):
        if type(value) is not str:
            raise no_spelling((branch, "HEADER", key), "its value is not the name of a state")
        return spelled(value)
    if key == "SUB_SBS" and isinstance(value, dict) and all(type(v) is int for v in value.values()):
        return map_text(value)
    if isinstance(value, str) and _reads_as_itself(key, value):
        return value
    return one_line(value)


def map_text(value: Mapping[str, int]) -> str:
    """Return a map of numbers in round brackets."""
    inner = ", ".join(f"{spelled(key)}: {number}" for key, number in value.items())
    return f"({inner})" if inner else "( )"


def _reads_as_itself(key: str, text: str) -> bool:
    """Return whether a text without quotes is read as the same text under this key."""
    if not text or not text.isprintable() or text[0] in '"({[':
        return False
    line = line_at(f"# {header_key(key)}: {text}", 0)
    if line is None:
        return False
    try:
        found = read_value(f"# {header_key(key)}: {text}", line, 3).value
    except BadValue:
        return False
    return type(found) is str and found == text


def must_be_map(path: Path, value: Json, what: str) -> None:
    """Raise ConvertError if a value is not a map. ``what`` names what it should be."""
    if not isinstance(value, dict):
        raise no_spelling(path, f"it is not {what}")


def no_spelling(path: Path, why: str) -> ConvertError:
    """Return the error of a value that the native form cannot express, with its path."""
    where = "/".join(part.replace("~", "~0").replace("/", "~1") for part in path)
    return ConvertError(
        f"{where} cannot be written in the native form: {why}",
        advice="Change it first, or stay with the JSON form.",
    )
