"""The canonical layout of a JSON text: four spaces, one member on each line."""

from __future__ import annotations

from dataclasses import replace

from smsl_studio.smsl.document import Document
from smsl_studio.smsl.json_form.spans import JsonSpans, scan_container

_UNIT = "    "


def tidy(document: Document) -> Document:
    """Return the document in the canonical layout.

    Only white space changes. Names and numbers keep their spelling. Doubled keys, a BOM and the
    kind of line end stay.
    """
    tidier = _JsonTidier(document)
    bom = "\ufeff" if document.text.startswith("\ufeff") else ""
    text = bom + tidier.container(JsonSpans(document.text).root, "") + document.newline
    return document if text == document.text else replace(document, text=text)


class _JsonTidier:
    def __init__(self, document: Document) -> None:
        self._text = document.text
        self._newline = document.newline

    def container(self, start: int, indent: str) -> str:
        """Return the object or list that opens at ``start``, for a line with this indentation."""
        text = self._text
        members = tuple(scan_container(text, start))
        left, right = ("{", "}") if text[start] == "{" else ("[", "]")
        if not members:
            return left + right
        inner = indent + _UNIT
        items = []
        nested = left == "{"
        for member in members:
            value = text[member.value_start : member.value_end]
            if value[0] in "{[":
                value = self.container(member.value_start, inner)
                nested = nested or len(value) > 2
            key = text[member.key_start : member.key_end]
            items.append(f"{key}: {value}" if left == "{" else value)
        if not nested:
            return f"{left}{', '.join(items)}{right}"
        start_of_line = self._newline + inner
        body = f",{start_of_line}".join(items)
        return f"{left}{start_of_line}{body}{self._newline}{indent}{right}"
