"""The one text edit: make a text read to other values by changing only what differs.

Object by object: ``_`` keys and a branch's HEADER keep their slot, other keys follow the order of
the new values (but for those in a HEADER, whose order means nothing). A key that goes and one that
comes in the same gap are a rename: the key is spliced, then its value is reconciled. What is equal
keeps its text to the character, and what is new takes the separators and indentation of its
neighbours.

A key that is written twice stays written twice: its last, winning value is the one that changes;
where it is removed, renamed or moved all its occurrences are.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from smsl_studio.smsl.document import Document, Member
from smsl_studio.smsl.json_form.reading import parse
from smsl_studio.smsl.json_form.spans import JsonSpans, skip_space
from smsl_studio.smsl.json_form.style import Style, render, scalar, style_of
from smsl_studio.smsl.likeness import same

Json = Any


def reconcile(document: Document, values: Mapping[str, Json]) -> Document:
    """A document that reads to ``values``, its text changed only at the elements that differ."""
    if same(document.values, values):
        return document
    text = document.text
    splicer = _Splicer(document)
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
    members = document.members(path[:-1])
    same_key = [index for index, member in enumerate(members) if member.key == path[-1]]
    if not same_key:
        raise KeyError(path)
    text, winner = document.text, members[same_key[-1]]
    for index in reversed(same_key[1:]):
        start, end = members[index - 1].value_end, members[index].value_end
        text = text[:start] + text[end:]
    first = members[same_key[0]]
    winning = document.text[winner.key_start : winner.value_end]
    text = text[: first.key_start] + winning + text[first.value_end :]
    return parse(text, document.file)


@dataclass(slots=True)
class _Slot:
    """One member of the object that is being written: an old one, or a new one (no member)."""

    key: str
    member: Member | None
    gap: str | None = None
    """What stands between this slot and the next."""
    wins: bool = True


class _Splicer:
    """Writes the objects of one document anew, reusing every piece of text that still holds."""

    def __init__(self, document: Document) -> None:
        self._document = document
        self._text = document.text
        self.spans = JsonSpans(document.text)

    @cached_property
    def _style(self) -> Style:
        return style_of(self._document)

    def container(
        self, start: int, old: dict[str, Json], new: dict[str, Json], depth: int, free: bool = False
    ) -> tuple[str, dict[str, Json]]:
        """The text of the object (or list) at ``start`` for the new values, and these in order.

        Where the order of an object's keys is ``free``, they stay in that of the text.
        """
        members = self.spans.scan(start)
        end = self.spans.end_of(start) - 1
        kept = _kept(old, new, depth)
        slots = self._old_slots(members, kept)
        lead, trail, gap = self._frame(start, end, members, depth)
        if [slot.key for slot in slots] != list(new):
            if not free:
                _permute(slots, new, depth)
            slots = _with_new(slots, kept, new, depth, gap)
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
        after = dict(zip(_aligned(old, new), new, strict=True))
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


def _is_fixed(key: str, depth: int) -> bool:
    return key.startswith("_") or (key == "HEADER" and depth == 1)


def _kept(old: Iterable[str], new: Mapping[str, Json], depth: int) -> dict[str, str]:
    """Which old key lives on under which new key; removed ones are absent."""
    before = list(old)
    known = set(before)
    kept = {key: key for key in before if key in new}
    gone = _by_anchor(before, kept, depth)
    come = _by_anchor(new, known, depth)
    for anchor, removed in gone.items():
        kept.update(zip(removed, come.get(anchor, ()), strict=False))
    return kept


def _by_anchor(
    keys: Iterable[str], anchors: Iterable[str], depth: int
) -> dict[tuple[str | None, bool], list[str]]:
    """The keys that are no anchors, by the anchor of their own kind before them."""
    found: dict[tuple[str | None, bool], list[str]] = {}
    latest: dict[bool, str | None] = {True: None, False: None}
    known = set(anchors)
    for key in keys:
        fixed = _is_fixed(key, depth)
        if key in known:
            latest[fixed] = key
        else:
            found.setdefault((latest[fixed], fixed), []).append(key)
    return found


def _permute(slots: list[_Slot], new: Mapping[str, Json], depth: int) -> None:
    """Bring the movable slots into the order of the new values; the gaps stay where they are."""
    places = [index for index, slot in enumerate(slots) if not _is_fixed(slot.key, depth)]
    present = dict.fromkeys(slots[index].key for index in places)
    if all(a == b for a, b in zip(present, (k for k in new if k in present), strict=True)):
        return
    order = {key: index for index, key in enumerate(new)}
    moved = sorted((slots[index] for index in places), key=lambda slot: order[slot.key])
    contents = [(slot.key, slot.member, slot.wins) for slot in moved]
    for index, (key, member, wins) in zip(places, contents, strict=True):
        slots[index] = _Slot(key, member, slots[index].gap, wins)


def _with_new(
    slots: list[_Slot], kept: Mapping[str, str], new: Mapping[str, Json], depth: int, gap: str
) -> list[_Slot]:
    """The slots with the new keys put in, each behind the key it follows in the new values."""
    present = set(kept.values())
    after: dict[str, list[str]] = {}
    first_movable: list[str] = []
    first: list[str] = []
    movable: str | None = None
    previous: str | None = None
    for key in new:
        fixed = _is_fixed(key, depth)
        if key not in present:
            if fixed and key != "HEADER":
                (first if previous is None else after.setdefault(previous, [])).append(key)
            elif fixed:
                first_movable.insert(0, key)
            else:
                (first_movable if movable is None else after.setdefault(movable, [])).append(key)
        previous = key
        movable = movable if fixed else key
    result: list[_Slot] = []
    seen: set[str] = set()
    begin = _begin_of_movable(slots, depth)
    _put(result, first, after, gap)
    for index, slot in enumerate(slots):
        if index == begin:
            _put(result, first_movable, after, slot.gap or gap)
        result.append(slot)
        if slot.key not in seen:
            seen.add(slot.key)
            _put(result, after.get(slot.key, []), after, slot.gap or gap)
    if begin == len(slots):
        _put(result, first_movable, after, gap)
    return result


def _begin_of_movable(slots: list[_Slot], depth: int) -> int:
    """The index of the first movable slot; behind HEADER or at the end where there is none."""
    for index, slot in enumerate(slots):
        if not _is_fixed(slot.key, depth):
            return index
    for index, slot in enumerate(slots):
        if slot.key == "HEADER":
            return index + 1
    return len(slots)


def _put(result: list[_Slot], keys: list[str], after: Mapping[str, list[str]], gap: str) -> None:
    """Add new slots, and behind each those that follow it."""
    waiting = keys[::-1]
    while waiting:
        key = waiting.pop()
        result.append(_Slot(key, None, gap))
        waiting.extend(reversed(after.get(key, [])))


def _aligned(old: list[Json], new: list[Json]) -> list[str]:
    """For each new element the place of the old one it continues, or a key of its own."""
    shorter = min(len(old), len(new))
    head = 0
    while head < shorter and same(old[head], new[head]):
        head += 1
    tail = 0
    while tail < shorter - head and same(old[-1 - tail], new[-1 - tail]):
        tail += 1
    middle = range(head, len(new) - tail)
    return [
        *map(str, range(head)),
        *(str(index) if index < len(old) - tail else f"new {index}" for index in middle),
        *map(str, range(len(old) - tail, len(old))),
    ]
