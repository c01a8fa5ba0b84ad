"""The levels of a file, and the kind of each: a map of names, or a list of maps in its place.

Upstream writes every map as a list of maps with one member each. On the levels that SMSL knows,
both are read alike. Below a ``_`` key, and in a header, a list is a list.
"""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.smsl.yaml_form.nodes import YamlNode
from smsl_studio.smsl.yaml_form.scalars import is_null

FILE, BRANCH, STATE, HEADER, NAME, FREE = range(6)
_NAMED = ("INITIAL", "ACTIVATING")


def below(level: int, key: str) -> int:
    """Return the level below a key."""
    if key.startswith("_") or level in (FREE, NAME):
        return FREE
    if level == FILE:
        return BRANCH
    if level == BRANCH:
        return HEADER if key == "HEADER" else STATE
    return NAME if level == STATE or key in _NAMED else FREE


def is_map(node: YamlNode, level: int) -> bool:
    """Return whether a node is read as a map on its level: it is a map, a list of maps, or
    empty.
    """
    real = node.real
    if real.kind == "map":
        return True
    if level in (FREE, NAME) or real.tag:
        return False
    return real.kind == "list" or (real.plain and is_null(real.value))


def members(node: YamlNode, level: int) -> Iterator[tuple[YamlNode, YamlNode]]:
    """Yield the names and values of a node that is read as a map (the rest: see ``strangers``)."""
    real = node.real
    if real.kind == "map":
        yield from real.value
    elif real.kind == "list":
        for item in real.value:
            if item.real.kind == "map":
                yield from item.real.value


def strangers(node: YamlNode) -> list[YamlNode]:
    """Return the elements of a list of maps that are not maps."""
    real = node.real
    return [one for one in real.value if one.real.kind != "map"] if real.kind == "list" else []
