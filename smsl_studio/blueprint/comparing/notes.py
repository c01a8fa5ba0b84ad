"""Annotations of one SB on both sides, entry by entry and field by field."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.comparing.difference import Change, Path
from smsl_studio.blueprint.comparing.file_level import changed_fields, kind_of, value_words
from smsl_studio.blueprint.comparing.sides import BranchSides
from smsl_studio.blueprint.comparing.values import alike, fields_that_differ, merged
from smsl_studio.blueprint.meaning import MEANING_FIELDS
from smsl_studio.blueprint.model import StateBranch

Json = Any


def compare_notes(pair: BranchSides) -> None:
    """``_facts``, ``_states`` and ``_operations``, and every other field as a whole."""
    for table in MEANING_FIELDS:
        one, other = pair.before.fields.get(table), pair.after.fields.get(table)
        if alike(one or None, other or None):
            continue
        if isinstance(one or {}, dict) and isinstance(other or {}, dict):
            _compare_table(pair, table, one or {}, other or {})
        else:
            _differs(pair, {table: one} if one else {}, {table: other} if other else {})
    own = (*MEANING_FIELDS, "_layout")
    _differs(
        pair,
        {k: v for k, v in pair.before.fields.items() if k not in own},
        {k: v for k, v in pair.after.fields.items() if k not in own},
    )


def _differs(pair: BranchSides, one: Mapping[str, Json], other: Mapping[str, Json]) -> None:
    at, to = pair.before.address, pair.after.address
    name = pair.after.name
    found = changed_fields(one, other, name, at.path, to.path, before=at, after=to)
    pair.sides.changes.extend(found)


def _compare_table(
    pair: BranchSides, table: str, one: Mapping[str, Json], other: Mapping[str, Json]
) -> None:
    names = _new_keys(pair, table, one, other)
    back = {new: old for old, new in names.items()}
    for key in merged([names[old] for old in one], list(other)):
        old = back.get(key, key)
        here, there = old in one, key in other
        was, now = _mapped(pair, one.get(old)), other.get(key)
        if (here and there and alike(was, now)) or _goes_with_it(pair, table, (old, key), here):
            continue
        if isinstance(was or {}, dict) and isinstance(now or {}, dict) and (was or now):
            for word, had, has in fields_that_differ(was or {}, now or {}):
                _entry(pair, table, (old, key), word, (had, has), (was or {}, now or {}))
        else:
            _entry(pair, table, (old, key), "", (here, there), ({"": was}, {"": now}))


def _entry(
    pair: BranchSides,
    table: str,
    keys: tuple[str, str],
    word: str,
    sides: tuple[bool, bool],
    values: tuple[Mapping[str, Json], Mapping[str, Json]],
) -> None:
    here, there = sides
    old, new = (side.get(word) for side in values)
    at, to = _address(pair.before.name, table, keys[0]), _address(pair.after.name, table, keys[1])
    what = "fact" if table == "_facts" else "note"
    said = f"The {word or 'note'} of {_subject(pair, table, keys[1])}"
    inner = (word,) if word else ()
    paths: list[Path] = [
        (side.name, table, key, *inner) if stands else ()
        for side, key, stands in zip((pair.before, pair.after), keys, sides, strict=True)
    ]
    pair.add(
        Change(
            kind_of(here, there),
            what,
            at,
            to,
            f"{said} {value_words(here, there, old, new)}.",
            "/".join((table, keys[1], *inner)),
            old,
            new,
            paths[0],
            paths[1],
        )
    )


def _goes_with_it(pair: BranchSides, table: str, keys: tuple[str, str], here: bool) -> bool:
    """Whether an entry came or went with its element, whose own change says enough."""
    old, new = (
        None if table == "_facts" else _stands(side, _address(side.name, table, key))
        for side, key in zip((pair.before, pair.after), keys, strict=True)
    )
    return (old, new) == ((True, False) if here else (False, True))


def _stands(branch: StateBranch, address: Address) -> bool | None:
    """Whether a state or one operation is there; None for what is neither."""
    if not address.state:
        return None
    operations = branch.table.get(address.state)
    if operations is None or not address.operation:
        return operations is not None
    return address.operation in operations


def _address(branch: str, table: str, key: str) -> Address:
    """What an entry speaks of, where that is one element; else its SB."""
    if table == "_states" and key:
        return Address(branch, key)
    if table == "_operations":
        names = Address.split(key)
        if len(names) == 2 and all(names):
            return Address(branch, *names)
    return Address(branch)


def _subject(pair: BranchSides, table: str, key: str) -> str:
    if table == "_facts":
        return f"fact {key} of {pair.after.name} (counted from 0)"
    kind = "state" if table == "_states" else "operation"
    return f"the {kind} {key} of {pair.after.name}"


def _new_keys(
    pair: BranchSides, table: str, one: Mapping[str, Json], other: Mapping[str, Json]
) -> dict[str, str]:
    """How the later side calls the elements that the entries of the earlier one speak of."""
    if table == "_facts":
        return {key: key for key in one}
    if table == "_states":
        return {key: pair.state(key) for key in one}
    everywhere = _renamed_everywhere(pair, other)
    return {key: everywhere.get(key) or _edge_key(pair, key) for key in one}


def _edge_key(pair: BranchSides, key: str) -> str:
    names = Address.split(key)
    if len(names) != 2:
        return key
    state, operation = names
    return note_key(pair.operations.get((state, operation), operation), pair.state(state))


def _renamed_everywhere(pair: BranchSides, other: Mapping[str, Json]) -> dict[str, str]:
    """Names of operations that are called by one other name at every state."""
    found: dict[str, str] = {}
    for (_, old), new in pair.operations.items():
        found[old] = "" if found.get(old, new) != new else new
    if not found:
        return {}
    left = {name for operations in pair.after.table.values() for name in operations}
    return {
        note_key(old): note_key(new)
        for old, new in found.items()
        if new and old not in left and note_key(old) not in other
    }


def _mapped(pair: BranchSides, note: Json) -> Json:
    """An entry of the earlier side, with the facts it requires as the later one calls them."""
    if isinstance(note, dict) and isinstance(note.get("requires"), dict):
        requires = {pair.sides.fact(key): value for key, value in note["requires"].items()}
        return {**note, "requires": requires}
    return note
