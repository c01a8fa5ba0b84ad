"""The places in a YAML text. For a faulty text these are the places of what can be read."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from smsl_studio.smsl.document import LatestMembers, Member, Path
from smsl_studio.smsl.yaml_form.levels import FILE, below, is_map, members
from smsl_studio.smsl.yaml_form.nodes import Tree, YamlNode


class YamlSpans:
    """The places in one text, from its tree. Each map is listed when it is first needed."""

    def __init__(self, tree: Tree) -> None:
        self.tree = tree
        self._listed: dict[Path, tuple[tuple[Member, YamlNode], ...]] = {}
        self._last: dict[Path, dict[str, YamlNode]] = {}
        self._latest_members = LatestMembers(self.members)

    @cached_property
    def root(self) -> int:
        """The offset at which the content begins."""
        text = self.tree.text
        if self.tree.roots:
            return self.tree.roots[0].start
        return len(text) - len(text.removeprefix("\ufeff").lstrip())

    def members(self, path: Path) -> tuple[Member, ...]:
        """Return the members at a path (see ``Spans``)."""
        return tuple(member for member, _ in self.listed(path))

    def member(self, path: Path) -> Member:
        """See ``Spans``."""
        return self._latest_members.member(path)

    def doubles(self) -> Iterator[tuple[Path, tuple[int, ...]]]:
        """Yield the doubled keys (see ``Spans``)."""
        listed = [(member.key, member.key_start, node) for member, node in self.listed(())]
        return _doubles((), FILE, listed)

    def listed(self, path: Path) -> tuple[tuple[Member, YamlNode], ...]:
        """Return the members of the map or list at ``path``, each with the node of its value.

        KeyError if there is no map or list.
        """
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
    path: Path, level: int, listed: list[tuple[str, int, YamlNode]]
) -> Iterator[tuple[Path, tuple[int, ...]]]:
    """Yield the doubled keys of one map and below. ``listed`` has key, offset and value of each
    member.

    No ``Member`` is made, because a file may have very many doubled keys.
    """
    if len({key for key, _, _ in listed}) < len(listed):
        places: dict[str, list[int]] = {}
        for key, start, _ in listed:
            places.setdefault(key, []).append(start)
        for key, found in places.items():
            if len(found) > 1:
                yield (*path, key), tuple(found)
    for key, _, node in listed:
        under = below(level, key)
        if is_map(node, under):
            pairs = ((name.real, name.start, value) for name, value in members(node, under))
            inside = [(name.value, at, value) for name, at, value in pairs if name.kind == "text"]
        elif node.real.kind == "list":
            inside = [(str(at), item.start, item) for at, item in enumerate(node.real.value)]
        else:
            continue
        if inside:
            yield from _doubles((*path, key), under, inside)


def entries(node: YamlNode, level: int) -> Iterator[tuple[Member, YamlNode]]:
    """Yield the members of a map, or the elements of a list, each with the node of its value."""
    if is_map(node, level):
        for key, value in members(node, level):
            if key.real.kind == "text":
                yield Member(key.real.value, key.start, key.end, value.start, value.end), value
    elif node.real.kind == "list":
        for index, item in enumerate(node.real.value):
            yield Member(str(index), item.start, item.start, item.start, item.end), item


def _holds_members(node: YamlNode, level: int) -> bool:
    return is_map(node, level) or node.real.kind == "list"
