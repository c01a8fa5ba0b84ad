"""Gives one State Branch of a native text other values: which pieces of the text are replaced.

Only the stretches of elements that differ are examined (see ``document.stretches``). Their
neighbours show how elements are separated there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

from smsl_studio.smsl.document.arrangement import survivors
from smsl_studio.smsl.document.likeness import same
from smsl_studio.smsl.document.pieces import Piece
from smsl_studio.smsl.document.stretches import Stretch, differing, stretches, whole
from smsl_studio.smsl.native_form.elements import Element, ElementShape, ElementShapes, PlacedShapes
from smsl_studio.smsl.native_form.headers import respelled_header
from smsl_studio.smsl.native_form.members import Map, MemberSplicer, respell_key
from smsl_studio.smsl.native_form.rows import ElementRow, RowFrame, Slot
from smsl_studio.smsl.native_form.spans import elements_between
from smsl_studio.smsl.native_form.spellings import must_be_map
from smsl_studio.smsl.native_form.style import indent_of

Json = Any


class _Change(NamedTuple):
    """The elements from ``begin`` to ``end``, and the new text in their place."""

    begin: int
    end: int
    piece: Piece


class BranchSplice:
    """One SB that gets other values under a name. ``maps`` are the values before and after.

    ``pieces`` are the replaced pieces of the text. ``values`` are the values as they are in the new
    text. ``shapes`` are the elements of the SB.
    """

    def __init__(
        self,
        splicer: MemberSplicer,
        branch: Element,
        shapes: ElementShapes,
        name: str,
        maps: tuple[Map, Map],
    ) -> None:
        self._splicer, self._branch, self._shapes, self._name = splicer, branch, shapes, name
        self._elements = PlacedShapes(shapes, branch.start + 1)
        inside = (splicer.text, branch.start + 1, branch.end - 1)
        self._frame = RowFrame(*inside, self._elements, splicer.newline)
        self._outer = indent_of(splicer.text, branch.start)
        self._indent = self._frame.indent(lambda: self._outer + splicer.style.unit)
        self._changes: list[_Change] = []
        self._header_before, self._header = (one.get("HEADER", {}) for one in maps)
        must_be_map((name, "HEADER"), self._header, "a HEADER")
        self._other_header = not same(self._header_before, self._header)
        members = self._spliced(*map(_without_header, maps))
        if same(self._header_before, self._header):
            self._header = self._header_before
        self.values = {"HEADER": self._header, **members} if self._header else members
        self._changes.sort()

    @property
    def pieces(self) -> list[Piece]:
        """The replaced pieces of the text, in order."""
        return [change.piece for change in self._changes]

    def shape_after(self, text: str, grown: int, former: ElementShape) -> ElementShape:
        """Return the shape of the SB in the new text, which has ``grown`` more characters before
        it.
        """
        start = self._branch.start + grown
        patches = []
        for begin, end, piece in self._changes:
            before = self._elements[begin - 1].end if begin else self._branch.start + 1
            first = piece.start + grown
            found = elements_between(text, first, first + len(piece.text))
            patches.append((begin, end, ElementShapes.of(found, before + grown)))
            grown += piece.growth
        inner = self._shapes.patched(patches)
        length = self._branch.end + grown - start
        name = next(one for one in PlacedShapes(inner, 1) if one.kind == "name")
        return former._replace(
            length=length,
            key_start=name.value_start,
            key_end=name.value_end,
            value_end=length,
            inner=inner,
        )

    # which elements -----------------------------------------------------------------------------

    def _spliced(self, old: Map, new: Map) -> Map:
        """Find the replaced pieces. Return the members with their values as they are in the new
        text.
        """
        keys, places = self._shapes.keys, self._shapes.members
        before, after, wanted = list(old.values()), list(new.values()), list(new)
        parts = self._parts(list(old), wanted, before, after)
        changed: Map = {}
        for index, to in _kept(parts, before, after):
            value = self._one(places[index], before[index], after[to])
            changed[keys[index]] = value
        order: list[str] = []
        at = 0
        for part in parts:
            found = self._several(part, old, {k: new[k] for k in wanted[part.first : part.last]})
            order += (*keys[at : part.begin], *found)
            changed |= found
            at = part.end
        order += keys[at:]
        if order == wanted:
            return {**new, **changed}
        return {key: changed[key] if key in changed else new[key] for key in order}

    def _parts(
        self, old: list[str], wanted: list[str], before: list[Json], after: list[Json]
    ) -> list[Stretch]:
        """Return the stretches of members that are written anew, with their neighbours."""
        keys, places = self._shapes.keys, self._shapes.members
        lines_first = not places or len(self._elements) - places[0] == len(places)
        if keys != old or self._name != self._branch.key or not lines_first:
            return [whole(keys, wanted)]
        parts = stretches(keys, wanted)
        # A state whose name begins with _ becomes a # line.
        odd = [
            Stretch(index, index + 1, to, to + 1)
            for index, to in _kept(parts, before, after)
            if keys[index][:1] == "_" and self._shapes.shapes[places[index]].kind != "field"
        ]
        header = [Stretch(0, 0, 0, 0)] if self._other_header else []
        return _with_neighbours(sorted([*header, *parts, *odd]), len(keys))

    def _one(self, index: int, old: Json, new: Json) -> Json:
        """Give an element that keeps its place another value. Return the value as it is in the new
        text.
        """
        if same(old, new):
            return old
        element = self._elements[index]
        slot = Slot(element.key, element, self._splicer.text[element.start : element.end], False)
        after = self._splicer.state_value(self._name, slot, old, new)
        piece = Piece(element.start, element.end, slot.text)
        self._changes.append(_Change(index, index + 1, piece))
        return after

    def _several(self, part: Stretch, old: Map, new: Map) -> Map:
        """Replace some members by others, or by the same in another order.

        Return these members as they are in the new text.
        """
        keys, places, splicer = self._shapes.keys, self._shapes.members, self._splicer
        begin = places[part.begin] if part.begin else 0
        end = len(self._elements) if part.end == len(keys) else places[part.end - 1] + 1
        row = ElementRow(self._frame, begin, end)
        if row.commas is None:
            row.commas = splicer.style.state_commas
        if not begin:
            for slot in row.slots:
                if slot.element and slot.element.kind == "name":
                    respell_key(slot, self._branch.key, self._name, value=True)
            if self._other_header:
                self._header = self._bring_header(row)

        def fresh(key: str, value: Json, indent: str) -> str:
            """Return the text of a new member of the SB: a ``_`` field or a state."""
            if key.startswith("_"):
                return splicer.style.field(key, value)
            return splicer.style.state(self._name, key, value, indent)

        def state_value(slot: Slot, old: Json, new: Json) -> Json:
            """Change the text of one state of this SB. Return its values as they are in the new
            text.
            """
            return splicer.state_value(self._name, slot, old, new)

        slots = [slot for slot in row.slots if slot.element and slot.element.is_member]
        maps = {key: old[key] for key in keys[part.begin : part.end]}, new
        merged = splicer.members(row, slots, maps, self._indent, state_value, fresh)
        closing = self._outer if end == len(self._elements) else None
        piece = Piece(row.start, row.end, row.whole(self._indent, closing))
        self._changes.append(_Change(begin, end, piece))
        return merged

    def _bring_header(self, row: ElementRow) -> Map:
        """Change the header lines to the new values. Lines that are already there keep their
        order.
        """
        old, new, branch, style = self._header_before, self._header, self._name, self._splicer.style
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
            respelled_header(
                slot, self._splicer.text, branch, now, before, new[now] if wins else before
            )
            if wins:
                merged[now] = before if same(before, new[now]) else new[now]
            slot.key = now
        fresh = [key for key in new if key not in merged]
        slots[last:last] = [
            Slot(key, None, style.header(branch, key, new[key]), True) for key in fresh
        ]
        row.fill(slots, self._indent)
        return merged | {key: new[key] for key in fresh}


def _kept(
    parts: Sequence[Stretch], before: Sequence[Json], after: Sequence[Json]
) -> Iterator[tuple[int, int]]:
    """Yield the indices, before and after, of members outside of the stretches whose values
    differ.
    """
    at = to = 0
    for part in (*parts, Stretch(len(before), len(before), len(after), len(after))):
        for offset in differing(before[at : part.begin], after[to : part.first]):
            yield at + offset, to + offset
        at, to = part.end, part.last


def _with_neighbours(parts: Iterable[Stretch], count: int) -> list[Stretch]:
    """Return stretches that include up to two members before each, and one after it.

    Stretches that then overlap become one.
    """
    merged: list[Stretch] = []
    for part in parts:
        begin, end = max(0, part.begin - 2), min(count, part.end + 1)
        first, last = part.first - part.begin + begin, part.last - part.end + end
        if merged and (begin < merged[-1].end or not begin):
            former = merged.pop()
            begin, first = former.begin, former.first
            end, last = max(end, former.end), max(last, former.last)
        merged.append(Stretch(begin, end, first, last))
    return merged


def _without_header(branch: Map) -> Map:
    rest = dict(branch)
    rest.pop("HEADER", None)
    return rest
