"""Comments: which value each belongs to, so that a text that is written anew keeps them.

A comment on a line of its own belongs to the member below it, or to the end of the map or list that
closes first; one behind something belongs to that line.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from smsl_studio.smsl.document import Path
from smsl_studio.smsl.yaml_form.levels import FILE, below, is_map
from smsl_studio.smsl.yaml_form.nodes import Node
from smsl_studio.smsl.yaml_form.spans import YamlSpans, entries

_COMMENT = re.compile(r"(?:(?<=[\s\ufeff])|(?<![\s\S]))#[^\n\r]*")
_HEAD = re.compile(r"[|>][^\n\r#]*[ \t](#[^\n\r]*)")
_Where = dict[Path, list[str]]


@dataclass(frozen=True)
class Comments:
    """The comments of a text, by the path of what they belong to."""

    over: _Where = field(default_factory=dict)
    beside: _Where = field(default_factory=dict)
    under: _Where = field(default_factory=dict)

    def above(self, path: Path, indent: str) -> Iterator[str]:
        """The lines that stand above the member at ``path``."""
        return (f"{indent}{comment}" for comment in self.over.get(path, ()))

    def below(self, path: Path, indent: str) -> Iterator[str]:
        """The lines that stand at the end of the map or list at ``path``."""
        return (f"{indent}{comment}" for comment in self.under.get(path, ()))

    def behind(self, path: Path) -> str:
        """What stands behind the member at ``path``, on its line."""
        return "".join(f"  {comment}" for comment in self.beside.get(path, ()))

    def of_elements(self, path: Path, count: int) -> bool:
        """Whether something is said of an element of the list at ``path``."""
        if not self.over and not self.beside:
            return False
        below = ((*path, str(index)) for index in range(count))
        return any(one in self.over or one in self.beside for one in below)

    def moved(self, moved: Callable[[Path], Path | None]) -> Comments:
        """The same comments at other paths; those of a path that is gone go with it."""

        def all_of(where: _Where) -> _Where:
            pairs = ((moved(path), found) for path, found in where.items())
            return {path: found for path, found in pairs if path is not None}

        return Comments(all_of(self.over), all_of(self.beside), all_of(self.under))

    @property
    def count(self) -> int:
        """How many there are."""
        every = (self.over, self.beside, self.under)
        return sum(len(found) for where in every for found in where.values())


NO_COMMENTS = Comments()


class _Leaf(NamedTuple):
    """A name or a text: where it stands, whose it is, and of what a comment above it speaks."""

    start: int
    end: int
    path: Path
    head: Path


class _Holder(NamedTuple):
    """A map or list: where it stands, whose it is, and the column of a block's members."""

    start: int
    end: int
    path: Path
    column: int | None


def comments_of(spans: YamlSpans) -> Comments:
    """The comments of a valid text."""
    text = spans.tree.text
    if "#" not in text:
        return NO_COMMENTS
    return _Finding(spans).comments


class _Finding:
    """Walks the gaps between names and values, where alone a comment can stand."""

    def __init__(self, spans: YamlSpans) -> None:
        self._text = spans.tree.text
        self._leaves: list[_Leaf] = []
        self._holders: dict[int, list[_Holder]] = {}
        """For each leaf, the maps and lists whose last leaf it is, innermost first."""
        self.comments = Comments()
        for root in spans.tree.roots:
            self._walk(root, (), FILE, ())
        self._starts = [leaf.start for leaf in self._leaves]
        at = 0
        for leaf in [*self._leaves, None]:
            for found in _COMMENT.finditer(self._text, at, leaf.start if leaf else len(self._text)):
                self._place(found.start(), found[0].rstrip())
            at = leaf.end if leaf else at

    def _walk(self, node: Node, path: Path, level: int, head: Path) -> None:
        """Note the leaves below a node; ``head`` is what a comment above the first speaks of."""
        if node.kind not in ("map", "list"):
            self._leaves.append(_Leaf(node.start, node.end, path, head))
            if header := _HEAD.match(self._text, node.start, node.end):
                self.comments.beside.setdefault(path, []).append(header[1].rstrip())
            return
        as_map = is_map(node, level)
        for member, value in entries(node, level):
            under = (*path, member.key)
            above = under if as_map and not (head and head != path) else head
            if as_map:
                self._leaves.append(_Leaf(member.key_start, member.key_end, under, above))
            self._walk(value, under, below(level, member.key), under)
            head = ()
        column = None if node.flow else node.start - self._text.rfind("\n", 0, node.start) - 1
        holder = _Holder(node.start, node.end, path, column)
        self._holders.setdefault(len(self._leaves) - 1, []).append(holder)

    def _place(self, at: int, comment: str) -> None:
        index = bisect_right(self._starts, at) - 1
        closing = self._holders.get(index, [])
        before = self._leaves[index] if index >= 0 else None
        if before and "\n" not in self._text[before.end : at]:
            path = before.path
            for holder in closing:
                if holder.column is None and holder.end <= at:
                    path = holder.path
            self.comments.beside.setdefault(path, []).append(comment)
            return
        column = at - self._text.rfind("\n", 0, at) - 1
        for holder in closing:
            if holder.end > at if holder.column is None else column >= holder.column > 0:
                self.comments.under.setdefault(holder.path, []).append(comment)
                return
        if index + 1 < len(self._leaves):
            self.comments.over.setdefault(self._leaves[index + 1].head, []).append(comment)
        else:
            self.comments.under.setdefault((), []).append(comment)
