"""The JSON form, ``{SB: {"HEADER": {...}, STATE: {OPERATION: TARGET}}}``. It is lossless.

The functions are those of ``forms.Form``.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from smsl_studio.smsl.json_form.reader import comments_in, form_within, parse, recover, write

if TYPE_CHECKING:
    from smsl_studio.smsl.json_form.canonical import tidy
    from smsl_studio.smsl.json_form.splice import keep_winner, reconcile

parse_json, write_json = parse, write
"""Names for callers that need this form and no other."""

__all__ = [
    "comments_in",
    "form_within",
    "keep_winner",
    "parse",
    "parse_json",
    "reconcile",
    "recover",
    "tidy",
    "write",
    "write_json",
]

# Modules for edits are loaded with the first edit, so that ``check`` starts quickly.
_OF_EDITS = {"keep_winner": "splice", "reconcile": "splice", "tidy": "canonical"}


def __getattr__(name: str) -> Any:
    if name not in _OF_EDITS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_OF_EDITS[name]}"), name)
