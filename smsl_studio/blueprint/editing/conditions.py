"""The facts that conditions name: every ``requires`` of an operation, every hazard, and every
property."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from smsl_studio.blueprint.address import Address, fact_text, split_fact
from smsl_studio.blueprint.editing.draft import Draft, rename_keys
from smsl_studio.blueprint.properties.follow import property_followed
from smsl_studio.blueprint.properties.formula import Term
from smsl_studio.blueprint.properties.property import KEY

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


def moved_facts(facts: Facts, moved: Mapping[tuple[str, int], tuple[str, int]]) -> Facts:
    """Return the facts of a condition at their new places (SB, digit).

    If no fact moves, the result is the same object.
    """
    texts = {}
    for text in facts:
        fact = split_fact(text)
        if fact is not None and moved.get(fact, fact) != fact:
            texts[text] = fact_text(*moved[fact])
    if not texts:
        return facts
    after = dict(facts)
    rename_keys(after, texts)
    return after


def _followed(entry: Json, word: str, follow: Callable[[Facts], Facts]) -> Json:
    facts = entry.get(word) if isinstance(entry, dict) else None
    if not isinstance(facts, dict):
        return entry
    after = follow(facts)
    return entry if after is facts else {**entry, word: after}


def properties_follow(
    draft: Draft,
    term: Callable[[Term], Term] | None = None,
    goal: Callable[[Address], Address] | None = None,
    operation: Callable[[str], str] | None = None,
) -> None:
    """Let the properties of all files follow an edit.

    ``term`` returns a comparison with its new names, ``goal`` the new address of a goal, and
    ``operation`` the new pattern of an operation. What cannot be read stays as it is.
    """
    for document in draft.before.documents:
        if not isinstance(document.values.get(KEY), list):
            continue
        # One edit may do this twice, so the second time begins with the result of the first.
        file = draft.file(document)
        after = [property_followed(entry, term, goal, operation) for entry in file[KEY]]
        if after != file[KEY]:
            file[KEY] = after
