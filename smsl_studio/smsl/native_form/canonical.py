"""Writes a native text in the canonical layout. Comments, order and doubled keys stay.

Names and values keep their spelling, except for white space in maps and JSON. A comment inside an
edge, or between the name and the bracket of a state, moves to a line above it. One empty line
between two elements stays.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

from smsl_studio.smsl.document import Document
from smsl_studio.smsl.native_form.elements import Element
from smsl_studio.smsl.native_form.lines import entries, is_map
from smsl_studio.smsl.native_form.rows import ElementRow, RowFrame, Slot
from smsl_studio.smsl.native_form.spans import NativeSpans

_UNIT = "    "
_MARK = re.compile(r"//[^\r\n]*+|\r\n|\r|\n")
_JSON_TOKEN = re.compile(r'"[^"\\]*+(?:\\.[^"\\]*+)*+"|[\[\]{},:]|[^\s\[\]{},:"]++')


def tidy(document: Document) -> Document:
    """Return the document in the canonical layout. A BOM and the kind of line end stay."""
    text = document.text
    spans = NativeSpans(text)
    start = 1 if text.startswith("\ufeff") else 0
    frame = RowFrame(text, start, len(text), spans.elements, document.newline, outermost=True)
    row = ElementRow(frame)
    lines = [*_NativeTidier(text, spans).rows(row, "")]
    body = "".join(line + document.newline for line in lines)
    changed = text[:start] + body
    return document if changed == text else replace(document, text=changed)


class _NativeTidier:
    def __init__(self, text: str, spans: NativeSpans) -> None:
        self._text = text
        self._spans = spans

    def rows(self, row: ElementRow, indent: str) -> Iterator[str]:
        """Yield the lines of a row, with commas and comments."""
        parted = [slot for slot in row.slots if not slot.line]
        only_lines = True
        for index, slot in enumerate(row.slots):
            element = slot.element
            assert element is not None
            above = _above(slot.head)
            if index == 0 and above[:1] == [""]:
                del above[0]
            behind_line = index > 0 and row.slots[index - 1].line and not slot.line
            first = only_lines and index > 1 if indent else True
            if behind_line and first and above[:1] != [""]:
                above.insert(0, "")
            only_lines = only_lines and slot.line
            yield from (indent + line if line else "" for line in above)
            yield from (indent + comment for comment in self._inside(element))
            *body, last = self._element(element, indent)
            yield from body
            comma = "," if not slot.line and slot is not parted[-1] else ""
            yield f"{last}{comma}{_behind(slot.comment)}"
        foot = _above(row.foot)
        while foot and not foot[-1]:
            foot.pop()
        if not row.slots and foot[:1] == [""]:
            del foot[0]
        yield from (indent + line if line else "" for line in foot)

    def _inside(self, element: Element) -> Iterator[str]:
        """Yield the comments inside an edge, or before the bracket of a state."""
        if element.kind in ("edge", "state"):
            between = self._text[element.key_end : element.value_start]
            yield from (mark[0].rstrip() for mark in _MARK.finditer(between) if mark[0][0] == "/")

    def _element(self, element: Element, indent: str) -> Sequence[str]:
        """Return the lines of one element."""
        text = self._text
        key = text[element.key_start : element.key_end]
        value = text[element.value_start : element.value_end]
        if element.kind == "edge":
            return [f"{indent}{key} -> {value}"]
        if element.kind == "state":
            inside = self._spans.inside(element)
            return self._block(element, inside, f"{indent}{key}: [", "]", indent)
        if element.kind == "branch":
            return self._block(element, element.elements, f"{indent}{{", "}", indent)
        return [f"{indent}# {key}: {_value(value)}"]

    def _block(
        self, element: Element, inside: Sequence[Element], begin: str, end: str, indent: str
    ) -> Sequence[str]:
        row = ElementRow(
            RowFrame(self._text, element.value_start + 1, element.end - 1, inside, "\n")
        )
        lines = [*self.rows(row, indent + _UNIT)]
        if end == "]" and not row.opener.strip() and not any(map(_has_comment, row.slots)):
            if not lines:
                return [f"{begin} {end}"]
            if len(lines) == 1 and len(row.slots) == 1 and not row.slots[0].line:
                return [f"{begin}{lines[0].strip()}{end}"]
        return [f"{begin}{_behind(row.opener)}", *lines, f"{indent}{end}"]


def _has_comment(slot: Slot) -> bool:
    return bool(slot.comment.strip())


def _behind(comment: str) -> str:
    """Return a comment as it follows something on its line, with a space before it."""
    words = comment.strip(" \t,")
    words = words[words.find("//") :].rstrip() if "//" in words else ""
    return f" {words}" if words else ""


def _above(head: str) -> list[str]:
    """Return the comment lines of a head, with one empty line for one or more empty lines."""
    lines: list[str] = []
    breaks = 0
    for mark in _MARK.finditer(head):
        if mark[0][0] != "/":
            breaks += 1
            continue
        if breaks > 1:
            lines.append("")
        lines.append(mark[0].rstrip())
        breaks = 0
    return [*lines, ""] if breaks > 1 else lines


def _value(raw: str) -> str:
    """Return the value of a line, with canonical white space in a map or in JSON."""
    if raw[:1] in ("{", "["):
        tokens = (match[0] for match in _JSON_TOKEN.finditer(raw))
        return "".join({",": ", ", ":": ": "}.get(token, token) for token in tokens)
    if raw[:1] == "(" and is_map(raw):
        pairs = [
            f"{raw[one.key_start : one.key_end]}: {raw[one.value_start : one.value_end]}"
            for one in entries(raw, 0)
        ]
        return f"({', '.join(pairs)})" if pairs else "( )"
    return raw
