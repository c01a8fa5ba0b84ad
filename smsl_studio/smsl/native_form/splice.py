"""Editing a native text: it gets other values, and only what differs is changed.

Row by row, as in the JSON form (see ``arrangement``): what is equal keeps its text to the
character, a rename splices the name, and what is new takes the layout of its neighbours. Comments
stay, but for those inside of what is removed and on its line. What was written as an element whose
name begins with ``_`` becomes a ``# _KEY`` line when its value changes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any

from smsl_studio.smsl.document import Document
from smsl_studio.smsl.document.arrangement import arranged, permuted, survivors
from smsl_studio.smsl.document.likeness import same
from smsl_studio.smsl.json_form.splice import spliced_value
from smsl_studio.smsl.native_form.headers import respelled_header
from smsl_studio.smsl.native_form.parser import parse
from smsl_studio.smsl.native_form.rows import ElementRow, Slot, has_break
from smsl_studio.smsl.native_form.spans import Element, NativeSpans
from smsl_studio.smsl.native_form.spellings import must_be_map, no_spelling
from smsl_studio.smsl.native_form.style import NativeStyle, indent_of, style_of
from smsl_studio.smsl.native_form.tokens import spelled

Json = Any
Map = dict[str, Json]
Change = Callable[[Slot, Json, Json], Json]
"""Writes a new value into a slot that held an old one; gives what it holds afterwards."""


def reconcile(document: Document, values: Mapping[str, Json]) -> Document:
    """A document that reads to ``values``, its text changed only at the elements that differ.

    ConvertError for what has no spelling in the native form. A HEADER with nothing in it says as
    much as none, and is left out.
    """
    if same(document.values, values):
        return document
    text, merged = _NativeSplicer(document).file(dict(values))
    if text == document.text:
        return document
    if document.doubled:
        return parse(text, document.file)
    return replace(document, text=text, values=merged)


class _NativeSplicer:
    """Writes the rows of one document anew, reusing every piece of text that still holds."""

    def __init__(self, document: Document) -> None:
        self._document = document
        self._text = document.text
        spans = document.spans
        self._spans = spans if isinstance(spans, NativeSpans) else NativeSpans(self._text)

    @cached_property
    def _style(self) -> NativeStyle:
        return style_of(self._document, self._spans)

    def file(self, new: Map) -> tuple[str, Map]:
        """The text of the file for the new values, and these in the order of the text."""
        text = self._text
        start = 1 if text.startswith("\ufeff") else 0
        newline = self._document.newline
        row = ElementRow(text, start, len(text), self._spans.elements, newline, outermost=True)
        if row.commas is None:
            row.commas = self._style.branch_commas

        def fresh(key: str, value: Json, indent: str) -> str:
            """The text of a new member of the file: a ``_`` field or an SB."""
            if key.startswith("_"):
                return self._style.field(key, value)
            return self._style.branch(key, value, indent)

        merged = self._members(
            row, list(row.slots), (dict(self._document.values), new), "", self._branch_value, fresh
        )
        merged = {
            key: value if key[:1] == "_" else _as_read(value) for key, value in merged.items()
        }
        return text[:start] + row.whole("", None), merged

    def _branch_value(self, slot: Slot, old: Json, new: Json) -> Json:
        branch = slot.element
        assert branch is not None
        if slot.key.startswith("_"):
            return self._field_value(slot, old, new)
        must_be_map((slot.key,), new, "a State Branch")
        slot.text, merged = self._branch(branch, slot.key, old, new)
        return merged

    def _branch(self, branch: Element, name: str, old: Map, new: Map) -> tuple[str, Map]:
        text = self._text
        start, end = branch.start + 1, branch.end - 1
        row = ElementRow(text, start, end, branch.elements, self._document.newline)
        outer = indent_of(text, branch.start)
        indent = row.indent(outer + self._style.unit)
        if row.commas is None:
            row.commas = self._style.state_commas
        for slot in row.slots:
            if slot.element and slot.element.kind == "name":
                _respell_key(slot, branch.key, name, value=True)
        header, changed = old.get("HEADER", {}), new.get("HEADER", {})
        must_be_map((name, "HEADER"), changed, "a HEADER")
        if not same(header, changed):
            changed = self._header(row, name, header, changed, indent)
        merged = {"HEADER": changed if not same(header, changed) else header} if changed else {}

        def fresh(key: str, value: Json, indent: str) -> str:
            """The text of a new member of the SB: a ``_`` field or a state."""
            if key.startswith("_"):
                return self._style.field(key, value)
            return self._style.state(name, key, value, indent)

        def state_value(slot: Slot, old: Json, new: Json) -> Json:
            """Change the text of one state of this SB; the values that it holds afterwards."""
            return self._state_value(name, slot, old, new)

        slots = [s for s in row.slots if s.element and s.element.kind in ("state", "field")]
        members, after = _without_header(old), _without_header(new)
        merged |= self._members(row, slots, (members, after), indent, state_value, fresh)
        return "{" + row.whole(indent, outer) + "}", merged

    def _header(self, row: ElementRow, branch: str, old: Map, new: Map, indent: str) -> Map:
        """Bring the header lines of a branch to the new values; their order is free."""
        kept = survivors(old, new)
        lines = [slot.element is not None and slot.element.kind == "header" for slot in row.slots]
        row.remove(
            [not line or slot.key in kept for slot, line in zip(row.slots, lines, strict=True)]
        )
        merged: Map = {}
        slots = list(row.slots)
        last = 0
        latest = {s.key: s for s in slots if s.element and s.element.kind == "header"}
        for index, slot in enumerate(slots):
            if slot.element is None or slot.element.kind not in ("header", "name"):
                continue
            last = index + 1
            if slot.element.kind == "name":
                continue
            now = kept[slot.key]
            wins = latest[slot.key] is slot
            before = old[slot.key]
            respelled_header(slot, self._text, branch, now, before, new[now] if wins else before)
            if wins:
                merged[now] = before if same(before, new[now]) else new[now]
            slot.key = now
        fresh = [key for key in new if key not in merged]
        slots[last:last] = [
            Slot(key, None, self._style.header(branch, key, new[key]), True) for key in fresh
        ]
        row.fill(slots, indent)
        return merged | {key: new[key] for key in fresh}

    def _state_value(self, branch: str, slot: Slot, old: Json, new: Json) -> Json:
        state = slot.element
        assert state is not None
        if slot.key.startswith("_"):
            return self._field_value(slot, old, new)
        must_be_map((branch, slot.key), new, "a state")
        text, inside = self._text, self._spans.inside(state)
        brackets = text[state.value_start : state.value_end]
        outer = indent_of(text, state.start)
        plain = not has_break(brackets) and len(inside) == len(old)
        if plain and (not inside or any(key[:1] == "_" and key not in old for key in new)):
            brackets = self._style.brackets(branch, slot.key, new, outer)
            slot.text = slot.text[: state.value_start - state.end] + brackets
            return new
        start, end = state.value_start + 1, state.value_end - 1
        row = ElementRow(text, start, end, inside, self._document.newline)
        if row.commas is None:
            row.commas = self._style.edge_commas
        indent = row.indent(outer + self._style.unit)

        def fresh(key: str, value: Json, indent: str) -> str:
            """The text of a new member of the state: a ``_`` field or an operation."""
            if key.startswith("_"):
                return self._style.field(key, value)
            return self._style.edge(branch, slot.key, key, value)

        def target(edge: Slot, old: Json, new: Json) -> Json:
            """Change the target of one operation; ConvertError where it is not a name."""
            if edge.key.startswith("_"):
                return self._field_value(edge, old, new)
            if type(new) is not str:
                why = "its target is not the name of a state"
                raise no_spelling((branch, slot.key, edge.key), why)
            found = edge.element
            assert found is not None
            edge.text = edge.text[: found.value_start - found.end or None] + spelled(new)
            return new

        merged = self._members(row, list(row.slots), (old, new), indent, target, fresh)
        head = slot.text[: state.value_start - state.end]
        inner = row.whole(indent, outer)
        blank = not row.slots and not inner.strip() and not has_break(inner)
        slot.text = head + (self._style.empty if blank else f"[{inner}]")
        return merged

    def _field_value(self, slot: Slot, old: Json, new: Json) -> Json:
        """A ``# _KEY`` line with another value, or in the place of an odd element."""
        found = slot.element
        assert found is not None
        if found.kind != "field":
            slot.text, slot.line, slot.commas = self._style.field(slot.key, new), True, ""
            return new
        value = self._text[found.value_start : found.value_end]
        slot.text = slot.text[: len(slot.text) - len(value)] + spliced_value(value, old, new)
        return new

    def _members(
        self,
        row: ElementRow,
        slots: list[Slot],
        maps: tuple[Map, Map],
        indent: str,
        change: Change,
        fresh: Callable[[str, Json, str], str],
    ) -> Map:
        """Bring those slots of a row that are its members from the old values to the new ones."""
        old, new = maps
        kept = survivors(old, new)
        latest = {slot.key: slot for slot in slots}
        for slot in slots:
            slot.wins = latest[slot.key] is slot
        mine = {id(slot) for slot in slots}
        row.remove([id(slot) not in mine or slot.key in kept for slot in row.slots])
        back = {now: was for was, now in kept.items()}
        for slot in row.slots:
            if id(slot) in mine and kept[slot.key] != slot.key:
                _respell_key(slot, slot.key, kept[slot.key])
                slot.key = kept[slot.key]
        places = [index for index, slot in enumerate(row.slots) if id(slot) in mine]
        keys = [row.slots[place].key for place in places]
        added: set[int] = set()
        if keys != list(new):
            row.permute(places, permuted(keys, new))
            keys = [row.slots[place].key for place in places]
            added = self._fill(row, places, keys, new, indent, fresh)
        else:
            row.settle()
        merged: Map = {}
        for slot in row.slots:
            if id(slot) in added:
                merged[slot.key] = new[slot.key]
            elif id(slot) in mine and slot.wins:
                before = old[back[slot.key]]
                after = new[slot.key]
                merged[slot.key] = before if same(before, after) else change(slot, before, after)
            elif id(slot) in mine:
                merged.setdefault(slot.key, None)
        return merged

    def _fill(
        self,
        row: ElementRow,
        places: list[int],
        keys: list[str],
        new: Map,
        indent: str,
        fresh: Callable[[str, Json, str], str],
    ) -> set[int]:
        """Put new members into a row, each behind the one it follows; which slots are theirs."""
        slots: list[Slot] = []
        old, done = row.slots, 0
        waiting: list[Slot] = []
        for placed in arranged(keys, new):
            if placed.slot is None:
                key = placed.key
                text = fresh(key, new[key], indent)
                waiting.append(Slot(key, None, text, key.startswith("_")))
                continue
            place = places[placed.slot]
            if done and waiting:  # behind the member before, and before what follows that
                slots += waiting
                waiting = []
            slots += old[done:place]
            slots += waiting
            waiting = []
            slots.append(old[place])
            done = place + 1
        if not places:
            slots, done = list(old), len(old)
        slots += waiting
        slots += old[done:]
        row.fill(slots, indent)
        return {id(slot) for slot in slots} - {id(slot) for slot in old}


def _without_header(values: Map) -> Map:
    return {key: value for key, value in values.items() if key != "HEADER"}


def _as_read(branch: Map) -> Map:
    """A branch as it reads from a text: HEADER first, and only with something in it."""
    if "HEADER" not in branch or (branch["HEADER"] and next(iter(branch)) == "HEADER"):
        return branch
    rest = _without_header(branch)
    return {"HEADER": branch["HEADER"], **rest} if branch["HEADER"] else rest


def _respell_key(slot: Slot, old: str, new: str, value: bool = False) -> None:
    """Write another name into an element (the value of a NAME line where ``value`` says so)."""
    found = slot.element
    if found is None or old == new:
        return
    start, end = (found.value_start, found.value_end) if value else (found.key_start, found.key_end)
    at, behind = start - found.start, end - found.start
    slot.text = slot.text[:at] + spelled(new) + slot.text[behind:]
