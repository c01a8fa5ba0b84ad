"""The edits: pure functions, Blueprint in, Blueprint out, the text spliced with it.

Each refuses (EditRefused: a sentence and an advice) what would leave nonsense, and then nothing
has changed. ``after.document`` always agrees with the meaning of ``after``.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from smsl_studio.blueprint.editing.additions import add_branch, add_operation, add_state
from smsl_studio.blueprint.editing.deletion import delete
from smsl_studio.blueprint.editing.headers import (
    attach_sub,
    detach_sub,
    keep_activating,
    set_header,
)
from smsl_studio.blueprint.editing.moves import reorder, retarget
from smsl_studio.blueprint.editing.notes import (
    change_notes,
    keep_last,
    set_hazards,
    set_layout,
    set_note,
)
from smsl_studio.blueprint.editing.renames import rename

if TYPE_CHECKING:
    from smsl_studio.blueprint.editing.excerpts import cut, excerpt
    from smsl_studio.blueprint.editing.imports import set_imports
    from smsl_studio.blueprint.editing.levels import set_levels
    from smsl_studio.blueprint.editing.pasted_text import duplicate, paste

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

# No rule offers these as a fix: they are loaded when somebody asks, so that `check` starts quickly.
_ASKED_FOR = {
    "cut": "excerpts",
    "duplicate": "pasted_text",
    "excerpt": "excerpts",
    "paste": "pasted_text",
    "set_imports": "imports",
    "set_levels": "levels",
}


def __getattr__(name: str) -> Any:
    if name not in _ASKED_FOR:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_ASKED_FOR[name]}"), name)
