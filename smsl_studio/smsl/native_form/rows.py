"""A row of elements and the text between them: taken apart, changed, and put together again.

The tail of an element is the rest of its line: commas and a comment. The head of an element is the
text between the tail before it and the element. The foot is the text before the closing bracket. If
an element is removed, the comments on the lines above it stay, and the comment on its line goes.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from smsl_studio.smsl.native_form.elements import Element
from smsl_studio.smsl.native_form.style import has_comma, without_comments
from smsl_studio.smsl.native_form.tokens import is_bare

_COMMAS = re.compile(r"(?:[^\S\r\n]*+,)*+")
_COMMENT = re.compile(r"[^\S\r\n]*+//[^\r\n]*+")
_ABOUT = re.compile(r"((?>(?:[^\S\r\n]*+//[^\r\n]*+(?:\r\n|\r|\n))+))([^\S\r\n]*+)\Z")
_BREAK = re.compile(r"\r\n|\r|\n")


@dataclass(slots=True, eq=False)
class Slot:
    """One element in its row. A new one has no ``element``. A ``line`` extends to the end of its
    line.
    """

    key: str
    element: Element | None
    text: str
    line: bool
    head: str = ""
    commas: str = ""
    comment: str = ""
    wins: bool = True

    def take(self, other: Slot) -> None:
        """Take the content of another slot. Head and commas stay."""
        self.key, self.element, self.text = other.key, other.element, other.text
        self.line, self.comment, self.wins = other.line, other.comment, other.wins


class RowFrame:
    """The elements between two brackets, or those of the file, and the layout that they share.

    It looks only at the elements that are needed to know this.
    """

    def __init__(
        self,
        text: str,
        start: int,
        end: int,
        elements: Sequence[Element],
        newline: str,
        outermost: bool = False,
    ) -> None:
        self.text, self.start, self.end, self.elements = text, start, end, elements
        self.newline, self.outermost = newline, outermost

    def gap(self, index: int) -> str:
        """Return the text before an element. For the index after the last one, the text behind the
        last.
        """
        start = self.elements[index - 1].end if index else self.start
        end = self.elements[index].start if index < len(self.elements) else self.end
        return self.text[start:end]

    def _gaps(self) -> Iterator[str]:
        at = self.start
        for element in self.elements:
            yield self.text[at : element.start]
            at = element.end
        yield self.text[at : self.end]

    @cached_property
    def broken(self) -> bool:
        """Whether a line ends between two of the elements."""
        return self.outermost or any(map(has_break, self._gaps()))

    @cached_property
    def first(self) -> int:
        """The index of the first element that is no ``#`` line. The number of elements if there is
        none.
        """
        found = (index for index, one in enumerate(self.elements) if not _is_line(one))
        return next(found, len(self.elements))

    @cached_property
    def last(self) -> int:
        """The index of the last element that is no ``#`` line. -1 if there is none."""
        every = range(len(self.elements) - 1, -1, -1)
        return next((index for index in every if not _is_line(self.elements[index])), -1)

    @cached_property
    def trailing(self) -> bool:
        """Whether a comma follows the last element that is no ``#`` line."""
        return self.last >= 0 and bool(_tail(self.gap(self.last + 1))[0])

    @cached_property
    def commas(self) -> bool | None:
        """Whether commas separate the elements. None if there are too few to know."""
        if self.first >= self.last:
            return None
        before = False
        for index, (element, gap) in enumerate(zip(self.elements, self._gaps(), strict=False)):
            if before and has_comma(gap):
                return True
            before = not _is_line(element) and index < self.last
        return False

    def indent(self, otherwise: Callable[[], str]) -> str:
        """Return the indentation of the elements that begin a line. ``otherwise`` gives it if there
        are none.
        """
        for _, gap in zip(self.elements, self._gaps(), strict=False):
            if has_break(gap):
                return _last_indent(gap)
        return otherwise()


class ElementRow:
    """The elements of a frame from ``begin`` to ``end``. They can be changed."""

    def __init__(self, frame: RowFrame, begin: int = 0, end: int | None = None) -> None:
        self.frame, self.newline, self.outermost = frame, frame.newline, frame.outermost
        self.opener = ""
        self.slots: list[Slot] = []
        text, elements = frame.text, frame.elements
        stop = len(elements) if end is None else end
        self.start = at = frame.start
        if begin:
            commas, comment = _tail(frame.gap(begin))
            self.start = at = elements[begin - 1].end + len(commas) + len(comment)
        for element in elements[begin:stop]:
            head = self._after(text[at : element.start])
            whole = text[element.start : element.end]
            self.slots.append(Slot(element.key, element, whole, _is_line(element), head))
            at = element.end
        self.end = frame.end if stop == len(elements) else at
        self.foot = self._after(text[at : self.end])
        self._begun = begin > frame.first
        self._goes_on = frame.last >= stop
        """Whether elements with commas follow after the part that is changed here."""
        self._last = self.slots[frame.last - begin] if begin <= frame.last < stop else None
        self.commas = frame.commas
        """Whether commas separate the elements. None if there are too few to know."""

    def _after(self, gap: str) -> str:
        """Give the tail in a gap to the element before it. Return the rest: the head of the next
        one.
        """
        commas, comment = _tail(gap)
        end = len(commas) + len(comment)
        if self.slots:
            self.slots[-1].commas, self.slots[-1].comment = commas, comment
        elif not comment or self.outermost:
            return gap
        else:
            self.opener = gap[:end]
        return gap[end:]

    def remove(self, kept: Sequence[bool]) -> None:
        """Remove the slots that are not kept. Comments above them stay."""
        heads, left = [self.foot], []  # The order is from the last to the first.
        for index, slot in reversed([*enumerate(self.slots)]):
            if kept[index]:
                left.append(slot)
                heads.append(slot.head)
                continue
            gone, behind = slot.head, heads[-1]
            if not left and self.outermost and not has_break(behind):
                heads[-1] = gone[: max(0, _last_break(gone))] + behind
            else:
                heads[-1] = _joined(gone, behind, index == 0, not left)
        self.slots = left[::-1]
        self.foot, *others = heads
        for slot, head in zip(left, others, strict=True):
            slot.head = head

    def settle(self) -> None:
        """Correct the commas after elements were removed."""
        self._part(set())

    def permute(self, places: Sequence[int], contents: Sequence[int]) -> None:
        """Give the slots at some places the contents of others.

        The comments directly above an element, and on its line, move with it. The comments at the
        beginning of the file stay.
        """
        if list(contents) == list(range(len(places))):
            return
        before = [Slot("", None, "", False) for _ in places]
        heads: list[tuple[str, str, str]] = []
        for copy, place in zip(before, places, strict=True):
            copy.take(self.slots[place])
            head = self.slots[place].head
            heads.append((head, "", "") if place == 0 and self.outermost else _in_three(head))
        for index, (place, content) in enumerate(zip(places, contents, strict=True)):
            self.slots[place].take(before[content])
            (above, _, indent), about = heads[index], heads[content][1]
            if about and not above.endswith(("\r", "\n")):
                above, indent = above.rstrip(" \t") + self.newline, heads[content][2]
            self.slots[place].head = above + about + indent

    def fill(self, slots: list[Slot], indent: str) -> None:
        """Take these slots. New ones get heads like those of their neighbours."""
        new = {id(slot) for slot in slots} - {id(slot) for slot in self.slots}
        only_lines = not self._begun
        for index, slot in enumerate(slots):
            if id(slot) in new:
                slot.head = self._head(slots, index, indent)
                if only_lines and index > 1 and not slot.line:
                    slot.head = self.newline + slot.head  # An empty line is before the first state.
            only_lines = only_lines and slot.line
        if slots and id(slots[0]) in new:
            self._begin(slots, new, indent)
        self.slots = slots
        self._part(new)

    def _head(self, slots: list[Slot], index: int, indent: str) -> str:
        """Return the head of the new slot at an index."""
        plain = self.newline + indent if self.frame.broken or slots[index].line else " "
        if index == 0 or slots[index].line or slots[index - 1].line:
            return plain
        if index > 1 and not slots[index - 2].line:
            return self._like(slots[index - 1].head, indent)
        following = slots[index + 1] if index + 1 < len(slots) else None
        if following and following.element and not following.line:
            return self._like(following.head, indent)
        return plain

    def _begin(self, slots: list[Slot], new: set[int], indent: str) -> None:
        """Let a new first slot begin the row. The text above it stays above it."""
        former = next((slot for slot in slots if id(slot) not in new), None)
        if former is None:
            if self.outermost:
                above = self.foot
                if above and above[-1] not in "\r\n":
                    above += self.newline if above.strip() else ""
                slots[0].head, self.foot = above, self.newline
            elif not self.frame.broken and not slots[0].line:
                slots[0].head = ""
        elif self.outermost or not has_break(former.head):
            slots[0].head, former.head = former.head, slots[0].head

    def _like(self, head: str, indent: str) -> str:
        """Return a head with the white space of another, without its comments and commas."""
        if not head.strip():
            return head or " "
        return self.newline + indent if has_break(head) else " "

    def _part(self, new: set[int]) -> None:
        """Put commas behind new elements, and correct those of the former and the new last
        element.
        """
        parted = [index for index, slot in enumerate(self.slots) if not slot.line]
        for index in parted if self._goes_on else parted[:-1]:
            slot = self.slots[index]
            if (id(slot) in new or slot is self._last) and self.commas and not slot.commas:
                behind = self.slots[index + 1].head
                slot.commas = "" if has_comma(behind) else ","
        if parted and not self._goes_on:
            last, trailing = self.slots[parted[-1]], self.frame.trailing
            if id(last) in new:
                last.commas = "," if trailing else ""
            elif last is not self._last and not trailing:
                last.commas = ""

    def whole(self, indent: str, closing: str | None) -> str:
        """Return the row as text.

        ``closing`` is the indentation of the bracket after it, None at the end of a file.
        """
        pieces = [self.opener]
        ends = bool(self.opener.strip())
        before = ""
        for slot in self.slots:
            head = slot.head
            if ends and not has_break(head):
                head = self.newline + indent + head.strip()
            elif not head and before and is_bare(before[-1] + slot.text[0]):
                head = " "
            pieces += (head, slot.text, slot.commas, slot.comment)
            ends = slot.line or bool(slot.comment)
            before = "" if slot.commas else slot.text
        foot = self.foot
        if ends and closing is not None and not has_break(foot):
            foot = self.newline + closing + foot.strip()
        return "".join([*pieces, foot])

    def indent(self, otherwise: str) -> str:
        """Return the indentation of the elements that begin a line, ``otherwise`` if there are
        none.
        """
        for slot in self.slots:
            if has_break(slot.head):
                return _last_indent(slot.head)
        return otherwise


def _last_indent(gap: str) -> str:
    """Return the indentation after the last line end of a gap."""
    line = gap[_last_break(gap) :].lstrip("\r\n")
    return line[: len(line) - len(line.lstrip())]


def _is_line(element: Element) -> bool:
    """Return whether an element ends its line, so that no comma follows it."""
    return element.kind in ("field", "header", "name")


def _tail(gap: str) -> tuple[str, str]:
    """Return the commas and the comment that follow an element on its line."""
    commas = _COMMAS.match(gap)
    end = commas.end() if commas else 0
    comment = _COMMENT.match(gap, end)
    return gap[:end], comment[0] if comment else ""


def has_break(text: str) -> bool:
    """Return whether a line ends in a text."""
    return "\n" in text or "\r" in text


def _last_break(text: str) -> int:
    """Return the offset of the last line end of a text, -1 if there is none."""
    last = -1
    for match in _BREAK.finditer(text):
        last = match.start()
    return last


def _in_three(head: str) -> tuple[str, str, str]:
    """Return a head in three parts: the text above, the comment lines directly above, the
    indentation.
    """
    match = _ABOUT.search(head)
    if match is None or (match.start() and head[match.start() - 1] not in "\r\n"):
        return head, "", ""
    return head[: match.start()], match[1], match[2]


def _joined(gone: str, behind: str, first: bool, at_foot: bool) -> str:
    """Return the new head of an element if the one before it, with the head ``gone``, is
    removed.
    """
    cut = _last_break(gone)
    if not has_break(behind):
        return gone if cut >= 0 or (first and not at_foot) else behind
    kept = gone[:cut] if cut >= 0 else ""
    blank = "".join(without_comments(kept)).strip(" \t,") == kept.strip(" \t,")
    if blank and (at_foot or len(_BREAK.findall(behind)) > 1):
        kept = ""
    return kept + behind
