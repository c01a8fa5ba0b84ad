"""Edits of one value in an annotation: ``_facts``, ``_states``, ``_operations``."""

from __future__ import annotations

from typing import Any, NamedTuple

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.model import Blueprint


class Spot(NamedTuple):
    """One value of one note: the SB, the table, the note's key in it, the value's name."""

    branch: str
    table: str
    key: str
    name: str


def set_note_value(blueprint: Blueprint, spot: Spot, value: Any) -> Blueprint:
    """Set one value of a note, or take it out (None); an empty note goes."""
    branch, table, key, name = spot
    notes = blueprint[branch].fields.get(table)
    note = notes.get(key) if isinstance(notes, dict) else None
    changed = dict(note) if isinstance(note, dict) else {}
    if value is None:
        changed.pop(name, None)
    else:
        changed[name] = value
    return editing.set_note(blueprint, branch, table, key, changed or None)
