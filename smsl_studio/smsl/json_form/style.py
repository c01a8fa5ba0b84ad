"""How a JSON text is laid out, and new values written in that layout."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from smsl_studio.smsl.document import Document
from smsl_studio.smsl.json_form.spans import JsonSpans

Json = Any
_SAMPLED = 8


@dataclass(frozen=True, slots=True)
class JsonStyle:
    """The layout of a text: line end, one step of indentation, separators.

    Objects at depth ``inline_from`` and below stand on one line (the file is depth 0, an SB 1, a
    state or HEADER 2).
    """

    newline: str = "\n"
    unit: str = "    "
    colon: str = ": "
    comma: str = ", "
    inline_from: int = 99


CANONICAL = JsonStyle()


def render(value: Json, style: JsonStyle, indent: str, depth: int) -> str:
    """A value as text; ``indent`` is that of the line its key stands on."""
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
    """A text, number, true, false, null or empty list; ValueError for what JSON has no word for."""
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


def _wrapped(marks: str, items: list[str], style: JsonStyle, indent: str, broken: bool) -> str:
    left, right = marks[0], marks[1]
    if not broken:
        return left + style.comma.join(items) + right
    start = style.newline + indent + style.unit
    return left + start + ("," + start).join(items) + style.newline + indent + right


def style_of(document: Document) -> JsonStyle:
    """The style a text is written in, learnt from its first objects."""
    spans = JsonSpans(document.text)
    members = spans.members(())
    if not members:
        return JsonStyle(newline=document.newline)
    text, first = document.text, members[0]
    lead = text[spans.root + 1 : first.key_start]
    colon = text[first.key_end : first.value_start]
    if "\n" in colon or "\r" in colon:
        colon = ": "
    comma = ", " if colon.endswith(" ") else ","
    if document.newline not in lead:
        return JsonStyle(document.newline, "", colon, comma, 0)
    unit = lead.rpartition(document.newline)[2]
    return JsonStyle(document.newline, unit, colon, comma, _inline_from(document, spans))


def _inline_from(document: Document, spans: JsonSpans) -> int:
    """The depth from which the objects of a text stand on one line."""
    text, starts = document.text, [spans.root]
    for depth in range(1, 5):
        inner = [
            member.value_start
            for start in starts
            for member in spans.scan(start)[:_SAMPLED]
            if text[member.value_start] == "{"
        ]
        starts = [start for start in inner if spans.scan(start)]
        if starts and not any(_broken(document, spans, start) for start in starts):
            return depth
    return 99


def _broken(document: Document, spans: JsonSpans, start: int) -> bool:
    """Whether the object at ``start`` begins its members on a new line."""
    return document.newline in document.text[start : spans.scan(start)[0].key_start]
