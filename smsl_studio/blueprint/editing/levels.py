"""Edits of ``_levels``: who acts, senses, inspects and supervises."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from smsl_studio.blueprint.address import Address, escape
from smsl_studio.blueprint.editing.draft import Draft, document_named
from smsl_studio.blueprint.levels import fault_of
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import EditRefused

Json = Any
Names = tuple[str, ...]


def set_levels(
    blueprint: Blueprint, levels: Mapping[str, str | None], file: str | None = None
) -> Blueprint:
    """Set levels in ``_levels`` of its own file, or of ``file``. None removes one.

    Keys are those of ``Levels``. Other entries stay, even if they do not fit (R29). EditRefused for
    an unknown key or level.
    """
    for key, level in levels.items():
        fault = None if level is None else fault_of(blueprint, key, level)
        if fault is not None:
            raise EditRefused(fault.sentence, advice=fault.advice())
    document = document_named(blueprint, file)
    written = document.values.get("_levels", {})
    if not isinstance(written, dict):
        raise EditRefused(
            "_levels is no map, so nothing can be added to it",
            document.place(("_levels",)),
            "Write _levels as { ... } in the text.",
        )
    after = {**written, **levels}
    kept = {key: level for key, level in after.items() if level is not None or key not in levels}
    draft = Draft(blueprint)
    if kept:
        draft.file(document)["_levels"] = kept
    else:
        draft.file(document).pop("_levels", None)
    return draft.done()


def levels_follow(draft: Draft, follow: Callable[[Names], Names | None]) -> None:
    """Let the keys of every ``_levels`` follow an edit of their elements.

    ``follow`` gets the names in a key: (SB, digit), (SB, operation) or (SB, state, operation). It
    returns the names after the edit, or None if the element is gone. Then its level is deleted.
    """

    def spread(names: Names) -> tuple[Names, ...]:
        """Return the names after the edit, if the element is still there."""
        now = follow(names)
        return () if now is None else (now,)

    levels_spread(draft, spread)


def levels_spread(draft: Draft, spread: Callable[[Names], Iterable[Names]]) -> None:
    """Rewrite the keys of every ``_levels`` after an edit that may turn one element into several.

    ``spread`` takes the names in a key, as ``levels_follow`` has them. It returns the names of all
    elements that get the level of this key.
    """
    for document in draft.before.documents:
        written = document.values.get("_levels")
        if not isinstance(written, dict):
            continue
        after: dict[str, Json] = {}
        for key, level in written.items():
            names = spread(Address.split(key)) if "/" in key else [(key,)]
            after |= {_key(now): level for now in names}
        if after:
            draft.file(document)["_levels"] = after
        else:
            del draft.file(document)["_levels"]


def levels_carried(draft: Draft, carried: Mapping[Names, Names]) -> None:
    """Give edges with a new name the level of their former name, unless they have another one.

    The keys are the edges (SB, state, operation) after the edit, the values their former names
    (SB, operation). ``levels_follow`` comes first.
    """
    said = [draft.file(document)["_levels"] for document in draft.before.documents
            if isinstance(document.values.get("_levels"), dict)
            and "_levels" in draft.file(document)]  # fmt: skip
    for edge, former in carried.items():
        key, common = _key(edge), _key((edge[0], edge[2]))
        if any(key in levels or common in levels for levels in said):
            continue
        source = next((levels for levels in said if _key(former) in levels), None)
        if source is not None:
            source[key] = source[_key(former)]


def _key(names: Names) -> str:
    return "/".join(map(escape, names))
