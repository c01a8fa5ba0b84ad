"""The edits: pure functions from Blueprint to Blueprint. They splice the text too.

An edit raises EditRefused, with a sentence and an advice, if the result would be invalid. Then
nothing has changed. ``after.document`` always agrees with the meaning of ``after``.

Each edit is loaded when it is first used, so that programs which only offer edits start quickly.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from smsl_studio.blueprint.editing.additions import add_branch, add_operation, add_state
    from smsl_studio.blueprint.editing.deletion import delete
    from smsl_studio.blueprint.editing.excerpts import cut, excerpt
    from smsl_studio.blueprint.editing.headers import (
        attach_sub,
        detach_sub,
        keep_activating,
        set_header,
    )
    from smsl_studio.blueprint.editing.imports import set_imports
    from smsl_studio.blueprint.editing.levels import set_levels
    from smsl_studio.blueprint.editing.moves import reorder, retarget
    from smsl_studio.blueprint.editing.notes import (
        change_notes,
        keep_last,
        set_hazards,
        set_layout,
        set_note,
    )
    from smsl_studio.blueprint.editing.pasted_text import duplicate, paste
    from smsl_studio.blueprint.editing.renames import rename

__all__ = [
    "add_branch",
    "add_operation",
    "add_state",
    "attach_sub",
    "change_notes",
    "cut",
    "delete",
    "detach_sub",
    "duplicate",
    "excerpt",
    "keep_activating",
    "keep_last",
    "paste",
    "rename",
    "reorder",
    "retarget",
    "set_hazards",
    "set_header",
    "set_imports",
    "set_layout",
    "set_levels",
    "set_note",
]

_HOMES = {
    "add_branch": "additions",
    "add_operation": "additions",
    "add_state": "additions",
    "attach_sub": "headers",
    "change_notes": "notes",
    "cut": "excerpts",
    "delete": "deletion",
    "detach_sub": "headers",
    "duplicate": "pasted_text",
    "excerpt": "excerpts",
    "keep_activating": "headers",
    "keep_last": "notes",
    "paste": "pasted_text",
    "rename": "renames",
    "reorder": "moves",
    "retarget": "moves",
    "set_hazards": "notes",
    "set_header": "headers",
    "set_imports": "imports",
    "set_layout": "notes",
    "set_levels": "levels",
    "set_note": "notes",
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
