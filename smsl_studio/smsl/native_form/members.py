"""Gives the members of one container of a native text other values: states, fields, edges."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

from smsl_studio.smsl.document import Document
from smsl_studio.smsl.document.arrangement import arranged, permuted, survivors
from smsl_studio.smsl.document.likeness import same
from smsl_studio.smsl.json_form.splice import spliced_value
from smsl_studio.smsl.native_form.rows import ElementRow, RowFrame, Slot, has_break
from smsl_studio.smsl.native_form.spans import NativeSpans
from smsl_studio.smsl.native_form.spellings import must_be_map, no_spelling
from smsl_studio.smsl.native_form.style import NativeStyle, indent_of, style_of
from smsl_studio.smsl.native_form.tokens import spelled

Json = Any
Map = dict[str, Json]
Change = Callable[[Slot, Json, Json], Json]
"""Writes a new value into a slot with an old one. Returns the value as it is in the new text."""


class MemberSplicer:
    """Writes members of one document anew, and keeps every piece of text that is still valid."""

    def __init__(self, document: Document) -> None:
        spans = document.spans
        assert isinstance(spans, NativeSpans)
        self.text, self.newline, self.spans = document.text, document.newline, spans
        self._document = document

    @cached_property
    def style(self) -> NativeStyle:
        """The layout of new elements."""
        return style_of(self._document, self.spans)

    def state_value(self, branch: str, slot: Slot, old: Json, new: Json) -> Json:
        """Change the text of one state of an SB. Return its values as they are in the new text."""
        state = slot.element
        assert state is not None
        if slot.key.startswith("_"):
            return self.field_value(slot, old, new)
        must_be_map((branch, slot.key), new, "a state")
        text, inside = self.text, self.spans.inside(state)
        brackets = text[state.value_start : state.value_end]
        outer = indent_of(text, state.start)
        plain = not has_break(brackets) and len(inside) == len(old)
        if plain and (not inside or any(key[:1] == "_" and key not in old for key in new)):
            brackets = self.style.brackets(branch, slot.key, new, outer)
            slot.text = slot.text[: state.value_start - state.end] + brackets
            return new
        start, end = state.value_start + 1, state.value_end - 1
        row = ElementRow(RowFrame(text, start, end, inside, self.newline))
        if row.commas is None:
            row.commas = self.style.edge_commas
        indent = row.indent(outer + self.style.unit)

        def fresh(key: str, value: Json, indent: str) -> str:
            """Return the text of a new member of the state: a ``_`` field or an operation."""
            if key.startswith("_"):
                return self.style.field(key, value)
            return self.style.edge(branch, slot.key, key, value)

        def target(edge: Slot, old: Json, new: Json) -> Json:
            """Change the target of one operation. ConvertError if it is not a text."""
            if edge.key.startswith("_"):
                return self.field_value(edge, old, new)
            if type(new) is not str:
                why = "its target is not the name of a state"
                raise no_spelling((branch, slot.key, edge.key), why)
            found = edge.element
            assert found is not None
            edge.text = edge.text[: found.value_start - found.end or None] + spelled(new)
            return new

        merged = self.members(row, list(row.slots), (old, new), indent, target, fresh)
        head = slot.text[: state.value_start - state.end]
        inner = row.whole(indent, outer)
        blank = not row.slots and not inner.strip() and not has_break(inner)
        slot.text = head + (self.style.empty if blank else f"[{inner}]")
        return merged

    def field_value(self, slot: Slot, old: Json, new: Json) -> Json:
        """Give a ``# _KEY`` line another value. An element of another kind becomes such a line."""
        found = slot.element
        assert found is not None
        if found.kind != "field":
            slot.text, slot.line, slot.commas = self.style.field(slot.key, new), True, ""
            return new
        value = self.text[found.value_start : found.value_end]
        slot.text = slot.text[: len(slot.text) - len(value)] + spliced_value(value, old, new)
        return new

    def members(
        self,
        row: ElementRow,
        slots: list[Slot],
        maps: tuple[Map, Map],
        indent: str,
        change: Change,
        fresh: Callable[[str, Json, str], str],
    ) -> Map:
        """Change the members of a row from the old values to the new ones. ``slots`` are these
        members.

        Return the values as they are in the new text.
        """
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
                respell_key(slot, slot.key, kept[slot.key])
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
        """Put new members into a row, each after the member that it follows. Return the ids of
        their slots.
        """
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
            if done and waiting:  # New members go directly after the member before them.
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


def respell_key(slot: Slot, old: str, new: str, value: bool = False) -> None:
    """Write another name into an element. ``value`` is true for the value of a NAME line."""
    found = slot.element
    if found is None or old == new:
        return
    start, end = (found.value_start, found.value_end) if value else (found.key_start, found.key_end)
    at, behind = start - found.start, end - found.start
    slot.text = slot.text[:at] + spelled(new) + slot.text[behind:]
