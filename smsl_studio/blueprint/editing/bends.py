"""Edits of the lines of operations: their bends, and the places of their labels.

Both stand in ``_layout``, so no digest changes.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Any

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.edge_layout import (
    ASIDE,
    IN_LAYOUT,
    MOST_BENDS,
    Edge,
    EdgeLayout,
    LabelPlace,
    Point,
)
from smsl_studio.blueprint.editing.draft import Draft, branch_of, existing
from smsl_studio.blueprint.editing.positions import point, shortened
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import EditRefused

Json = Any


def set_bends(
    blueprint: Blueprint, address: Address | Sequence[Address], bends: Sequence[Point]
) -> Blueprint:
    """Lead the line of an operation through some points (pixels at 100 % zoom), in their order from
    its source. Without points it is drawn as if it was never bent. Several operations get the same.
    EditRefused for too many points.
    """
    if len(bends) > MOST_BENDS:
        raise EditRefused(
            f"a line has at most {MOST_BENDS} bends", advice="Remove one of them first."
        )
    written = [point(at) for at in bends]
    return _changed(blueprint, address, "bends", written or None)


def place_label(
    blueprint: Blueprint, address: Address | Sequence[Address], label: LabelPlace | None
) -> Blueprint:
    """Put the label of an operation beside its line. None leaves its place to the drawing.

    ``label`` is a share of the line's length and the way from there to the middle of the label
    (pixels). EditRefused if it is not on the line or too far from it.
    """
    written: Json = None
    if label is not None:
        share, x, y = label
        if not (0.0 <= share <= 1.0 and abs(x) <= ASIDE and abs(y) <= ASIDE):
            raise EditRefused(
                f"the label would be too far from the line: {label}",
                advice="Drop it nearer to its line.",
            )
        written = _label(label)
    return _changed(blueprint, address, "label", written)


def straighten(
    blueprint: Blueprint, branch: str, states: Collection[str] | None = None
) -> Blueprint:
    """Remove the bends of all lines of an SB, and the places of labels that were moved by hand.

    With ``states``, only the operations from or to one of these states change.
    """
    table = branch_of(blueprint, branch).table
    draft = Draft(blueprint)
    if states is not None:
        ends = ((a, name, b) for a, own in table.items() for name, b in own.items())
        edges_forgotten(draft, branch, [(a, o) for a, o, b in ends if a in states or b in states])
    else:
        for written in draft.tables(branch, "_layout"):
            written.pop(IN_LAYOUT, None)
    _prune(draft, branch)
    return draft.done()


def edges_follow(draft: Draft, branch: str, follow: Callable[[Edge], Edge | None]) -> None:
    """Let the lines of an SB follow an edit of its states and operations.

    ``follow`` gets a state and an operation. It returns both after the edit, or None if the line is
    to be forgotten. It also gets entries of operations that are long gone.
    """
    table = _entries(draft, branch)
    if table is None:
        return
    after: dict[str, Json] = {}
    for key, entry in table.items():
        state, *operation = Address.split(key)
        edge = (state, operation[0]) if len(operation) == 1 else None
        now = follow(edge) if edge is not None else None
        if edge is None or now == edge:
            after[key] = entry
        elif now is not None:
            after[note_key(now[1], now[0])] = entry
    table.clear()
    table.update(after)
    if not after:
        del draft.at(branch, "_layout")[IN_LAYOUT]


def edges_forgotten(draft: Draft, branch: str, gone: Iterable[Edge]) -> None:
    """Forget the lines of some operations."""
    names = set(gone)
    edges_follow(draft, branch, lambda edge: None if edge in names else edge)


def edges_moved(
    draft: Draft, branch: str, places: Mapping[str, Point], former: Mapping[str, Point]
) -> None:
    """Move the bends of each operation whose two states move by the same way. ``former`` has the
    places of the states before.
    """
    found, table = draft.before[branch], _entries(draft, branch)
    ways = {
        state: (at[0] - former[state][0], at[1] - former[state][1])
        for state, at in places.items()
        if state in former
    }
    for key, entry in (table or {}).items():
        state, operation = (*Address.split(key), "")[:2]
        layout = found.notes.edges.get((state, operation), EdgeLayout())
        target = found.table.get(state, {}).get(operation, "")
        way = ways.get(state)
        if table is None or way is None or not layout.bends or not _alike(way, ways.get(target)):
            continue
        table[key] = {**entry, "bends": [point(at) for at in layout.moved(*way).bends]}


def put_edge(draft: Draft, branch: str, edge: Edge, layout: EdgeLayout) -> None:
    """Write how the line of a new operation is drawn."""
    entry: dict[str, Json] = {}
    if layout.bends:
        entry["bends"] = [point(at) for at in layout.bends]
    if layout.label is not None:
        entry["label"] = _label(layout.label)
    table = _entries(draft, branch, make=True)
    if entry and table is not None:
        table[note_key(edge[1], edge[0])] = entry


def _alike(way: Point, other: Point | None) -> bool:
    if other is None:
        return False
    return abs(way[0] - other[0]) < 0.1 and abs(way[1] - other[1]) < 0.1


def _changed(
    blueprint: Blueprint, address: Address | Sequence[Address], word: str, value: Json
) -> Blueprint:
    addresses = [address] if isinstance(address, Address) else list(address)
    draft = Draft(blueprint)
    for one in addresses:
        existing(blueprint, one)
        if not one.operation:
            raise EditRefused(f"{one} is no operation", advice="Choose an operation.")
        table = _entries(draft, one.branch, make=value is not None)
        key = note_key(one.operation, one.state)
        if table is None:
            if value is not None:
                raise EditRefused(
                    f"{IN_LAYOUT} in _layout of {one.branch} is no map",
                    blueprint.home(one.branch).place((one.branch, "_layout", IN_LAYOUT)),
                    "Write it as { ... } in the text, or rename it.",
                )
            continue
        former = table.get(key, {})
        entry = {**former, word: value} if isinstance(former, dict) else {word: value}
        if value is None:
            del entry[word]
        if entry:
            table[key] = entry
        else:
            table.pop(key, None)
        _prune(draft, one.branch)
    return draft.done()


def _entries(draft: Draft, branch: str, make: bool = False) -> dict[str, Json] | None:
    """Return the lines of an SB for changes, None if it has none. ``make`` adds the table."""
    if make:
        draft.table(branch, "_layout").setdefault(IN_LAYOUT, {})
    layout = draft.at(branch).get("_layout")
    if not isinstance(layout, dict) or not isinstance(layout.get(IN_LAYOUT), dict):
        return None
    return draft.at(branch, "_layout", IN_LAYOUT)


def _label(label: LabelPlace) -> list[float]:
    return [shortened(label[0], 3), *point(label[1:])]


def _prune(draft: Draft, branch: str) -> None:
    """Remove the tables that an edit has emptied."""
    layout = draft.at(branch).get("_layout")
    if isinstance(layout, dict) and layout.get(IN_LAYOUT) == {}:
        layout = draft.at(branch, "_layout")
        del layout[IN_LAYOUT]
    if layout == {}:
        del draft.at(branch)["_layout"]
