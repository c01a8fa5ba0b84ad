"""Writes a doubled key once."""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.smsl.document import Document, Member, Path
from smsl_studio.smsl.json_form.splice import winner_kept
from smsl_studio.smsl.native_form.elements import Element
from smsl_studio.smsl.native_form.lines import entries
from smsl_studio.smsl.native_form.parser import parse
from smsl_studio.smsl.native_form.rows import ElementRow, RowFrame
from smsl_studio.smsl.native_form.spans import NativeSpans, in_values
from smsl_studio.smsl.native_form.style import indent_of


def keep_winner(document: Document, path: Path) -> Document:
    """Return the document with the doubled key at ``path`` written once.

    The last member counts. It takes the place of the first, because order has meaning. KeyError if
    there is no such key.
    """
    return parse(_Winning(document).without_losers(path), document.file)


class _Winning:
    def __init__(self, document: Document) -> None:
        self._document = document
        self._text = document.text
        self._spans = NativeSpans(document.text)

    def without_losers(self, path: Path) -> str:
        """Return the text with the doubled key at ``path`` written once."""
        text, spans = self._text, self._spans
        if len(path) == 1:
            start = 1 if text.startswith("\ufeff") else 0
            return self._row(start, len(text), spans.elements, spans.elements, path[0])
        branch = _last(spans.elements, path[0])
        if branch.kind != "branch":
            return self._in_value(branch.member, path[1:])
        start, end, inside = branch.start + 1, branch.end - 1, branch.elements
        members: Sequence[Element] = in_values(inside)
        rest = path[1:]
        if path[1] == "HEADER":
            members, rest = [one for one in inside if one.kind == "header"], path[2:]
        if len(rest) == 1:
            return self._row(start, end, inside, members, rest[0])
        state = _last(members, rest[0])
        if state.kind != "state":
            return self._in_value(state.member, rest[1:])
        edges = spans.inside(state)
        if len(rest) == 2:
            return self._row(state.value_start + 1, state.end - 1, edges, edges, rest[1])
        return self._in_value(_last(edges, rest[1]).member, rest[2:])

    def _row(
        self,
        start: int,
        end: int,
        elements: Sequence[Element],
        members: Sequence[Element],
        key: str,
    ) -> str:
        text, newline = self._text, self._document.newline
        mine = {element.start for element in members if element.key == key}
        outermost = elements is self._spans.elements
        row = ElementRow(RowFrame(text, start, end, elements, newline, outermost))
        same_key = [slot for slot in row.slots if slot.element and slot.element.start in mine]
        if not same_key:
            raise KeyError(key)
        first, losers = same_key[0], same_key[1:]
        if losers:
            first.take(losers[-1])
        row.remove([slot not in losers for slot in row.slots])
        row.settle()
        closing = None if row.outermost else indent_of(text, start)
        unit = "" if row.outermost else indent_of(text, elements[0].start)
        return text[:start] + row.whole(row.indent(unit), closing) + text[end:]

    def _in_value(self, member: Member, path: Path) -> str:
        text = self._text
        value = text[member.value_start : member.value_end]
        if value.startswith("("):
            value = _map_without_losers(value, path)
        else:
            value = winner_kept(value, path)
        return text[: member.value_start] + value + text[member.value_end :]


def _map_without_losers(written: str, path: Path) -> str:
    members = [member for member in entries(written, 0) if (member.key,) == path]
    if not members:
        raise KeyError(path)
    winner = written[members[-1].key_start : members[-1].value_end]
    for loser in reversed(members[1:]):
        before = written[: loser.key_start].rstrip(", \t")
        written = before + written[loser.value_end :]
    first = members[0]
    return written[: first.key_start] + winner + written[first.value_end :]


def _last(elements: Sequence[Element], key: str) -> Element:
    for element in reversed(elements):
        if element.key == key:
            return element
    raise KeyError(key)
