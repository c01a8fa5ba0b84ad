"""The comments of a YAML text: ``#`` outside of names and values, at the start or after a space."""

from __future__ import annotations

import re

from smsl_studio.smsl.document import Path
from smsl_studio.smsl.document.comments import NO_COMMENTS, Comments, Holder, Leaf, comments_between
from smsl_studio.smsl.yaml_form.levels import FILE, below, is_map
from smsl_studio.smsl.yaml_form.nodes import YamlNode
from smsl_studio.smsl.yaml_form.spans import YamlSpans, entries

_COMMENT = re.compile(r"(?:(?<=[\s\ufeff])|(?<![\s\S]))#([^\n\r]*)")
_HEAD = re.compile(r"[|>][^\n\r#]*[ \t]#([^\n\r]*)")


def comments_of(spans: YamlSpans) -> Comments:
    """Return the comments of a valid text with their elements."""
    if "#" not in spans.tree.text:
        return NO_COMMENTS
    walk = _Walk(spans)
    found = comments_between(spans.tree.text, walk.leaves, walk.holders, _COMMENT)
    for path, words in walk.heads:
        found.beside.setdefault(path, []).append(words)
    return found


class _Walk:
    """The names, values, maps and lists of a text."""

    def __init__(self, spans: YamlSpans) -> None:
        self._text = spans.tree.text
        self.leaves: list[Leaf] = []
        self.holders: list[Holder] = []
        self.heads: list[tuple[Path, str]] = []
        """Comments behind the ``|`` or ``>`` of a text of several lines."""
        for root in spans.tree.roots:
            self._walk(root, (), FILE, ())

    def _walk(self, node: YamlNode, path: Path, level: int, head: Path) -> None:
        """Note everything below a node. ``head`` is the path of the list element that begins with
        it.
        """
        if node.kind not in ("map", "list"):
            self.leaves.append(Leaf(node.start, node.end, path, head or path))
            if header := _HEAD.match(self._text, node.start, node.end):
                self.heads.append((path, header[1].rstrip()))
            return
        as_map = is_map(node, level)
        for member, value in entries(node, level):
            under = (*path, member.key)
            if as_map:
                self.leaves.append(Leaf(member.key_start, member.key_end, under, head or under))
            inner = () if as_map else head or under
            self._walk(value, under, below(level, member.key), inner)
            head = ()
        if path and not node.value:
            self.leaves.append(Leaf(node.start, node.start + 1, path, head or path))
        column = None if node.flow else node.start - self._text.rfind("\n", 0, node.start) - 1
        self.holders.append(Holder(node.start, node.end, path, column))
