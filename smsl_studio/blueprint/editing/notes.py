"""Edits of what stands under ``_`` keys: layout, annotations, hazards; and of doubled keys."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.annotations import FAR, read_hazards
from smsl_studio.blueprint.editing.draft import Draft, branch_of, document_named
from smsl_studio.blueprint.meaning import word_for_word
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.notes import read_notes
from smsl_studio.blueprint.revision import revised
from smsl_studio.errors import EditRefused, did_you_mean
from smsl_studio.smsl.splice import keep_winner

Json = Any


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
    branch_of(blueprint, branch)
    draft = Draft(blueprint)
    if note is None:
        for present in draft.tables(branch, table):
            present.pop(key, None)
            if not present:
                del draft.at(branch)[table]
        return draft.done()
    _Noted(blueprint, branch, table).must_have(key)
    plain = _plain(note)
    _must_fit(table, plain)
    draft.table(branch, table)[key] = plain
    return draft.done()


def change_notes(
    blueprint: Blueprint, table: str, changes: Mapping[tuple[str, str], Mapping[str, Json]]
) -> Blueprint:
    """Change words of many entries of one table at once, as a form does.

    ``changes`` has new values for entries (SB, key); None takes a word out, and an entry without
    words goes. What else stands in an entry stays, also what fits no kind (rule R29). EditRefused
    where a new value does not fit, or something else than a map stands where an entry would be.
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
    after = {**entry, **_plain(words)}
    return {word: value for word, value in after.items() if value is not None or word not in words}


def set_hazards(
    blueprint: Blueprint, hazards: Sequence[Json], file: str | None = None
) -> Blueprint:
    """Write the ``_hazards`` of a file (its own, or ``file``); an empty list removes them.

    Those that stood there before are not checked again: what did not fit is reported (R29).
    """
    plain = _plain(list(hazards))
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
    """Write a doubled key once (the quick fix of R01): the last, winning one takes the first's
    place, so that the meaning stays. ``path`` is one of ``document.duplicates()``, the document
    its own or that of ``file``.
    """
    document = document_named(blueprint, file)
    try:
        return revised(blueprint, {document: keep_winner(document, path)})
    except KeyError:
        raise EditRefused(f"nothing stands at {'/'.join(path)}") from None


def _must_fit(table: str, words: Mapping[str, Json]) -> None:
    faults = read_notes({table: {"0": _plain(words)}}).faults if words else ()
    if faults:
        raise EditRefused(
            f"this is no entry of {table}: {faults[0][1]}", advice="See the table of annotations."
        )


class _Noted:
    """What the entries of one table of an SB may speak of; names are collected once."""

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
        """EditRefused where nothing has this name (a digit, a state, an operation)."""
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


def _plain(value: Json) -> Json:
    """Maps and sequences as the plain dictionaries and lists a document holds."""
    if isinstance(value, Mapping):
        return {str(key): _plain(inner) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(inner) for inner in value]
    if isinstance(value, float) and not math.isfinite(value):
        raise EditRefused(f"{value} is no number that can be written", advice="Write a number.")
    return value
