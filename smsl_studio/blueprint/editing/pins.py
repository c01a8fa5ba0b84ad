"""Edits of pins: states that stay where they are when the drawing is tidied.

``pins_follow`` and ``pins_gone`` are what the edits of states do to them.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from smsl_studio.blueprint.drawn import LAYOUT
from smsl_studio.blueprint.edge_layout import Point, point_of
from smsl_studio.blueprint.editing.draft import Draft, branch_of, rename_keys
from smsl_studio.blueprint.editing.drawn import has_layout_map, layout_map, must_be_states
from smsl_studio.blueprint.editing.positions import point
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.pins import PINNED

Json = Any


def pin(blueprint: Blueprint, branch: str, positions: Mapping[str, Point]) -> Blueprint:
    """Pin states where they stand.

    ``positions`` has the states and the places at which they are drawn (pixels at 100 % zoom). A
    place is written only if ``_layout`` has none. EditRefused if there is no such state.
    """
    states = branch_of(blueprint, branch).table
    must_be_states(branch, states, positions)
    if not positions:
        return blueprint
    draft = Draft(blueprint)
    table = draft.table(branch, LAYOUT)
    for state, at in positions.items():
        if point_of(table.get(state)) is None:
            table[state] = point(at)
    pins = layout_map(draft, branch, PINNED)
    pins.update(dict.fromkeys(positions, True))
    return draft.done()


def unpin(blueprint: Blueprint, branch: str, states: Collection[str] | None = None) -> Blueprint:
    """Let states be moved again when the drawing is tidied. Their places stay as they are.

    Without ``states`` all pins of the SB go.
    """
    branch_of(blueprint, branch)
    draft = Draft(blueprint)
    if states is None:
        for layout in draft.tables(branch, LAYOUT):
            layout.pop(PINNED, None)
            if not layout:
                del draft.at(branch)[LAYOUT]
    else:
        pins_gone(draft, branch, states)
    return draft.done()


def pins_follow(draft: Draft, branch: str, names: Mapping[str, str]) -> None:
    """Let pins follow states that get other names.

    What is left of a former state with such a name does not come to the new one.
    """
    if not has_layout_map(draft, branch, PINNED):
        return
    table = layout_map(draft, branch, PINNED)
    for key in (set(names.values()) - draft.before[branch].table.keys()) & table.keys():
        del table[key]
    rename_keys(table, names)


def pins_gone(draft: Draft, branch: str, gone: Collection[str]) -> None:
    """Remove the pins of some states, and the map of pins with the last one."""
    if not has_layout_map(draft, branch, PINNED):
        return
    table = layout_map(draft, branch, PINNED)
    for state in gone:
        table.pop(state, None)
    if not table:
        del draft.at(branch, LAYOUT)[PINNED]


def put_pins(draft: Draft, branch: str, pins: Mapping[str, Json]) -> None:
    """Write the pins of new states."""
    if pins:
        layout_map(draft, branch, PINNED).update(pins)
