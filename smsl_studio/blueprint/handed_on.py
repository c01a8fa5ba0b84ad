"""What was worked out about an SB before an edit, and holds after it: it is not worked out again.

It is kept in the SB's own dictionary, as the ``cached_property`` itself would keep it.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import compress
from operator import is_not
from typing import cast

from smsl_studio.blueprint.drawn import LAYOUT, NOTES, written_groups
from smsl_studio.blueprint.edge_layout import IN_LAYOUT, Fault, edge_layouts_of, point_of
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.notes import Notes
from smsl_studio.blueprint.pins import PINNED, pins_of

_SHAPE = ("shape", "_facts", "alphabet")
_TABLES = ("_facts", "_states", "_operations")


def hand_on(before: StateBranch, after: StateBranch) -> None:
    """Give an SB after an edit what still holds of the one before."""
    known = before.__dict__
    same_names = list(before.table) == list(after.table)
    same_states = before.fields.get("_states") is after.fields.get("_states")
    if same_states and before.header == after.header and same_names:
        after.__dict__.update((key, known[key]) for key in _SHAPE if key in known)
    if same_names and "drawn" in known and _drawn_alike(before, after):
        after.__dict__["drawn"] = known["drawn"]
    if "notes" in known and not before.notes.faults:
        notes = _notes(before, after)
        if notes is not None:
            after.__dict__["notes"] = notes


def _drawn_alike(before: StateBranch, after: StateBranch) -> bool:
    """Whether an edit left notes and groups as they were written."""
    old, new = before.fields, after.fields
    groups = (written_groups(fields.get(LAYOUT)) for fields in (old, new))
    return old.get(NOTES) is new.get(NOTES) and next(groups) is next(groups)


def _notes(before: StateBranch, after: StateBranch) -> Notes | None:
    """The notes of an SB whose edit changed none but the places of its states; else None."""
    old, new = before.fields, after.fields
    if any(old.get(key) is not new.get(key) for key in _TABLES):
        return None
    notes, former, table = before.notes, old.get("_layout", {}), new.get("_layout", {})
    if former is table:
        return notes
    if not isinstance(table, dict):
        return None
    edges, faults = notes.edges, list[Fault]()
    if table.get(IN_LAYOUT) is not former.get(IN_LAYOUT):
        edges = edge_layouts_of(table.get(IN_LAYOUT, {}), faults)
    layout = dict(zip(table, map(notes.layout.get, table), strict=True))
    moved = list(compress(table, map(is_not, table.values(), map(former.get, table))))
    layout.update((name, point_of(table[name])) for name in moved)
    if None in layout.values():  # what is drawn besides the states has no place
        layout = {name: at for name, at in layout.items() if not name.startswith("_")}
    pinned = notes.pinned
    if pinned or PINNED in table:
        pinned = pins_of(table.get(PINNED, {}), layout, faults)
    if faults or None in layout.values():
        return None
    places = cast("dict[str, tuple[float, float]]", layout)
    return replace(notes, layout=places, edges=edges, pinned=pinned)
