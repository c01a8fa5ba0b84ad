"""Values as Python text, laid out as ruff lays them out: on one line where that fits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

WIDTH = 100
Json = Any


@dataclass(frozen=True)
class Code:
    """A name or an expression that stands as it is."""

    text: str


@dataclass(frozen=True)
class CallLiteral:
    """A call: the name of what is called, and its arguments by name; "" for one by position."""

    name: str
    arguments: tuple[tuple[str, Json], ...]


def text_literal(text: str) -> str:
    """Return a text as a literal, in the quotes that ruff prefers. What cannot be seen is escaped.

    >>> print(text_literal('a "b"'), text_literal("it's"))
    'a "b"' "it's"
    """
    quote = "'" if '"' in text and text.count("'") < text.count('"') else '"'
    shown = "".join(_escaped(char, quote) for char in text)
    return f"{quote}{shown}{quote}"


def _escaped(char: str, quote: str) -> str:
    if char in (quote, "\\"):
        return f"\\{char}"
    if char.isascii() and char.isprintable():
        return char
    return char.encode("unicode_escape").decode("ascii")


def literal(value: Json, indent: int = 0, before: int = 0, after: int = 0) -> str:
    """Return a value as Python text. ``indent`` are the columns of its line, ``before`` and
    ``after`` what else stands in it.
    """
    line = _one_line(value)
    if indent + before + len(line) + after <= WIDTH or not _parts(value):
        return line
    opening, items, closing = _opened(value)
    inner = indent + 4
    rows = []
    for head, item in items:
        text = literal(item, inner, len(head), 1)
        rows.append(f"{' ' * inner}{head}{text},")
    return "\n".join([opening, *rows, f"{' ' * indent}{closing}"])


def _one_line(value: Json) -> str:
    if isinstance(value, str):
        return text_literal(value)
    if isinstance(value, Code):
        return value.text
    if not isinstance(value, CallLiteral | Mapping | Sequence):
        return repr(value)
    opening, items, closing = _opened(value)
    parts = [f"{head}{_one_line(item)}" for head, item in items]
    comma = "," if isinstance(value, tuple) and len(parts) == 1 else ""
    return f"{opening}{', '.join(parts)}{comma}{closing}"


def _parts(value: Json) -> bool:
    return bool(not isinstance(value, str | Code) and _opened(value)[1])


def _opened(value: Json) -> tuple[str, list[tuple[str, Json]], str]:
    """Return how a value opens, what stands in it behind which words, and how it closes."""
    if isinstance(value, CallLiteral):
        named = [(f"{name}=" if name else "", item) for name, item in value.arguments]
        return f"{value.name}(", named, ")"
    if isinstance(value, Mapping):
        return "{", [(f"{_one_line(key)}: ", item) for key, item in value.items()], "}"
    if isinstance(value, tuple):
        return "(", [("", item) for item in value], ")"
    if isinstance(value, list):
        return "[", [("", item) for item in value], "]"
    return "", [], ""
