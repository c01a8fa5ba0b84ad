"""Edits of pins: states that stay where they are when the drawing is tidied.

``pins_follow`` and ``pins_gone`` are what the edits of states do to them.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from smsl_studio.blueprint.drawn import LAYOUT
from smsl_studio.blueprint.edge_layout import Point, point_of
from smsl_studio.blueprint.editing.draft import Draft, branch_of, rename_keys
from smsl_studio.blueprint.editing.positions import point
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.pins import PINNED
from smsl_studio.errors import EditRefused, did_you_mean

Json = Any


def pin(blueprint: Blueprint, branch: str, positions: Mapping[str, Point]) -> Blueprint:
    """Pin states where they stand.

    ``positions`` has the states and the places at which they are drawn (pixels at 100 % zoom). A
    place is written only if ``_layout`` has none. EditRefused if there is no such state.
    """
    states = branch_of(blueprint, branch).table
    for state in positions:
        if state not in states:
            raise EditRefused(
                f"there is no state {state!r} in {branch}", advice=did_you_mean(state, states)
            )
    if not positions:
        return blueprint
    draft = Draft(blueprint)
    table = draft.table(branch, LAYOUT)
    for state, at in positions.items():
        if point_of(table.get(state)) is None:
            table[state] = point(at)
    pins = _pins(draft, branch)
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
    if not _has_pins(draft, branch):
        return
    table = _pins(draft, branch)
    for key in (set(names.values()) - draft.before[branch].table.keys()) & table.keys():
        del table[key]
    rename_keys(table, names)


def pins_gone(draft: Draft, branch: str, gone: Collection[str]) -> None:
    """Remove the pins of some states, and the map of pins with the last one."""
    if not _has_pins(draft, branch):
        return
    table = _pins(draft, branch)
    for state in gone:
        table.pop(state, None)
    if not table:
        del draft.at(branch, LAYOUT)[PINNED]


def put_pins(draft: Draft, branch: str, pins: Mapping[str, Json]) -> None:
    """Write the pins of new states."""
    if pins:
        _pins(draft, branch).update(pins)


def _has_pins(draft: Draft, branch: str) -> bool:
    return any(isinstance(table.get(PINNED), dict) for table in draft.tables(branch, LAYOUT))


def _pins(draft: Draft, branch: str) -> dict[str, Json]:
    """Return the pins of an SB for changes. EditRefused if something else stands there."""
    layout = draft.table(branch, LAYOUT)
    if not isinstance(layout.setdefault(PINNED, {}), dict):
        raise EditRefused(
            f"{PINNED} of {branch} is no map, so no state can be pinned",
            draft.before.home(branch).place((branch, LAYOUT, PINNED)),
            f"Write {PINNED} as {{ ... }} in the text, or remove it.",
        )
    return draft.at(branch, LAYOUT, PINNED)
