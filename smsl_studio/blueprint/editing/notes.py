"""Edits of ``_`` fields (layout, annotations, hazards) and of doubled keys."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.annotations import read_hazards
from smsl_studio.blueprint.edge_layout import Point
from smsl_studio.blueprint.editing.bends import edges_moved
from smsl_studio.blueprint.editing.draft import Draft, branch_of, document_named
from smsl_studio.blueprint.editing.positions import point
from smsl_studio.blueprint.meaning import word_for_word
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.notes import read_notes
from smsl_studio.blueprint.revision import revised
from smsl_studio.errors import EditRefused, did_you_mean
from smsl_studio.smsl.splice import keep_winner

Json = Any


def set_layout(
    blueprint: Blueprint,
    branch: str,
    positions: Mapping[str, Point],
    former: Mapping[str, Point] | None = None,
) -> Blueprint:
    """Place states (centres of nodes, pixels at 100 % zoom). Other states stay where they are.

    ``former`` has the places before, as they were drawn. With it, the bends of an operation go
    along if both of its states move by the same way.
    """
    found = branch_of(blueprint, branch)
    if not positions:
        return blueprint
    draft = Draft(blueprint)
    table = draft.table(branch, "_layout")
    for state, at in positions.items():
        _must_be_state(found, state)
        table[state] = point(at)
    if former and found.notes.edges:
        edges_moved(draft, branch, positions, former)
    return draft.done()


def set_note(
    blueprint: Blueprint, branch: str, table: str, key: str, note: Mapping[str, Json] | None
) -> Blueprint:
    """Set one entry of ``_facts``, ``_states`` or ``_operations``. None removes it.

    The key is a digit, a state's name, or an operation as ``note_key`` writes it. EditRefused if
    there is no such element or if the entry does not fit.
    """
    branch_of(blueprint, branch)
    draft = Draft(blueprint)
    if note is None:
        for present in draft.tables(branch, table):
            present.pop(key, None)
            if not present:
                del draft.at(branch)[table]
        return draft.done()
    _Noted(blueprint, branch, table).must_have(key)
    plain = plain_value(note)
    _must_fit(table, plain)
    draft.table(branch, table)[key] = plain
    return draft.done()


def change_notes(
    blueprint: Blueprint, table: str, changes: Mapping[tuple[str, str], Mapping[str, Json]]
) -> Blueprint:
    """Change fields of many entries of one table at once, as a form does.

    ``changes`` has new values for the entries (SB, key). None removes a field, and an entry without
    fields is removed. Other fields of an entry stay, even if they do not fit (rule R29).
    EditRefused if a new value does not fit, or if an entry is no map.
    """
    draft = Draft(blueprint)
    by_branch: dict[str, list[str]] = {}
    for branch, key in changes:
        by_branch.setdefault(branch, []).append(key)
    checks = {branch: _Noted(blueprint, branch, table) for branch in by_branch}
    checked: set[int] = set()
    for (branch, key), words in changes.items():
        checks[branch].must_have(key)
        if id(words) not in checked:
            checked.add(id(words))
            _must_fit(table, {w: v for w, v in words.items() if v is not None})
    for branch, keys in by_branch.items():
        entries = draft.table(branch, table)
        for key in keys:
            after = _changed(branch, table, key, entries.get(key, {}), changes[branch, key])
            if after:
                entries[key] = after
            else:
                entries.pop(key, None)
        if not entries:
            del draft.at(branch)[table]
    return draft.done()


def _changed(
    branch: str, table: str, key: str, entry: Json, words: Mapping[str, Json]
) -> dict[str, Json]:
    if not isinstance(entry, dict):
        raise EditRefused(
            f"{key} in {table} of {branch} is no map, so nothing can be added to it",
            advice="Write it as { ... } in the text.",
        )
    after = {**entry, **plain_value(words)}
    return {word: value for word, value in after.items() if value is not None or word not in words}


def set_hazards(
    blueprint: Blueprint, hazards: Sequence[Json], file: str | None = None
) -> Blueprint:
    """Set the ``_hazards`` of a file (its own, or ``file``). An empty list removes them.
    EditRefused if a new hazard does not fit.

    Hazards that were there before are not checked again; rule R29 reports them.
    """
    plain = plain_value(list(hazards))
    document = document_named(blueprint, file)
    written = document.values.get("_hazards", [])
    if not isinstance(written, list):
        raise EditRefused(
            "_hazards is no list, so nothing can be added to it",
            document.place(("_hazards",)),
            "Write _hazards as [ ... ] in the text.",
        )
    known = set(map(word_for_word, written))
    faults = read_hazards([item for item in plain if word_for_word(item) not in known])[1]
    if faults:
        raise EditRefused(f"this is no hazard: {faults[0][1]}", advice="Write a name and facts.")
    draft = Draft(blueprint)
    if plain:
        draft.file(document)["_hazards"] = plain
    else:
        draft.file(document).pop("_hazards", None)
    return draft.done()


def keep_last(blueprint: Blueprint, path: tuple[str, ...], file: str | None = None) -> Blueprint:
    """Write a doubled key once (the quick fix of R01). The last one counts, and takes the place of
    the first, so the meaning stays.

    ``path`` is one of ``document.duplicates()``, in its own document or that of ``file``.
    """
    document = document_named(blueprint, file)
    try:
        return revised(blueprint, {document: keep_winner(document, path)})
    except KeyError:
        raise EditRefused(f"nothing stands at {'/'.join(path)}") from None


def _must_fit(table: str, words: Mapping[str, Json]) -> None:
    faults = read_notes({table: {"0": plain_value(words)}}).faults if words else ()
    if faults:
        raise EditRefused(
            f"this is no entry of {table}: {faults[0][1]}", advice="See the table of annotations."
        )


class _Noted:
    """The elements that the entries of one table of an SB may name. They are collected once."""

    def __init__(self, blueprint: Blueprint, branch: str, table: str) -> None:
        self._branch, self._table = branch_of(blueprint, branch), table
        if table not in ("_facts", "_states", "_operations"):
            raise EditRefused(
                f"{table} is no table of annotations",
                advice="Choose _facts, _states or _operations.",
            )

    @cached_property
    def _names(self) -> set[str]:
        return {name for operations in self._branch.table.values() for name in operations}

    def must_have(self, key: str) -> None:
        """Raise EditRefused if no digit, state or operation has this name."""
        branch = self._branch
        if self._table == "_facts":
            self._must_be_digit(key)
        elif self._table == "_states":
            _must_be_state(branch, key)
        else:
            parts = Address.split(key)
            edge = len(parts) == 2 and parts[1] in branch.table.get(parts[0], {})
            if not edge and not (len(parts) == 1 and parts[0] in self._names):
                raise EditRefused(
                    f"there is no operation {key!r} in {branch.name}",
                    advice=did_you_mean(key, self._names),
                )

    def _must_be_digit(self, key: str) -> None:
        branch = self._branch
        count = max(branch.num_facts, branch.header.num_facts or 0)
        whole = key.isascii() and key.isdecimal() and len(key) < 7 and str(int(key)) == key
        if not (whole and int(key) < count):
            raise EditRefused(
                f"{branch.name} has {count} facts, so it has no digit {key!r}",
                advice=f"Choose a digit from 0 to {count - 1}.",
            )


def _must_be_state(branch: StateBranch, state: str) -> None:
    if state not in branch.table:
        raise EditRefused(
            f"there is no state {state!r} in {branch.name}",
            advice=did_you_mean(state, branch.table),
        )


def plain_value(value: Json) -> Json:
    """Return a value as the plain dictionaries and lists of a document."""
    if isinstance(value, Mapping):
        return {str(key): plain_value(inner) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [plain_value(inner) for inner in value]
    if isinstance(value, float) and not math.isfinite(value):
        raise EditRefused(f"{value} is no number that can be written", advice="Write a number.")
    return value
