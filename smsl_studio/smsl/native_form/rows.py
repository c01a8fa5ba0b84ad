"""A row of elements with what stands between them: taken apart, changed, and put together again.

What follows an element on its line (commas, a comment) is its tail; what stands between that and
the next element is that one's head; what is left before the closing bracket is the foot. Comments
on lines of their own stay when the element below them goes; the one on its own line goes along.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from smsl_studio.smsl.native_form.spans import Element
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


class ElementRow:
    """The elements between two brackets (or of the file), free to be changed."""

    def __init__(
        self,
        text: str,
        start: int,
        end: int,
        elements: Sequence[Element],
        newline: str,
        outermost: bool = False,
    ) -> None:
        self.newline = newline
        self.outermost = outermost
        self.opener = ""
        self.slots: list[Slot] = []
        at = start
        for element in elements:
            head = self._after(text[at : element.start])
            whole = text[element.start : element.end]
            is_line = element.kind in ("field", "header", "name")
            self.slots.append(Slot(element.key, element, whole, is_line, head))
            at = element.end
        self.foot = self._after(text[at:end])
        heads = (slot.head for slot in self.slots)
        self._broken = outermost or any(map(has_break, (self.opener, self.foot, *heads)))
        parted = [slot for slot in self.slots if not slot.line]
        self._last = parted[-1] if parted else None
        self._trailing = bool(self._last and self._last.commas)
        self.commas = self._uses_commas(parted) if len(parted) > 1 else None
        """Whether commas part the elements; None where there are too few to tell."""

    def _after(self, gap: str) -> str:
        """The head of what follows a gap; the tail of what is before it is put there."""
        commas = _COMMAS.match(gap)
        end = commas.end() if commas else 0
        comment = _COMMENT.match(gap, end)
        if self.slots:
            self.slots[-1].commas = gap[:end]
            self.slots[-1].comment = comment[0] if comment else ""
        elif comment is None or self.outermost:
            return gap
        else:
            self.opener = gap[: comment.end()]
        return gap[comment.end() if comment else end :]

    def _uses_commas(self, parted: list[Slot]) -> bool:
        after = {id(one): other for one, other in zip(self.slots, self.slots[1:], strict=False)}
        return any(
            slot.commas or (id(slot) in after and has_comma(after[id(slot)].head))
            for slot in parted[:-1]
        )

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
        only_lines = True
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
        plain = self.newline + indent if self._broken or slots[index].line else " "
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
            elif not self._broken and not slots[0].line:
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
        for index in parted[:-1]:
            slot = self.slots[index]
            if (id(slot) in new or slot is self._last) and self.commas and not slot.commas:
                behind = self.slots[index + 1].head
                slot.commas = "" if has_comma(behind) else ","
        if parted:
            last = self.slots[parted[-1]]
            if id(last) in new:
                last.commas = "," if self._trailing else ""
            elif last is not self._last and not self._trailing:
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
                line = slot.head[_last_break(slot.head) :].lstrip("\r\n")
                return line[: len(line) - len(line.lstrip())]
        return otherwise


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
