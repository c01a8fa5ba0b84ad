"""A text as a tree: headings, lists with their sub-lists, rows of tables, and paragraphs."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from smsl_studio.generate.text.expert_text import LONGEST_QUOTE, Citation, ExpertText, SourceLine

HEADING, NUMBERED, BULLET, ROW, PARAGRAPH = "heading", "numbered", "bullet", "row", "paragraph"
ITEMS = (NUMBERED, BULLET, ROW)
_LOWEST = 9
"""The level of a heading that is only a line before a list."""
_HASHES = re.compile(r"^(#{1,6})\s+(.*?)\s*#*$")
_BOLD = re.compile(r"^\*\*([^*]+)\*\*:?$")
_LINE = re.compile(r"^(=+|-{3,})$")
_NUMBER = re.compile(
    r"^(\s*)(?:\*\*)?(?:(step|schritt)\s+)?\(?(\d{1,3}(?:\.\d{1,3})*)(\.\)|[.):])?(?:\*\*)?\s+(\S.*)$",
    re.IGNORECASE,
)
_LETTER = re.compile(r"^(\s*)\(?([a-z])[.)]\s+(\S.*)$")
_BULLET = re.compile(r"^(\s*)[-*+•–]\s+(?:\[[ xX]\]\s+)?(\S.*)$")
_RULER = re.compile(r"^\|?\s*:?-{2,}:?\s*(\|\s*:?-{2,}:?\s*)*\|?$")


@dataclass
class TextPart:
    """One part of a text with what stands below it. ``pieces`` are its lines, without the mark of a
    list; ``cells`` are those of a row, by the heads of the table."""

    kind: str
    mark: str = ""
    depth: int = 0
    pieces: list[tuple[SourceLine, str]] = field(default_factory=list)
    cells: dict[str, str] = field(default_factory=dict)
    below: list[TextPart] = field(default_factory=list)

    @property
    def text(self) -> str:
        """The words, in one line."""
        return " ".join(text for _, text in self.pieces)

    def cite(self, start: int = 0, end: int | None = None) -> Citation:
        """Return a citation of the words between two places of ``text``: as far as they stand in
        the line in which they begin."""
        at = 0
        for line, text in self.pieces:
            if start < at + len(text) + 1:
                stop = len(text) if end is None else min(len(text), end - at)
                words = text[max(0, start - at) : stop].strip()[:LONGEST_QUOTE].strip()
                return Citation(line.file, line.number, words or text[:LONGEST_QUOTE], line.page)
            at += len(text) + 1
        line, text = self.pieces[-1]
        return Citation(line.file, line.number, text[:LONGEST_QUOTE], line.page)


def outline_of(text: ExpertText) -> TextPart:
    """Return the tree of a text. Its root is a heading without words."""
    return _Outline(text.lines).root


class _Outline:
    def __init__(self, lines: Sequence[SourceLine]) -> None:
        self.root = TextPart(HEADING)
        self._headings = [self.root]
        self._items: list[TextPart] = []
        self._open: TextPart | None = None
        """The part that a line without a mark continues."""
        self._heads: list[str] | None = None
        self._numbers: dict[str, int] = {}
        self._lines = list(_without_fences(lines))
        self._blank = True
        for at, line in enumerate(self._lines):
            self._take(at, line)
            self._blank = not line.text.strip()

    def _take(self, at: int, line: SourceLine) -> None:
        text = line.text.strip()
        if not text:
            self._open = self._open if self._items else None
            self._heads = None
            return
        if text.startswith("|") or text.count("|") >= 2:
            self._row(at, line, text)
            return
        if _LINE.match(text):
            return
        heading = self._heading(at, text)
        if heading is not None:
            self._begin_heading(line, *heading)
        elif not self._item(at, line):
            self._continue(line, text)

    def _heading(self, at: int, text: str) -> tuple[int, str] | None:
        if found := _HASHES.match(text):
            return len(found[1]), found[2].strip("*_ ")
        following = self._lines[at + 1].text.strip() if at + 1 < len(self._lines) else ""
        if self._blank and _LINE.match(following) and not _BULLET.match(text):
            return (1 if following.startswith("=") else 2), text
        if found := _BOLD.match(text):
            return _LOWEST - 1, found[1].rstrip(":")
        letters = [char for char in text if char.isalpha()]
        marked = any(one.match(text) for one in (_NUMBER, _LETTER, _BULLET))
        if len(letters) > 2 and len(text) <= 60 and all(char.isupper() for char in letters):
            return (_LOWEST - 2, text) if not marked else None
        if text.endswith(":") and not marked and len(text) <= 80 and self._list_follows(at):
            return _LOWEST, text.rstrip(":")
        return None

    def _list_follows(self, at: int) -> bool:
        """Return whether a list begins after this line, which does not belong to an item."""
        if self._open is not None and self._lines[at].text[:1].isspace():
            return False
        rest = (line.text for line in self._lines[at + 1 : at + 4])
        first = next((text for text in rest if text.strip()), "")
        return any(one.match(first) for one in (_NUMBER, _LETTER, _BULLET)) or first.startswith("|")

    def _begin_heading(self, line: SourceLine, level: int, text: str) -> None:
        made = TextPart(HEADING, depth=level, pieces=[(line, text)])
        while self._headings[-1].depth >= level:
            self._headings.pop()
        self._headings[-1].below.append(made)
        self._headings.append(made)
        self._items, self._open, self._numbers = [], None, {}

    def _item(self, at: int, line: SourceLine) -> bool:
        """Take a line that begins an item of a list; False if it begins none."""
        if found := _NUMBER.match(line.text):
            indent, word, number, point, text = found.groups()
            dotted = "." in number
            known = self._follows(number) if dotted else self._has_parts(at, number)
            if not (word or point or known):
                return False
            head, _, last = number.rpartition(".")
            self._numbers[head] = int(last)
            level = 10 * number.count(".") if dotted else len(indent.expandtabs(4))
            kind, mark = NUMBERED, number
        elif found := _LETTER.match(line.text):
            indent, mark, text = found.groups()
            level, kind = len(indent.expandtabs(4)), NUMBERED
            if self._items and self._items[-1].mark.isdigit() and level == self._items[-1].depth:
                level += 1
            elif len(self._items) > 1 and self._items[-1].mark.isalpha():
                level = max(level, self._items[-1].depth)
        elif found := _BULLET.match(line.text):
            indent, text = found.groups()
            level, kind, mark = len(indent.expandtabs(4)), BULLET, ""
            if self._items and self._items[0].kind == NUMBERED and not self._blank:
                # Bullets right below a number belong to it, also where nobody indented them.
                level = max(level, self._items[0].depth + 1)
        else:
            return False
        self._add(TextPart(kind, mark, level, [(line, text.strip())]))
        return True

    def _has_parts(self, at: int, number: str) -> bool:
        """Return whether ``1.1`` comes next, so that ``1 Plan`` is a number and no sentence."""
        following = (line.text.strip() for line in self._lines[at + 1 : at + 4])
        return next((text for text in following if text), "").startswith(f"{number}.1")

    def _follows(self, number: str) -> bool:
        head, _, last = number.rpartition(".")
        return int(last) == self._numbers.get(head, 0) + 1

    def _add(self, made: TextPart) -> None:
        while self._items and self._items[-1].depth >= made.depth:
            self._items.pop()
        if not self._items:
            self._leave_line(made.kind)
        (self._items[-1] if self._items else self._headings[-1]).below.append(made)
        self._items.append(made)
        self._open = made

    def _leave_line(self, kind: str) -> None:
        """A line before a list is its heading, and not that of what follows the list."""
        heading = self._headings[-1]
        if heading.depth == _LOWEST and heading.below and heading.below[0].kind != kind:
            self._headings.pop()

    def _row(self, at: int, line: SourceLine, text: str) -> None:
        if _RULER.match(text):
            return
        cells = [cell.strip() for cell in text.strip("|").split("|")]
        if self._heads is None:
            self._heads = [cell.lower() for cell in cells]
            following = self._lines[at + 1].text.strip() if at + 1 < len(self._lines) else ""
            if _RULER.match(following):
                return
            self._heads = [str(place) for place in range(len(cells))]
        made = TextPart(ROW, depth=0, cells=dict(zip(self._heads, cells, strict=False)))
        made.pieces = [(line, text.strip("| "))]
        self._items = []
        self._headings[-1].below.append(made)
        self._open = None

    def _continue(self, line: SourceLine, text: str) -> None:
        if self._open is not None and (not self._blank or line.text[:1].isspace()):
            self._open.pieces.append((line, text))
            return
        made = TextPart(PARAGRAPH, pieces=[(line, text)])
        self._leave_line(PARAGRAPH)
        self._headings[-1].below.append(made)
        self._items, self._open = [], made


def _without_fences(lines: Sequence[SourceLine]) -> Iterator[SourceLine]:
    """Yield the lines outside of code, comments and the head of a page."""
    inside = ""
    for at, line in enumerate(lines):
        text = line.text.strip()
        if inside:
            inside = "" if text.endswith(inside) else inside
        elif text.startswith("```"):
            inside = "```"
        elif text.startswith("<!--"):
            inside = "" if text.endswith("-->") else "-->"
        elif at == 0 and text == "---":
            inside = "---"
        else:
            yield line
