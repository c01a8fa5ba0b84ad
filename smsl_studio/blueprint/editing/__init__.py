"""The edits: pure functions from Blueprint to Blueprint. They splice the text too.

An edit raises EditRefused, with a sentence and an advice, if the result would be invalid. Then
nothing has changed. ``after.document`` always agrees with the meaning of ``after``.

Each edit is loaded when it is first used, so that programs which only offer edits start quickly.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from smsl_studio.blueprint.editing.additions import add_branch as add_branch
    from smsl_studio.blueprint.editing.additions import add_operation as add_operation
    from smsl_studio.blueprint.editing.additions import add_state as add_state
    from smsl_studio.blueprint.editing.bends import place_label as place_label
    from smsl_studio.blueprint.editing.bends import set_bends as set_bends
    from smsl_studio.blueprint.editing.bends import straighten as straighten
    from smsl_studio.blueprint.editing.deletion import delete as delete
    from smsl_studio.blueprint.editing.digits import add_fact as add_fact
    from smsl_studio.blueprint.editing.digits import delete_fact as delete_fact
    from smsl_studio.blueprint.editing.digits import move_fact as move_fact
    from smsl_studio.blueprint.editing.drawn import put_groups as put_groups
    from smsl_studio.blueprint.editing.drawn import put_notes as put_notes
    from smsl_studio.blueprint.editing.duplicates import duplicate_state as duplicate_state
    from smsl_studio.blueprint.editing.excerpts import cut as cut
    from smsl_studio.blueprint.editing.excerpts import excerpt as excerpt
    from smsl_studio.blueprint.editing.fact_table import fill_facts as fill_facts
    from smsl_studio.blueprint.editing.fact_values import rename_value as rename_value
    from smsl_studio.blueprint.editing.fact_values import set_value as set_value
    from smsl_studio.blueprint.editing.given_facts import give_facts as give_facts
    from smsl_studio.blueprint.editing.given_facts import give_values as give_values
    from smsl_studio.blueprint.editing.given_facts import keep_facts as keep_facts
    from smsl_studio.blueprint.editing.headers import attach_sub as attach_sub
    from smsl_studio.blueprint.editing.headers import detach_sub as detach_sub
    from smsl_studio.blueprint.editing.headers import keep_activating as keep_activating
    from smsl_studio.blueprint.editing.headers import set_header as set_header
    from smsl_studio.blueprint.editing.imports import set_imports as set_imports
    from smsl_studio.blueprint.editing.levels import set_levels as set_levels
    from smsl_studio.blueprint.editing.moves import move_source as move_source
    from smsl_studio.blueprint.editing.moves import reorder as reorder
    from smsl_studio.blueprint.editing.moves import retarget as retarget
    from smsl_studio.blueprint.editing.notes import change_notes as change_notes
    from smsl_studio.blueprint.editing.notes import keep_last as keep_last
    from smsl_studio.blueprint.editing.notes import set_hazards as set_hazards
    from smsl_studio.blueprint.editing.notes import set_layout as set_layout
    from smsl_studio.blueprint.editing.notes import set_note as set_note
    from smsl_studio.blueprint.editing.on_values import keep_on as keep_on
    from smsl_studio.blueprint.editing.on_values import turned_facts as turned_facts
    from smsl_studio.blueprint.editing.pasted_table import paste_states as paste_states
    from smsl_studio.blueprint.editing.pasted_text import duplicate as duplicate
    from smsl_studio.blueprint.editing.pasted_text import paste as paste
    from smsl_studio.blueprint.editing.pins import pin as pin
    from smsl_studio.blueprint.editing.pins import unpin as unpin
    from smsl_studio.blueprint.editing.properties import set_properties as set_properties
    from smsl_studio.blueprint.editing.renames import rename as rename
    from smsl_studio.blueprint.editing.renames import rename_operations as rename_operations
    from smsl_studio.blueprint.editing.templates import add_recovery as add_recovery
    from smsl_studio.blueprint.editing.templates import add_tries as add_tries
    from smsl_studio.blueprint.editing.templates import expand_fact as expand_fact

_HOMES = {
    "add_branch": "additions",
    "add_fact": "digits",
    "add_operation": "additions",
    "add_recovery": "templates",
    "add_state": "additions",
    "add_tries": "templates",
    "attach_sub": "headers",
    "change_notes": "notes",
    "cut": "excerpts",
    "delete": "deletion",
    "delete_fact": "digits",
    "detach_sub": "headers",
    "duplicate": "pasted_text",
    "duplicate_state": "duplicates",
    "excerpt": "excerpts",
    "expand_fact": "templates",
    "fill_facts": "fact_table",
    "give_facts": "given_facts",
    "keep_facts": "given_facts",
    "give_values": "given_facts",
    "keep_activating": "headers",
    "keep_on": "on_values",
    "turned_facts": "on_values",
    "keep_last": "notes",
    "move_fact": "digits",
    "move_source": "moves",
    "paste": "pasted_text",
    "paste_states": "pasted_table",
    "pin": "pins",
    "place_label": "bends",
    "put_groups": "drawn",
    "put_notes": "drawn",
    "rename": "renames",
    "rename_operations": "renames",
    "rename_value": "fact_values",
    "reorder": "moves",
    "retarget": "moves",
    "set_bends": "bends",
    "set_hazards": "notes",
    "set_header": "headers",
    "set_imports": "imports",
    "set_layout": "notes",
    "set_levels": "levels",
    "set_note": "notes",
    "set_properties": "properties",
    "set_value": "fact_values",
    "straighten": "bends",
    "unpin": "pins",
}
"""Every edit with its module. Random sequences of edits in the tests take each of them."""

__all__ = list(_HOMES)


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
