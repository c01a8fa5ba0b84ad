"""Where things stand in a YAML text; one that is no YAML has places for what can be read of it."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from smsl_studio.smsl.document import Member, Path
from smsl_studio.smsl.yaml_form.levels import FILE, below, is_map, members
from smsl_studio.smsl.yaml_form.nodes import Tree, YamlNode


class YamlSpans:
    """The spans of one text by its tree; its maps are listed when asked for."""

    def __init__(self, tree: Tree) -> None:
        self.tree = tree
        self._listed: dict[Path, tuple[tuple[Member, YamlNode], ...]] = {}
        self._last: dict[Path, dict[str, YamlNode]] = {}

    @cached_property
    def root(self) -> int:
        """The offset at which the content begins."""
        text = self.tree.text
        if self.tree.roots:
            return self.tree.roots[0].start
        return len(text) - len(text.removeprefix("\ufeff").lstrip())

    def members(self, path: Path) -> tuple[Member, ...]:
        """See ``Spans``."""
        return tuple(member for member, _ in self.listed(path))

    def doubles(self) -> Iterator[tuple[Path, tuple[int, ...]]]:
        """See ``Spans``."""
        return self._doubles((), FILE, self.listed(()))

    def listed(self, path: Path) -> tuple[tuple[Member, YamlNode], ...]:
        """The members of the map or list at ``path``, each with the node of its value."""
        if path not in self._listed:
            self._listed[path] = self._list(path)
        return self._listed[path]

    def _list(self, path: Path) -> tuple[tuple[Member, YamlNode], ...]:
        if not path:
            return tuple(one for root in self.tree.roots for one in entries(root, FILE))
        above = path[:-1]
        if above not in self._last:
            self._last[above] = {member.key: node for member, node in self.listed(above)}
        node, level = self._last[above][path[-1]], FILE
        for key in path:
            level = below(level, key)
        if not _holds_members(node, level):
            raise KeyError(path)
        return tuple(entries(node, level))

    def _doubles(
        self, path: Path, level: int, listed: tuple[tuple[Member, YamlNode], ...]
    ) -> Iterator[tuple[Path, tuple[int, ...]]]:
        places: dict[str, list[int]] = {}
        for member, _ in listed:
            places.setdefault(member.key, []).append(member.key_start)
        for key, found in places.items():
            if len(found) > 1:
                yield (*path, key), tuple(found)
        for member, node in listed:
            under = below(level, member.key)
            if _holds_members(node, under):
                yield from self._doubles((*path, member.key), under, tuple(entries(node, under)))


def entries(node: YamlNode, level: int) -> Iterator[tuple[Member, YamlNode]]:
    """The members of a map, or the elements of a list, each with the node of its value."""
    if is_map(node, level):
        for key, value in members(node, level):
            if key.real.kind == "text":
                yield Member(key.real.value, key.start, key.end, value.start, value.end), value
    elif node.real.kind == "list":
        for index, item in enumerate(node.real.value):
            yield Member(str(index), item.start, item.start, item.start, item.end), item


def _holds_members(node: YamlNode, level: int) -> bool:
    return is_map(node, level) or node.real.kind == "list"
