"""A row of elements with what stands between them: taken apart, changed, and put together again.

What follows an element on its line (commas, a comment) is its tail; what stands between that and
the next element is that one's head; what is left before the closing bracket is the foot. Comments
on lines of their own stay when the element below them goes; the one on its own line goes along.
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
_ABOUT = re.compile(r"((?:[^\S\r\n]*+//[^\r\n]*+(?:\r\n|\r|\n))++)([^\S\r\n]*+)\Z")
_BREAK = re.compile(r"\r\n|\r|\n")


@dataclass(slots=True, eq=False)
class Slot:
    """One element in its row: an old one, or a new one (no element). A ``line`` ends its line."""

    key: str
    element: Element | None
    text: str
    line: bool
    head: str = ""
    commas: str = ""
    comment: str = ""
    wins: bool = True

    def take(self, other: Slot) -> None:
        """Hold what another slot holds; head and commas stay those of the place."""
        self.key, self.element, self.text = other.key, other.element, other.text
        self.line, self.comment, self.wins = other.line, other.comment, other.wins


class RowFrame:
    """The elements between two brackets (or of the file), and what holds for all of them. Of many
    only as many are looked at as it takes to tell."""

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
        """What stands before an element; behind the last one for the index that follows it."""
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
        """Whether a line ends somewhere between the elements."""
        return self.outermost or any(map(has_break, self._gaps()))

    @cached_property
    def first(self) -> int:
        """The index of the first element that commas part from others; behind all for none."""
        found = (index for index, one in enumerate(self.elements) if not _is_line(one))
        return next(found, len(self.elements))

    @cached_property
    def last(self) -> int:
        """The index of the last element that commas part from others; -1 for none."""
        every = range(len(self.elements) - 1, -1, -1)
        return next((index for index in every if not _is_line(self.elements[index])), -1)

    @cached_property
    def trailing(self) -> bool:
        """Whether a comma stands behind the last one of these."""
        return self.last >= 0 and bool(_tail(self.gap(self.last + 1))[0])

    @cached_property
    def commas(self) -> bool | None:
        """Whether commas part the elements; None where there are too few to tell."""
        if self.first >= self.last:
            return None
        before = False
        for index, (element, gap) in enumerate(zip(self.elements, self._gaps(), strict=False)):
            if before and has_comma(gap):
                return True
            before = not _is_line(element) and index < self.last
        return False

    def indent(self, otherwise: Callable[[], str]) -> str:
        """The indentation of the elements that begin a line."""
        for _, gap in zip(self.elements, self._gaps(), strict=False):
            if has_break(gap):
                return _last_indent(gap)
        return otherwise()


class ElementRow:
    """The elements of a frame from ``begin`` to ``end``, free to be changed."""

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
        """Whether what is changed here may neither begin nor end what commas part."""
        self._last = self.slots[frame.last - begin] if begin <= frame.last < stop else None
        self.commas = frame.commas
        """Whether commas part the elements; None where there are too few to tell."""

    def _after(self, gap: str) -> str:
        """The head of what follows a gap; the tail of what is before it is put there."""
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
        """Take away the slots that are not kept; comments above them stay."""
        heads, left = [self.foot], []  # from the last one to the first
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
        """Put the commas right after elements have gone."""
        self._part(set())

    def permute(self, places: Sequence[int], contents: Sequence[int]) -> None:
        """Let the slot at each of the places hold what ``contents`` says.

        The comments right above an element and on its line go with it; a preamble of the file
        stays.
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
        """Hold these slots, some of them new: those take heads like their neighbours'."""
        new = {id(slot) for slot in slots} - {id(slot) for slot in self.slots}
        only_lines = not self._begun
        for index, slot in enumerate(slots):
            if id(slot) in new:
                slot.head = self._head(slots, index, indent)
                if only_lines and index > 1 and not slot.line:
                    slot.head = self.newline + slot.head  # the first state, behind a header
            only_lines = only_lines and slot.line
        if slots and id(slots[0]) in new:
            self._begin(slots, new, indent)
        self.slots = slots
        self._part(new)

    def _head(self, slots: list[Slot], index: int, indent: str) -> str:
        """The head of the new slot at an index."""
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
        """Let the first slot, a new one, begin the row; what stands above stays above."""
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
        """A head with the white space of another, but not its comments and commas."""
        if not head.strip():
            return head or " "
        return self.newline + indent if has_break(head) else " "

    def _part(self, new: set[int]) -> None:
        """Put commas behind new elements, and where an element is or was the last."""
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
        """The row as text. ``closing`` is the indentation of the bracket behind it, None at the
        end of a file."""
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
        """The indentation of the elements that begin a line."""
        for slot in self.slots:
            if has_break(slot.head):
                return _last_indent(slot.head)
        return otherwise


def _last_indent(gap: str) -> str:
    """The white space behind the last line end of a gap."""
    line = gap[_last_break(gap) :].lstrip("\r\n")
    return line[: len(line) - len(line.lstrip())]


def _is_line(element: Element) -> bool:
    """Whether an element ends its line, so that no comma parts it from the next."""
    return element.kind in ("field", "header", "name")


def _tail(gap: str) -> tuple[str, str]:
    """The commas and the comment that follow an element on its line."""
    commas = _COMMAS.match(gap)
    end = commas.end() if commas else 0
    comment = _COMMENT.match(gap, end)
    return gap[:end], comment[0] if comment else ""


def has_break(text: str) -> bool:
    """Whether a line ends in a text."""
    return "\n" in text or "\r" in text


def _last_break(text: str) -> int:
    """Where the last line end of a text begins, -1 where there is none."""
    last = -1
    for match in _BREAK.finditer(text):
        last = match.start()
    return last


def _in_three(head: str) -> tuple[str, str, str]:
    """A head as what stands above, the comment lines right above its element, its indentation."""
    match = _ABOUT.search(head)
    if match is None or (match.start() and head[match.start() - 1] not in "\r\n"):
        return head, "", ""
    return head[: match.start()], match[1], match[2]


def _joined(gone: str, behind: str, first: bool, at_foot: bool) -> str:
    """The head of an element when the one before it goes, whose head was ``gone``."""
    cut = _last_break(gone)
    if not has_break(behind):
        return gone if cut >= 0 or (first and not at_foot) else behind
    kept = gone[:cut] if cut >= 0 else ""
    blank = "".join(without_comments(kept)).strip(" \t,") == kept.strip(" \t,")
    if blank and (at_foot or len(_BREAK.findall(behind)) > 1):
        kept = ""
    return kept + behind
