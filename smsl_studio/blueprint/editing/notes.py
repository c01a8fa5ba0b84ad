"""Edits of what stands under ``_`` keys: layout, annotations, hazards; and of doubled keys."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from smsl_studio.blueprint.address import note_key
from smsl_studio.blueprint.annotations import read_hazards, read_notes
from smsl_studio.blueprint.editing.draft import Draft, branch_of
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused, did_you_mean
from smsl_studio.smsl.splicing import keep_winner

Json = Any
FAR = 1e7


def set_layout(
    blueprint: Blueprint, branch: str, positions: Mapping[str, tuple[float, float]]
) -> Blueprint:
    """Place states (node centres, pixels at 100 % zoom); other states stay where they are."""
    found = branch_of(blueprint, branch)
    if not positions:
        return blueprint
    draft = Draft(blueprint)
    table = draft.table(branch, "_layout")
    for state, at in positions.items():
        _must_be_state(found, state)
        table[state] = point(at)
    return draft.done()


def point(at: tuple[float, float]) -> list[float]:
    """A position as it is written: tenths of a pixel, whole numbers without a dot."""
    if not all(math.isfinite(value) and abs(value) < FAR for value in at):
        raise EditRefused(f"the position {at} is not on the canvas", advice="Drop it nearer.")
    rounded = [round(float(value), 1) for value in at]
    return [int(value) if value == int(value) else value for value in rounded]


def set_note(
    blueprint: Blueprint, branch: str, table: str, key: str, note: Mapping[str, Json] | None
) -> Blueprint:
    """Write one entry of ``_facts``, ``_states`` or ``_operations``; None removes it.

    The key is a digit, a state's name, or an operation as ``note_key`` writes it. EditRefused
    where nothing has that name or the entry does not fit its kind.
    """
    found = branch_of(blueprint, branch)
    draft = Draft(blueprint)
    if note is None:
        for present in draft.tables(branch, table):
            present.pop(key, None)
            if not present:
                del draft.at(branch)[table]
        return draft.done()
    _must_be_noted(found, table, key)
    plain = _plain(note)
    faults = read_notes({table: {key: plain}}).faults
    if faults:
        raise EditRefused(
            f"this is no entry of {table}: {faults[0][1]}", advice="See the table of annotations."
        )
    draft.table(branch, table)[key] = plain
    return draft.done()


def set_hazards(blueprint: Blueprint, hazards: Sequence[Mapping[str, Json]]) -> Blueprint:
    """Write the file's ``_hazards``; an empty list removes them."""
    plain = _plain(list(hazards))
    faults = read_hazards(plain)[1]
    if faults:
        raise EditRefused(f"this is no hazard: {faults[0][1]}", advice="Write a name and facts.")
    draft = Draft(blueprint)
    if plain:
        draft.at()["_hazards"] = plain
    else:
        draft.at().pop("_hazards", None)
    return draft.done()


def keep_last(blueprint: Blueprint, path: tuple[str, ...]) -> Blueprint:
    """Write a doubled key once (the quick fix of R01): the last, winning one takes the first's
    place, so that the meaning stays. ``path`` is one of ``document.duplicates()``.
    """
    try:
        document = keep_winner(blueprint.document, path)
    except KeyError:
        raise EditRefused(f"nothing stands at {'/'.join(path)}") from None
    return read_blueprint(document)


def _must_be_noted(branch: StateBranch, table: str, key: str) -> None:
    if table == "_facts":
        count = max(branch.num_facts, branch.header.num_facts or 0)
        if not (key.isascii() and key.isdecimal() and str(int(key)) == key and int(key) < count):
            raise EditRefused(
                f"{branch.name} has {count} facts, so it has no digit {key!r}",
                advice=f"Choose a digit from 0 to {count - 1}.",
            )
    elif table == "_states":
        _must_be_state(branch, key)
    elif table == "_operations":
        if not any(key in _keys(state, ops) for state, ops in branch.table.items()):
            names = {name for operations in branch.table.values() for name in operations}
            raise EditRefused(
                f"there is no operation {key!r} in {branch.name}", advice=did_you_mean(key, names)
            )
    else:
        raise EditRefused(
            f"{table} is no table of annotations",
            advice="Choose _facts, _states or _operations.",
        )


def _keys(state: str, operations: Mapping[str, str]) -> set[str]:
    return {note_key(name) for name in operations} | {note_key(n, state) for n in operations}


def _must_be_state(branch: StateBranch, state: str) -> None:
    if state not in branch.table:
        raise EditRefused(
            f"there is no state {state!r} in {branch.name}",
            advice=did_you_mean(state, branch.table),
        )


def _plain(value: Json) -> Json:
    """Maps and sequences as the plain dictionaries and lists a document holds."""
    if isinstance(value, Mapping):
        return {str(key): _plain(inner) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(inner) for inner in value]
    if isinstance(value, float) and not math.isfinite(value):
        raise EditRefused(f"{value} is no number that can be written", advice="Write a number.")
    return value
