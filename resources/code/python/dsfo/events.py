"""The events of a run, as plain values, and their lines in a log."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any
from unicodedata import category

Event = dict[str, Any]
"""``event`` is its word and ``t`` the simulated time (s). Addresses are texts."""

_BLANK = frozenset(
    map(
        chr,
        (
            *(0x034F, 0x115F, 0x1160, 0x17B4, 0x17B5, 0x2800, 0x3164, 0xFFA0),
            *range(0x180B, 0x1810),
            *range(0xFE00, 0xFE10),
            *range(0xE0100, 0xE01F0),
        ),
    )
)
"""Characters that count as printable but cannot be seen."""


def event(word: str, time: float, **values: Any) -> Event:
    """Return an event."""
    return {"event": word, "t": time, **values}


def line(values: Mapping[str, Any]) -> str:
    """Return one line of JSON. Numbers are rounded to six decimals, and what cannot be seen is
    escaped.
    """
    text = json.dumps(_plain(values), ensure_ascii=False, separators=(",", ":"))
    if text.isascii() and "\x7f" not in text:
        return text
    return "".join(_escaped(char) if _is_hidden(char) else char for char in text)


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(one) for key, one in value.items()}
    if isinstance(value, float):
        return round(value, 6)
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [_plain(one) for one in value]
    return value


def _is_hidden(char: str) -> bool:
    if char.isprintable():
        return char in _BLANK
    return category(char) != "Zs"


def _escaped(char: str) -> str:
    units = char.encode("utf-16-be", "surrogatepass")
    return "".join(f"\\u{units[at]:02x}{units[at + 1]:02x}" for at in range(0, len(units), 2))
