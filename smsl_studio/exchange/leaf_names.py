"""The names of the innermost states of a machine whose states stand in states."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Protocol, TypeVar

from smsl_studio.exchange.foreign_names import ForeignNames


class NestedState(Protocol):
    """A state in a state."""

    name: str
    place: tuple[int, int]

    @property
    def parent(self) -> NestedState | None:
        """The state around it."""


Leaf = TypeVar("Leaf", bound=NestedState)


def leaf_names(leaves: Sequence[Leaf], root: NestedState, names: ForeignNames) -> dict[Leaf, str]:
    """Return a name for each state. One that is not unique has the names around it before it,
    up to ``root``."""
    counts = Counter(leaf.name for leaf in leaves)
    return {
        leaf: names.of(leaf.name if counts[leaf.name] == 1 else _path(leaf, root), leaf.place)
        for leaf in leaves
    }


def _path(leaf: NestedState, root: NestedState) -> str:
    parts = [leaf.name]
    around = leaf.parent
    while around is not None and around is not root:
        parts.append(around.name)
        around = around.parent
    return ".".join(reversed(parts))
