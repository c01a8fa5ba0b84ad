"""The comments of a native text: finds them with their elements, and writes them into another
text.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator

from smsl_studio.smsl.document import Document, Path
from smsl_studio.smsl.document.comments import NO_COMMENTS, Comments, Holder, Leaf, comments_between
from smsl_studio.smsl.native_form.elements import Element
from smsl_studio.smsl.native_form.spans import NativeSpans

_COMMENT = re.compile(r"//([^\r\n]*)")
_UNIT = "    "


def comments_in(document: Document) -> Comments:
    """Return the comments of a native document with their elements."""
    if "//" not in document.text:
        return NO_COMMENTS
    leaves: list[Leaf] = []
    holders: list[Holder] = []
    for path, element in _elements(NativeSpans(document.text)):
        if element.kind in ("branch", "state"):
            leaves.append(Leaf(element.key_start, element.key_end, path, path))
            holders.append(Holder(element.value_start, element.value_end, path))
        elif element.kind == "edge":
            # A comment may be on either side of the arrow.
            leaves.append(Leaf(element.key_start, element.key_end, path, path))
            leaves.append(Leaf(element.value_start, element.value_end, path, path))
        else:
            leaves.append(Leaf(element.start, element.end, path, path))
    return comments_between(document.text, leaves, holders, _COMMENT)


def with_comments(text: str, comments: Comments) -> str:
    """Return a text with comments put in. The text is in the canonical layout and has no comments
    yet.
    """
    put = _Putting(text)
    for path, words in comments.over.items():
        put.above(path, words)
    for path, words in comments.beside.items():
        put.behind(path, words)
    for path, words in comments.under.items():
        put.at_end(path, words)
    return put.text()


def _elements(spans: NativeSpans) -> Iterator[tuple[Path, Element]]:
    """Yield every element with its path, inner elements first."""
    for outer in spans.elements:
        for element in outer.elements:
            if element.kind == "header":
                yield (outer.key, "HEADER", element.key), element
            elif element.kind != "name":
                path = (outer.key, element.key)
                inside = spans.inside(element) if element.kind == "state" else ()
                yield from (((*path, inner.key), inner) for inner in inside)
                yield path, element
        yield (outer.key,), outer


class _Putting:
    """Puts comments into a text: above a line, or at its end."""

    def __init__(self, text: str) -> None:
        self._lines = text.split("\n")[:-1]
        self._starts = [0]
        for line in self._lines:
            self._starts.append(self._starts[-1] + len(line) + 1)
        self._places = {path: (e.start, e.end) for path, e in _elements(NativeSpans(text))}
        self._before: dict[int, list[str]] = {}
        self._behind: dict[int, list[str]] = {}

    def above(self, path: Path, words: list[str]) -> None:
        """Put comments above the line on which an element begins."""
        self._put_above(self._range(path)[0], words)

    def behind(self, path: Path, words: list[str]) -> None:
        """Put comments at the end of the line of an element. They go above a # line and above a
        brace.
        """
        line = self._range(path)[0]
        if self._lines[line].lstrip()[:1] in ("#", "{"):
            self._put_above(line, words)
        else:
            self._behind.setdefault(line, []).extend(words)

    def at_end(self, path: Path, words: list[str]) -> None:
        """Put comments before the line that closes an element. If it has one line only, they go to
        its end.
        """
        if not path:
            self._put_above(len(self._lines), words)
            return
        first, last = self._range(path)
        if first == last:
            self.behind(path, words)
        else:
            self._put_above(last, words, _UNIT)

    def text(self) -> str:
        """Return the text with all its comments."""
        lines = []
        for number, line in enumerate([*self._lines, None]):
            lines += self._before.get(number, [])
            if line is not None:
                behind = "".join(f"  //{words}" for words in self._behind.get(number, ()))
                lines.append(line + behind)
        return "\n".join(lines) + "\n"

    def _put_above(self, line: int, words: list[str], deeper: str = "") -> None:
        found = self._lines[line] if line < len(self._lines) else ""
        indent = found[: len(found) - len(found.lstrip())] + deeper
        self._before.setdefault(line, []).extend(f"{indent}//{one}" for one in words)

    def _range(self, path: Path) -> tuple[int, int]:
        """Return the first and the last line of an element, or of the nearest known element above
        it.
        """
        while path not in self._places:
            path = path[:-1]
            if not path:
                return 0, 0
        start, end = self._places[path]
        return bisect_right(self._starts, start) - 1, bisect_right(self._starts, end - 1) - 1
