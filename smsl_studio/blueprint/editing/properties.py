"""The edit of ``_properties``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from smsl_studio.blueprint.editing.draft import Draft, document_named
from smsl_studio.blueprint.editing.notes import plain_value
from smsl_studio.blueprint.meaning import word_for_word
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.meaning import meaning_of
from smsl_studio.blueprint.properties.property import KEY, read_properties
from smsl_studio.errors import EditRefused, StudioError

Json = Any


def set_properties(
    blueprint: Blueprint, properties: Sequence[Json], file: str | None = None
) -> Blueprint:
    """Set the ``_properties`` of a file (its own, or ``file``). An empty list removes them.
    EditRefused if a new property cannot be read, names what does not exist, or has the name of
    another one.

    Properties that were there before are not checked again; rule R29 reports them.
    """
    plain = plain_value(list(properties))
    document = document_named(blueprint, file)
    written = document.values.get(KEY, [])
    if not isinstance(written, list):
        raise EditRefused(
            f"{KEY} is no list, so nothing can be added to it",
            document.place((KEY,)),
            f"Write {KEY} as [ ... ] in the text.",
        )
    known = set(map(word_for_word, written))
    new = {at for at, item in enumerate(plain) if word_for_word(item) not in known}
    found, faults = read_properties(plain)
    for fault in faults:
        if int(fault.path[1]) in new:
            raise EditRefused(f"this is no property: {fault.sentence}", advice=fault.advice)
    for at, one in found.items():
        if at in new:
            _must_name_what_exists(blueprint, one.formulas, one.goal)
    draft = Draft(blueprint)
    if plain:
        draft.file(document)[KEY] = plain
    else:
        draft.file(document).pop(KEY, None)
    return draft.done()


def _must_name_what_exists(blueprint: Blueprint, formulas: Sequence[Any], goal: str) -> None:
    try:
        for formula in formulas:
            meaning_of(formula, blueprint)
        if goal:
            blueprint.resolve(goal)
    except StudioError as error:
        raise EditRefused(error.sentence, advice=error.advice) from None
