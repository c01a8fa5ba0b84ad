"""Gives one object or list of a JSON text other values: which pieces of the text are replaced.

Unchanged members cost nothing. The rows of keys are compared as a whole (see ``stretches``), and
only differing members are examined.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from smsl_studio.smsl.document import Document, Member, Path
from smsl_studio.smsl.document.arrangement import Placed, aligned, arranged, permuted, survivors
from smsl_studio.smsl.document.likeness import same
from smsl_studio.smsl.document.pieces import Piece, spliced
from smsl_studio.smsl.document.stretches import Stretch, differing, stretches, whole
from smsl_studio.smsl.json_form.spans import JsonSpans, MemberRow, SpanPart, skip_space
from smsl_studio.smsl.json_form.style import JsonStyle, render, scalar, style_of

Json = Any
Values = dict[str, Json]

SHORT = 400
"""The most characters of an object that is written anew as a whole."""
MOST_ODD = 100
"""After so many objects that are not written as new ones would be, no others are compared."""


class Written(NamedTuple):
    """The values as they are in the new text, and the replaced pieces in order."""

    values: Json
    pieces: list[Piece]


class Splicer:
    """Gives the objects of one document other values. Paths are those of the former values."""

    def __init__(self, document: Document, style: JsonStyle | None = None) -> None:
        spans = document.spans
        assert isinstance(spans, JsonSpans)
        self.text, self.newline, self.spans = document.text, document.newline, spans
        self._document, self._given = document, style
        self._odd = 0
        """The number of short objects that are not written as new ones would be."""
        self._rows: dict[Path, MemberRow] = {}
        self._moved: dict[Path, str | None] = {}

    @cached_property
    def style(self) -> JsonStyle:
        """The layout of new elements."""
        return self._given or style_of(self._document, self.spans)

    def change(
        self, path: Path, member: Member, old: Json, new: Json, indent: str
    ) -> Written | None:
        """Give the member at ``path`` another value. None if it is the same.

        ``indent`` is the indentation of the line with its key.
        """
        if same(old, new):
            return None
        if isinstance(old, dict) and isinstance(new, dict):
            anew = self._anew(path, member, old, new, indent)
            return anew or self.container(path, member.value_start, old, new)
        if isinstance(old, list) and isinstance(new, list):
            # A list is handled as an object whose keys are the indices of its old elements.
            before = {str(index): value for index, value in enumerate(old)}
            after = dict(zip(aligned(old, new), new, strict=True))
            pieces = self.container(path, member.value_start, before, after).pieces
        else:
            text = render(new, self.style, indent, len(path))
            pieces = [Piece(member.value_start, member.value_end, text)]
        self.move(path, None)
        return Written(new, pieces)

    def _anew(
        self, path: Path, member: Member, old: Values, new: Values, indent: str
    ) -> Written | None:
        """Write a short object of the file's notes as a whole, such as a hazard on one line.

        Member by member takes several times as long and writes the same, if the object is written
        as a new one would be. None if it is not, so that what is written otherwise stays so.
        """
        start, end, depth = member.value_start, member.value_end, len(path)
        short = end - start <= SHORT and depth > 1 and path[0].startswith("_")
        if not (short and old and new and self._odd < MOST_ODD):
            return None
        text, style = self.text[start:end], self.style
        if style.newline in text or text != render(old, style, indent, depth):
            self._odd += 1
            return None
        return Written(new, [Piece(start, end, render(new, style, indent, depth))])

    def container(self, path: Path, start: int, old: Values, new: Values) -> Written:
        """Give the object (or list) at ``path``, which opens at ``start``, other values."""
        container = _Container(self, path, start, old, new)
        values = container.written()
        self._rows[path] = container.row_after()
        return Written(values, container.pieces)

    def move(self, path: Path, key: str | None) -> None:
        """Note the new key of the member at ``path``. None means that everything known below it is
        not valid any more.
        """
        self._moved[path] = key

    def rows_after(self) -> dict[Path, MemberRow]:
        """Return the long rows of the new text that are known, by their paths."""
        known = {**self.spans.long_rows, **self._rows}
        found = ((self._after(path), row) for path, row in known.items() if row.is_long)
        return {path: row for path, row in found if path is not None}

    def _after(self, path: Path) -> Path | None:
        """Return the new path of an old path, None if it is not known."""
        now: list[str] = []
        for depth, key in enumerate(path, start=1):
            moved = self._moved.get(path[:depth], key)
            if moved is None:
                return None
            now.append(moved)
        return tuple(now)


@dataclass(slots=True)
class _Slot:
    """One member of the object that is being written. ``member`` is None for a new one."""

    key: str
    member: Member | None
    gap: str | None = None
    """The text between this slot and the next."""
    wins: bool = True


class _Container:
    """An object or list that gets other values. ``pieces`` are the replaced pieces."""

    def __init__(self, splicer: Splicer, path: Path, start: int, old: Values, new: Values) -> None:
        self.pieces: list[Piece] = []
        self._splicer, self._path, self._start = splicer, path, start
        self._text, self._old, self._new = splicer.text, old, new
        self._row = splicer.spans.row(path, start)
        self._parts, self._lengths = list(self._row.parts), list(self._row.lengths)
        self._arranged: list[tuple[Stretch, list[str], list[SpanPart]]] = []
        self._values: Values = {}
        """The values that are not the same objects as the new ones."""
        self._header = "HEADER" if len(path) == 1 else ""
        self._free = len(path) == 2 and path[1] == "HEADER"
        """Whether the order of its keys has no meaning, so that they keep the order of the text."""

    def written(self) -> Values:
        """Find the replaced pieces. Return the values as they are in the new text."""
        old, new, keys, wanted = self._old, self._new, self._row.keys, list(self._new)
        if keys != list(old) or (self._free and keys != wanted):
            parts = [whole(keys, wanted)]
        else:
            parts = stretches(keys, wanted, self._header)
        before, after = list(old.values()), list(new.values())
        at = to = 0
        for part in (*parts, Stretch(len(keys), len(keys), len(wanted), len(wanted))):
            for offset in differing(before[at : part.begin], after[to : part.first]):
                self._change(at + offset, before[at + offset], after[to + offset])
            if part.begin < part.end or part.first < part.last:
                self._arrange(part, wanted[part.first : part.last])
            at, to = part.end, part.last
        order = self._order()
        if order == wanted:
            return {**new, **self._values}
        return {key: self._values.get(key, new[key]) for key in order}

    def row_after(self) -> MemberRow:
        """Return its members as they are in the new text."""
        if not self.pieces:
            return self._row
        for part, _, parts in reversed(self._arranged):
            self._parts[part.begin : part.end] = parts
            self._lengths[part.begin : part.end] = map(sum, parts)
        return MemberRow(self._order(), self._parts, self._lengths)

    def _order(self) -> list[str]:
        """Return its keys in the order of the new text."""
        if not self._arranged:
            return self._row.keys
        keys = list(self._row.keys)
        for part, inside, _ in reversed(self._arranged):
            keys[part.begin : part.end] = inside
        return keys

    # one member ---------------------------------------------------------------------------------

    def _change(self, index: int, old: Json, new: Json) -> None:
        """Give another value to a member that keeps its place."""
        key, member = self._row.keys[index], self._row.member(index, self._start)
        changed = self._splicer.change((*self._path, key), member, old, new, self._indent)
        if changed is None:
            self._values[key] = old
            return
        self._values[key] = changed.values
        self.pieces += changed.pieces
        growth = sum(piece.growth for piece in changed.pieces)
        self._resize(index, value=self._parts[index].value + growth)

    def _resize(self, index: int, **lengths: int) -> None:
        """Note new lengths of a member."""
        part = self._parts[index] = self._parts[index]._replace(**lengths)
        self._lengths[index] = sum(part)

    # several members ----------------------------------------------------------------------------

    def _arrange(self, part: Stretch, wanted: list[str]) -> None:
        """Replace some members by others, or by the same in another order."""
        row, gap = self._row, self._gap
        members = [row.member(index, self._start) for index in range(part.begin, part.end)]
        following = row.member(part.end, self._start) if part.end < len(row) else None
        new = {key: self._new[key] for key in wanted}
        kept = survivors({one.key: self._old[one.key] for one in members}, new, self._header)
        for member in members:
            if kept.get(member.key) != member.key:
                self._splicer.move((*self._path, member.key), kept.get(member.key))
        slots = self._slots(members, kept, following)
        if [slot.key for slot in slots] != wanted:
            if not self._free:
                slots = _permuted(slots, permuted([s.key for s in slots], new, self._header))
            slots = _filled(slots, arranged([slot.key for slot in slots], new, self._header), gap)
        back = {now: was for was, now in kept.items()}
        pieces: list[str] = []
        parts: list[SpanPart] = []
        before = row.parts[part.begin].before if part.begin < len(row) else len(self._lead)
        for index, slot in enumerate(slots):
            key, middle = self._key(slot, back)
            former = self._old.get(back.get(slot.key, ""))
            value = self._value(slot, former, new[slot.key])
            parts.append(SpanPart(before, len(key), len(middle), len(value)))
            ends = index + 1 == len(slots) and following is None
            behind = "" if ends else slot.gap or gap
            pieces += (key, middle, value, behind)
            before = len(behind)
        self._arranged.append((part, [slot.key for slot in slots], parts))
        if following is not None:
            self._resize(part.end, before=before)
        if members:
            # An empty object also loses the text before its first member.
            start = members[0].key_start if slots or following else self._start + 1
            end = following.key_start if following else members[-1].value_end
            self.pieces.append(Piece(start, end, "".join(pieces)))
        elif slots:
            start, end = self._start + 1, self._end
            self.pieces.append(Piece(start, end, "".join([self._lead, *pieces, self._trail])))

    def _slots(
        self, members: list[Member], kept: Mapping[str, str], following: Member | None
    ) -> list[_Slot]:
        last = {member.key: index for index, member in enumerate(members)}
        behind = following.key_start if following else None
        ends = [*(member.key_start for member in members), behind][1:]
        return [
            _Slot(
                kept[member.key],
                member,
                None if end is None else self._text[member.value_end : end],
                last[member.key] == index,
            )
            for index, (member, end) in enumerate(zip(members, ends, strict=True))
            if member.key in kept
        ]

    def _key(self, slot: _Slot, back: Mapping[str, str]) -> tuple[str, str]:
        """Return the key of a slot, and the text between it and the value."""
        member, text = slot.member, self._text
        if text[self._start] == "[":
            return "", ""
        if member is None:
            return scalar(slot.key), self._splicer.style.colon
        middle = text[member.key_end : member.value_start]
        if back[slot.key] != slot.key:
            return scalar(slot.key), middle
        return text[member.key_start : member.key_end], middle

    def _value(self, slot: _Slot, former: Json, value: Json) -> str:
        """Return the text of the value of a slot. ``former`` is its former value."""
        member = slot.member
        if member is None:
            return render(value, self._splicer.style, self._indent, len(self._path) + 1)
        path, changed = (*self._path, member.key), None
        if slot.wins:
            changed = self._splicer.change(path, member, former, value, self._indent)
            self._values[slot.key] = former if changed is None else changed.values
        if changed is None:
            return self._text[member.value_start : member.value_end]
        return spliced(self._text, changed.pieces, member.value_start, member.value_end)

    # what stands around members -----------------------------------------------------------------

    @cached_property
    def _end(self) -> int:
        """The offset of its closing bracket."""
        return self._splicer.spans.end_of(self._row, self._start) - 1

    @cached_property
    def _inside(self) -> str:
        """The text in it if it has no members."""
        return self._text[self._start + 1 : self._end]

    @cached_property
    def _broken(self) -> bool:
        """Whether members begin a new line, if it has none yet."""
        inline_from = self._splicer.style.inline_from
        opens = self._text[self._start] == "{"
        return self._splicer.newline in self._inside or (len(self._path) < inline_from and opens)

    @cached_property
    def _lead(self) -> str:
        """The text before the first member."""
        if len(self._row):
            return self._text[self._start + 1 : self._row.member(0, self._start).key_start]
        if self._broken:
            return self._splicer.newline + self._line_indent + self._splicer.style.unit
        return self._inside[:1]

    @cached_property
    def _trail(self) -> str:
        """The text after the last member, if it has none yet."""
        newline = self._splicer.newline
        if self._broken:
            return self._inside if newline in self._inside else newline + self._line_indent
        return self._inside[:1]

    @cached_property
    def _gap(self) -> str:
        """The text between two new members."""
        count, newline = len(self._row), self._splicer.newline
        if count > 1:
            last = self._row.member(count - 1, self._start).key_start
            return self._text[last - self._row.parts[-1].before : last]
        broken = newline in self._lead if count else self._broken
        return "," + self._lead if broken else self._splicer.style.comma

    @cached_property
    def _indent(self) -> str:
        """The white space at the beginning of a member's line."""
        newline = self._splicer.newline
        if newline in self._lead:
            return self._lead.rpartition(newline)[2]
        return self._line_indent

    @cached_property
    def _line_indent(self) -> str:
        """The white space at the beginning of the line on which it opens."""
        newline = self._splicer.newline
        start = self._text.rfind(newline, 0, self._start) + len(newline)
        if start < len(newline):
            return ""
        return self._text[start : skip_space(self._text, start)]


def _permuted(slots: list[_Slot], contents: list[int]) -> list[_Slot]:
    """Return the slots with the contents of others. The gaps stay."""
    return [
        _Slot(slots[content].key, slots[content].member, slot.gap, slots[content].wins)
        for slot, content in zip(slots, contents, strict=True)
    ]


def _filled(slots: list[_Slot], row: list[Placed], gap: str) -> list[_Slot]:
    """Return the slots in their new order. A new one gets the gap of the slot that it is near."""
    return [
        slots[placed.slot]
        if placed.slot is not None
        else _Slot(
            placed.key, None, (slots[placed.near].gap if placed.near is not None else None) or gap
        )
        for placed in row
    ]
