"""The layout of a JSON text, and new values in that layout."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from smsl_studio.smsl.document import Document, Path
from smsl_studio.smsl.json_form.spans import JsonSpans

Json = Any
_SAMPLED = 8


@dataclass(frozen=True, slots=True)
class JsonStyle:
    """The layout of a text: line end, one step of indentation, separators.

    Objects at depth ``inline_from`` and below are on one line. The file has depth 0, an SB 1, a
    state or HEADER 2.
    """

    newline: str = "\n"
    unit: str = "    "
    colon: str = ": "
    comma: str = ", "
    inline_from: int = 99


CANONICAL = JsonStyle()
_ENCODER = json.JSONEncoder(ensure_ascii=False, allow_nan=False)


def render(value: Json, style: JsonStyle, indent: str, depth: int) -> str:
    """Return a value as text. ``indent`` is the indentation of the line with its key."""
    if isinstance(value, dict) and value:
        items = [
            f"{scalar(key)}{style.colon}{render(inner, style, indent + style.unit, depth + 1)}"
            for key, inner in value.items()
        ]
        return _wrapped("{}", items, style, indent, depth < style.inline_from)
    if isinstance(value, list) and value:
        items = [render(inner, style, indent + style.unit, depth + 1) for inner in value]
        nested = any(isinstance(inner, dict | list) and inner for inner in value)
        return _wrapped("[]", items, style, indent, nested and depth < style.inline_from)
    return "{}" if isinstance(value, dict) else scalar(value)


def scalar(value: Json) -> str:
    """Return a text, number, true, false, null or empty list. ValueError if JSON cannot express
    it.
    """
    return _ENCODER.encode(value)


def _wrapped(marks: str, items: list[str], style: JsonStyle, indent: str, broken: bool) -> str:
    left, right = marks[0], marks[1]
    if not broken:
        return left + style.comma.join(items) + right
    start = style.newline + indent + style.unit
    return left + start + ("," + start).join(items) + style.newline + indent + right


def style_of(document: Document, spans: JsonSpans) -> JsonStyle:
    """Return the style of a text, from its first objects."""
    text, newline = document.text, document.newline
    lines = _First(text, newline, spans, ((), spans.root))
    if not lines.members:
        return JsonStyle(newline=newline)
    first = lines.members[0]
    colon = text[first.key_end : first.value_start]
    if "\n" in colon or "\r" in colon:
        colon = ": "
    comma = ", " if colon.endswith(" ") else ","
    if not lines.broken:
        return JsonStyle(newline, "", colon, comma, 0)
    unit = lines.lead.rpartition(newline)[2]
    return JsonStyle(newline, unit, colon, comma, lines.inline_from())


class _First:
    """The first members of one object of a text."""

    def __init__(self, text: str, newline: str, spans: JsonSpans, at: tuple[Path, int]) -> None:
        self._text, self._newline, self._spans = text, newline, spans
        self._path, start = at
        self.members = spans.first(self._path, start, _SAMPLED)
        self.lead = text[start + 1 : self.members[0].key_start] if self.members else ""
        self.broken = newline in self.lead
        """Whether its members begin on a new line."""

    def inner(self) -> list[_First]:
        """Return the same for the objects in it that are not empty."""
        places = [
            ((*self._path, one.key), one.value_start)
            for one in self.members
            if self._text[one.value_start] == "{"
        ]
        found = [_First(self._text, self._newline, self._spans, place) for place in places]
        return [one for one in found if one.members]

    def inline_from(self) -> int:
        """Return the depth from which objects are on one line, if this is the root of the text."""
        layer = [self]
        for depth in range(1, 5):
            layer = [inner for one in layer for inner in one.inner()]
            if layer and not any(one.broken for one in layer):
                return depth
        return 99
