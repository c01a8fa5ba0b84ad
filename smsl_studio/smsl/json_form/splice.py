"""Editing a JSON text: it gets other values, and only what differs is changed.

Object by object: ``_`` keys and a branch's HEADER keep their slot, other keys follow the order of
the new values (but for those in a HEADER, whose order means nothing). A key that goes and one that
comes in the same gap are a rename: the key is spliced, then its value is reconciled. What is equal
keeps its text to the character, and what is new takes the separators and indentation of its
neighbours.

A key that is written twice stays written twice: its last, winning value is the one that changes;
where it is removed, renamed or moved all its occurrences are.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from smsl_studio.smsl.document import Document, Member
from smsl_studio.smsl.document.arrangement import Placed, aligned, arranged, permuted, survivors
from smsl_studio.smsl.document.likeness import same
from smsl_studio.smsl.json_form.reader import parse
from smsl_studio.smsl.json_form.spans import JsonSpans, skip_space
from smsl_studio.smsl.json_form.style import JsonStyle, render, scalar, style_of

Json = Any


def reconcile(document: Document, values: Mapping[str, Json]) -> Document:
    """A document that reads to ``values``, its text changed only at the elements that differ."""
    if same(document.values, values):
        return document
    text = document.text
    splicer = _JsonSplicer(document)
    root = splicer.spans.root
    body, merged = splicer.container(root, dict(document.values), dict(values), 0)
    changed = text[:root] + body + text[splicer.spans.end_of(root) :]
    if changed == text:
        return document
    if document.doubled:
        return parse(changed, document.file)
    return Document(changed, document.file, document.form, merged, JsonSpans)


def keep_winner(document: Document, path: tuple[str, ...]) -> Document:
    """The document with the doubled key at ``path`` written once.

    The last, winning member takes the place of the first, because order has meaning: the
    document reads to the same values in the same order. KeyError where no such key stands.
    """
    return parse(winner_kept(document.text, path), document.file)


def winner_kept(text: str, path: tuple[str, ...]) -> str:
    """A JSON text with the doubled key at ``path`` written once; see ``keep_winner``."""
    members = JsonSpans(text).members(path[:-1])
    same_key = [index for index, member in enumerate(members) if member.key == path[-1]]
    if not same_key:
        raise KeyError(path)
    first, winner = members[same_key[0]], members[same_key[-1]]
    winning = text[winner.key_start : winner.value_end]
    for index in reversed(same_key[1:]):
        start, end = members[index - 1].value_end, members[index].value_end
        text = text[:start] + text[end:]
    return text[: first.key_start] + winning + text[first.value_end :]


def spliced_value(text: str, old: Json, new: Json) -> str:
    """The text of one JSON value on one line, changed only where it differs from the old one."""
    colon = ":" if '":' in text and '": ' not in text else ": "
    style = JsonStyle(unit="", colon=colon, comma="," if colon == ":" else ", ", inline_from=0)
    splicer = _JsonSplicer(Document(text, "", "json", {}, JsonSpans), style)
    return splicer.whole(old, new)


@dataclass(slots=True)
class _Slot:
    """One member of the object that is being written: an old one, or a new one (no member)."""

    key: str
    member: Member | None
    gap: str | None = None
    """What stands between this slot and the next."""
    wins: bool = True


class _JsonSplicer:
    """Writes the objects of one document anew, reusing every piece of text that still holds."""

    def __init__(self, document: Document, style: JsonStyle | None = None) -> None:
        self._document = document
        self._text = document.text
        self._given = style
        self.spans = JsonSpans(document.text)

    @cached_property
    def _style(self) -> JsonStyle:
        return self._given or style_of(self._document)

    def whole(self, old: Json, new: Json) -> str:
        """The value that is all of the text, as text; no member of it is called HEADER."""
        slot = _Slot("", Member("", 0, 0, 0, len(self._text)))
        return self._value(slot, old, new, "", 2)[1]

    def container(
        self, start: int, old: dict[str, Json], new: dict[str, Json], depth: int, free: bool = False
    ) -> tuple[str, dict[str, Json]]:
        """The text of the object (or list) at ``start`` for the new values, and these in order.

        Where the order of an object's keys is ``free``, they stay in that of the text.
        """
        members = self.spans.scan(start)
        end = self.spans.end_of(start) - 1
        header = "HEADER" if depth == 1 else ""
        kept = survivors(old, new, header)
        slots = self._old_slots(members, kept)
        lead, trail, gap = self._frame(start, end, members, depth)
        if [slot.key for slot in slots] != list(new):
            if not free:
                slots = _permuted(slots, permuted([slot.key for slot in slots], new, header))
            slots = _filled(slots, arranged([slot.key for slot in slots], new, header), gap)
        below = lead.rpartition(self._document.newline)[2]
        indent = below if self._document.newline in lead else self._indent(start)
        pieces, merged = [self._text[start]], {}
        if slots:
            pieces.append(lead)
        back = {now: was for was, now in kept.items()}
        for index, slot in enumerate(slots):
            former = old.get(back.get(slot.key, ""))
            value, text = self._value(slot, former, new[slot.key], indent, depth)
            if slot.wins:
                merged[slot.key] = value
            pieces.append(self._key(slot, back) if self._text[start] == "{" else "")
            pieces.append(text)
            pieces.append((slot.gap or gap) if index + 1 < len(slots) else "")
        pieces.append(trail)
        pieces.append(self._text[end])
        return "".join(pieces), merged

    def _key(self, slot: _Slot, back: Mapping[str, str]) -> str:
        member = slot.member
        if member is None:
            return scalar(slot.key) + self._style.colon
        text = self._text
        if back[slot.key] != slot.key:
            return scalar(slot.key) + text[member.key_end : member.value_start]
        return text[member.key_start : member.value_start]

    def _value(
        self, slot: _Slot, former: Json, value: Json, indent: str, depth: int
    ) -> tuple[Json, str]:
        """What the slot holds afterwards, and its text; ``former`` is what it held."""
        member = slot.member
        if member is None:
            return value, render(value, self._style, indent, depth + 1)
        if not slot.wins or same(former, value):
            return former, self._text[member.value_start : member.value_end]
        if isinstance(former, dict) and isinstance(value, dict):
            free = depth == 1 and slot.key == "HEADER"
            text, merged = self.container(member.value_start, former, value, depth + 1, free)
            return merged, text
        if isinstance(former, list) and isinstance(value, list):
            return value, self._list(member.value_start, former, value, depth + 1)
        return value, render(value, self._style, indent, depth + 1)

    def _list(self, start: int, old: list[Json], new: list[Json], depth: int) -> str:
        """A list is written as an object whose keys are the places of its old elements."""
        before = {str(index): value for index, value in enumerate(old)}
        after = dict(zip(aligned(old, new), new, strict=True))
        return self.container(start, before, after, depth)[0]

    def _old_slots(self, members: tuple[Member, ...], kept: Mapping[str, str]) -> list[_Slot]:
        last = {member.key: index for index, member in enumerate(members)}
        slots = []
        for index, member in enumerate(members):
            if member.key not in kept:
                continue
            following = members[index + 1].key_start if index + 1 < len(members) else None
            gap = None if following is None else self._text[member.value_end : following]
            slots.append(_Slot(kept[member.key], member, gap, last[member.key] == index))
        return slots

    def _frame(
        self, start: int, end: int, members: tuple[Member, ...], depth: int
    ) -> tuple[str, str, str]:
        """What stands before the first member, after the last, and between two new ones."""
        text, newline = self._text, self._document.newline
        if members:
            lead = text[start + 1 : members[0].key_start]
            trail = text[members[-1].value_end : end]
            if len(members) > 1:
                return lead, trail, text[members[-2].value_end : members[-1].key_start]
            return lead, trail, "," + lead if newline in lead else self._style.comma
        inside = text[start + 1 : end]
        if newline in inside or (depth < self._style.inline_from and text[start] == "{"):
            indent = self._indent(start)
            lead = newline + indent + self._style.unit
            return lead, inside if newline in inside else newline + indent, "," + lead
        return inside[:1], inside[:1], self._style.comma

    def _indent(self, at: int) -> str:
        """The white space that the line of ``at`` begins with."""
        start = self._text.rfind(self._document.newline, 0, at) + len(self._document.newline)
        if start < len(self._document.newline):
            return ""
        return self._text[start : skip_space(self._text, start)]


def _permuted(slots: list[_Slot], contents: list[int]) -> list[_Slot]:
    """The slots with the contents of others; the gaps stay where they are."""
    return [
        _Slot(slots[content].key, slots[content].member, slot.gap, slots[content].wins)
        for slot, content in zip(slots, contents, strict=True)
    ]


def _filled(slots: list[_Slot], row: list[Placed], gap: str) -> list[_Slot]:
    """The slots in their row, with new ones that take the gap of the one they are near."""
    return [
        slots[placed.slot]
        if placed.slot is not None
        else _Slot(
            placed.key, None, (slots[placed.near].gap if placed.near is not None else None) or gap
        )
        for placed in row
    ]
