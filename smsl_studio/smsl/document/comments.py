"""Comments and the elements that they belong to, so that they are kept in a text that is written
anew.

A comment on its own line belongs to the member below it, or to the end of the map or list that
closes first. A comment after something belongs to that line. Elements are named by their paths, so
that comments can go from one form to another.
"""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import NamedTuple

from smsl_studio.smsl.document import Path

_Where = dict[Path, list[str]]


@dataclass(frozen=True)
class Comments:
    """The words of comments, without the marks, by the path of the element that they belong to.

    ``over`` are above a member, ``beside`` after it, and ``under`` at the end of a map or list.
    """

    over: _Where = field(default_factory=dict)
    beside: _Where = field(default_factory=dict)
    under: _Where = field(default_factory=dict)

    def __len__(self) -> int:
        every = (self.over, self.beside, self.under)
        return sum(len(found) for where in every for found in where.values())

    def of_elements(self, path: Path, count: int) -> bool:
        """Return whether an element of the list at ``path`` has a comment."""
        if not self.over and not self.beside:
            return False
        below = ((*path, str(index)) for index in range(count))
        return any(one in self.over or one in self.beside for one in below)

    def moved(self, moved: Callable[[Path], Path | None]) -> Comments:
        """Return the same comments at other paths. Those whose path becomes None are left out."""

        def all_of(where: _Where) -> _Where:
            """Return the comments of one kind at their new paths."""
            pairs = ((moved(path), found) for path, found in where.items())
            return {path: found for path, found in pairs if path is not None}

        return Comments(all_of(self.over), all_of(self.beside), all_of(self.under))


NO_COMMENTS = Comments()


class Leaf(NamedTuple):
    """A name or a single value: its place, its path, and the path for a comment above it."""

    start: int
    end: int
    path: Path
    head: Path


class Holder(NamedTuple):
    """A map or list: its place, its path, and the ``column`` of the members of a block."""

    start: int
    end: int
    path: Path
    column: int | None = None


def comments_between(
    text: str, leaves: Iterable[Leaf], holders: Iterable[Holder], mark: re.Pattern[str]
) -> Comments:
    """Return the comments of a text, which can only be between its names and values.

    ``mark`` matches a whole comment, and its group 1 is the words. Inner holders come before outer
    ones.
    """
    return _Placing(text, sorted(leaves), holders).found(mark)


class _Placing:
    """Finds the element that each comment belongs to."""

    def __init__(self, text: str, leaves: list[Leaf], holders: Iterable[Holder]) -> None:
        self._text, self._leaves = text, leaves
        self._starts = [leaf.start for leaf in leaves]
        self._closing: dict[int, list[Holder]] = {}
        """For each leaf the maps and lists that it is the last leaf of."""
        for holder in holders:
            last = bisect_left(self._starts, holder.end) - 1
            while last + 1 < len(leaves) and leaves[last + 1][:2] == (holder.end, holder.end):
                last += 1  # an empty value
            self._closing.setdefault(last, []).append(holder)

    def found(self, mark: re.Pattern[str]) -> Comments:
        """Return all comments that ``mark`` matches, each with its element."""
        comments, at = Comments(), 0
        for index in range(len(self._leaves) + 1):
            leaf = self._leaves[index] if index < len(self._leaves) else None
            end = leaf.start if leaf else len(self._text)
            for one in mark.finditer(self._text, at, max(at, end)):
                self._place(comments, one.start(), one[1].rstrip())
            at = max(at, leaf.end) if leaf else at
        return comments

    def _place(self, comments: Comments, at: int, words: str) -> None:
        index = bisect_right(self._starts, at) - 1
        closing = [one for one in self._closing.get(index, ()) if one.start <= at]
        before = self._leaves[index] if index >= 0 else None
        if before and not _parted(self._text, before.end, at):
            path = before.path
            for holder in closing:
                if holder.column is None and holder.end <= at:
                    path = holder.path
            comments.beside.setdefault(path, []).append(words)
            return
        column = at - self._text.rfind("\n", 0, at) - 1
        for holder in closing:
            if holder.end > at if holder.column is None else column >= holder.column > 0:
                comments.under.setdefault(holder.path, []).append(words)
                return
        if index + 1 < len(self._leaves):
            comments.over.setdefault(self._leaves[index + 1].head, []).append(words)
        else:
            comments.under.setdefault((), []).append(words)


def _parted(text: str, start: int, end: int) -> bool:
    """Return whether a line ends between two offsets."""
    return "\n" in text[start:end] or "\r" in text[start:end]
