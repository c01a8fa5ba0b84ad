"""The facts that conditions name: every ``requires`` of an operation, and every hazard."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from smsl_studio.blueprint.editing.draft import Draft

Json = Any
Facts = dict[str, Json]
"""Facts in a condition: ``{"SB/digit": value}``."""


def conditions_follow(draft: Draft, follow: Callable[[Facts], Facts]) -> None:
    """Let the facts in ``requires`` of all SBs and in the hazards of all files follow an edit.

    ``follow`` gets the facts of one condition, and returns the same object if nothing changes.
    """
    before = draft.before
    for branch in before:
        for table in draft.tables(branch.name, "_operations"):
            for key, note in table.items():
                after = _followed(note, "requires", follow)
                if after is not note:
                    table[key] = after
    for document in before.documents:
        hazards = document.values.get("_hazards")
        if isinstance(hazards, list):
            followed = [_followed(hazard, "facts", follow) for hazard in hazards]
            if followed != hazards:
                draft.file(document)["_hazards"] = followed


def _followed(entry: Json, word: str, follow: Callable[[Facts], Facts]) -> Json:
    facts = entry.get(word) if isinstance(entry, dict) else None
    if not isinstance(facts, dict):
        return entry
    after = follow(facts)
    return entry if after is facts else {**entry, word: after}
