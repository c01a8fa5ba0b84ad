"""EdgeLayout: how the line of one operation is drawn by hand. It is no part of the meaning.

``_layout`` of an SB holds it under ``_operations``, by ``State/Operation``. The name of a state
never begins with ``_``, so the places of states stand beside it as ever.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from smsl_studio.blueprint.address import Address

Json = Any
Point = tuple[float, float]
Edge = tuple[str, str]
"""A state and one of its operations."""
LabelPlace = tuple[float, float, float]
"""A share of a line's length, and how far the middle of the label is from there: x and y."""

IN_LAYOUT = "_operations"
"""The key in ``_layout`` below which the lines of operations stand."""
MOST_BENDS = 40
FAR = 1e7
"""The limit of a position in both directions (pixels)."""
ASIDE = 2_000.0
"""The limit of the distance of a label from its line, in both directions (pixels)."""
Fault = tuple[tuple[str, ...], str]


@dataclass(frozen=True, slots=True)
class EdgeLayout:
    """The bends of a line in their order from its source, and the place of its label. Pixels at
    100 % zoom.

    ``label`` is None if the label stands where there is room.
    """

    bends: tuple[Point, ...] = ()
    label: LabelPlace | None = None

    def __bool__(self) -> bool:
        return bool(self.bends) or self.label is not None

    def moved(self, dx: float, dy: float) -> EdgeLayout:
        """Return the same line elsewhere. The label goes with its line by itself."""
        return replace(self, bends=tuple((x + dx, y + dy) for x, y in self.bends))

    def scaled(self, factor: float) -> EdgeLayout:
        """Return the same line in a drawing that is larger by a factor."""
        label = self.label
        if label is not None:
            label = label[0], label[1] * factor, label[2] * factor
        return EdgeLayout(tuple((x * factor, y * factor) for x, y in self.bends), label)


def point_of(at: Json) -> Point | None:
    """Return a position ``[x, y]`` of ``_layout`` (pixels). None if it is not valid or too far
    away.
    """
    if not isinstance(at, list) or len(at) != 2 or not all(_is_number(v, FAR) for v in at):
        return None
    return float(at[0]), float(at[1])


def edge_layouts_of(raw: Json, faults: list[Fault]) -> Mapping[Edge, EdgeLayout]:
    """Return the lines in ``_operations`` of a ``_layout``. What does not fit is added to
    ``faults`` and left out; the rest of an entry counts.
    """
    path = ("_layout", IN_LAYOUT)
    if not isinstance(raw, dict):
        faults.append((path, f"{IN_LAYOUT} must be a map"))
        return {}
    found: dict[Edge, EdgeLayout] = {}
    for key, entry in raw.items():
        names = Address.split(key)
        if len(names) != 2 or not all(names):
            faults.append(((*path, key), "a line is named State/Operation"))
            continue
        layout = _edge_layout_of(entry, (*path, key), faults)
        if layout:
            found[names[0], names[1]] = layout
    return found


def _edge_layout_of(entry: Json, path: tuple[str, ...], faults: list[Fault]) -> EdgeLayout:
    if not isinstance(entry, dict):
        faults.append((path, "a line is a map with bends and label"))
        return EdgeLayout()
    for key in entry.keys() - {"bends", "label"}:
        faults.append((path, f"{key}: a line has bends and label only"))
    bends: tuple[Point, ...] = ()
    if "bends" in entry:
        read = _bends_of(entry["bends"])
        if read is None:
            faults.append((path, f"bends: at most {MOST_BENDS} positions [x, y]"))
        bends = read or ()
    label = _label_of(entry["label"]) if "label" in entry else None
    if "label" in entry and label is None:
        faults.append((path, "label: [share of the length from 0 to 1, x, y]"))
    return EdgeLayout(bends, label)


def _bends_of(raw: Json) -> tuple[Point, ...] | None:
    if not isinstance(raw, list) or len(raw) > MOST_BENDS:
        return None
    points = [point_of(at) for at in raw]
    return None if None in points else tuple(point for point in points if point is not None)


def _label_of(raw: Json) -> LabelPlace | None:
    if not isinstance(raw, list) or len(raw) != 3:
        return None
    share, x, y = raw
    if not (_is_number(share, 1.0, closed=True) and share >= 0.0):
        return None
    if not (_is_number(x, ASIDE, closed=True) and _is_number(y, ASIDE, closed=True)):
        return None
    return float(share), float(x), float(y)


def _is_number(value: Json, most: float, closed: bool = False) -> bool:
    if type(value) not in (int, float):
        return False
    return bool(abs(value) <= most if closed else abs(value) < most)
