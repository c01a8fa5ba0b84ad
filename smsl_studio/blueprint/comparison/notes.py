"""Compares the annotations of one SB, entry by entry and field by field."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.comparison.difference import Change, Path
from smsl_studio.blueprint.comparison.drawn_words import drawn_words
from smsl_studio.blueprint.comparison.file_level import changed_fields, kind_of, value_words
from smsl_studio.blueprint.comparison.sides import BranchSides
from smsl_studio.blueprint.comparison.values import fields_that_differ, merged
from smsl_studio.blueprint.drawn import GROUPS, LAYOUT, NOTES, written_groups
from smsl_studio.blueprint.meaning import (
    AS_WRITTEN,
    MEANING_FIELDS,
    note_meaning,
    notes_meaning,
)
from smsl_studio.blueprint.model import StateBranch

Json = Any


def compare_notes(pair: BranchSides) -> None:
    """Compare ``_facts``, ``_states`` and ``_operations`` by their meaning, and other fields as a
    whole.

    An explicit default has no meaning. An entry that does not fit counts as it is written.
    """
    one, other = notes_meaning(pair.before), notes_meaning(pair.after)
    if one or other:
        for table in MEANING_FIELDS:
            _compare_table(pair, table, one.get(table, {}), other.get(table, {}))
        _compare_misfits(pair, one.get(AS_WRITTEN, {}), other.get(AS_WRITTEN, {}))
    own = (*MEANING_FIELDS, LAYOUT, NOTES)
    old = {key: value for key, value in pair.before.fields.items() if key not in own}
    new = {key: value for key, value in pair.after.fields.items() if key not in own}
    at, to = pair.before.address, pair.after.address
    found = changed_fields(old, new, pair.after.name, at.path, to.path, before=at, after=to)
    pair.sides.changes.extend(found)
    _compare_drawn(pair, (NOTES,), *(side.fields.get(NOTES) for side in (pair.before, pair.after)))
    _compare_drawn(pair, (LAYOUT, GROUPS), *(
        written_groups(side.fields.get(LAYOUT)) for side in (pair.before, pair.after)))  # fmt: skip


def _compare_drawn(pair: BranchSides, path: Path, old: Json, new: Json) -> None:
    """Compare the notes or the groups on the drawing one by one."""
    at, to = pair.before.address, pair.after.address
    if old == new:
        return
    *above, key = path
    where, inside = f"{pair.after.name}", above
    if all(isinstance(side, dict | None) for side in (old, new)):
        where, inside = f"{key} of {where}", [*path]
    else:
        old, new = {key: old}, {key: new}
    for change in changed_fields(
        old or {}, new or {}, where, (*at.path, *inside), (*to.path, *inside),
        before=at, after=to
    ):  # fmt: skip
        words = (
            drawn_words(key, pair.after.name, change.old, change.new) if inside == [*path] else ""
        )
        pair.sides.changes.append(replace(change, words=words) if words else change)


def _compare_table(
    pair: BranchSides, table: str, one: Mapping[str, Json], other: Mapping[str, Json]
) -> None:
    names = _new_keys(pair, table, one, other)
    back = {new: old for old, new in names.items()}
    edges = _renamed_edges(pair) if table == "_operations" else {}
    back = edges | back
    for key in merged([names[old] for old in one], list(other)):
        old = back.get(key, key)
        was, now = _mapped(pair, one.get(old, {})), other.get(key, {})
        if _goes_with_it(pair, table, (old, key), old in one):
            continue
        if key in edges and (old in one) is not (key in other):
            # One edge got a name of its own: what it had from the name alone stands in its entry.
            was, now = _mapped(pair, _whole(pair.before, old)), _whole(pair.after, key)
        for word, had, has in fields_that_differ(was, now):
            _entry(pair, table, (old, key), word, (had, has), (was, now))


def _renamed_edges(pair: BranchSides) -> dict[str, str]:
    """Return the earlier key of each edge that has another name now."""
    return {
        note_key(new, pair.state(state)): note_key(old, state)
        for (state, old), new in pair.operations.items()
    }


def _whole(branch: StateBranch, key: str) -> dict[str, Json]:
    """Return all that the entry of an edge says, with what it has from its name."""
    names = Address.split(key)
    return note_meaning(branch.notes.operation(*names)) if len(names) == 2 else {}


def _compare_misfits(pair: BranchSides, one: Mapping[str, str], other: Mapping[str, str]) -> None:
    for key, here, there in fields_that_differ(one, other):
        old, new = one.get(key), other.get(key)
        path = tuple(key.split("/", 1))
        pair.add(
            Change(
                kind_of(here, there),
                "note",
                pair.before.address,
                pair.after.address,
                f"The entry {key} of {pair.after.name}, which does not fit, "
                f"{value_words(here, there, old, new)}.",
                key,
                old,
                new,
                (pair.before.name, *path) if here else (),
                (pair.after.name, *path) if there else (),
            )
        )


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
    at, to = _element(pair.before, table, keys[0]), _element(pair.after, table, keys[1])
    key = keys[1] if there else keys[0]
    what = "fact" if table == "_facts" else "note"
    said = f"The {word} of {_subject(pair, table, key)}"
    paths: list[Path] = [
        (side.name, table, _written_at(side, table, own, word), word) if stands else ()
        for side, own, stands in zip((pair.before, pair.after), keys, sides, strict=True)
    ]
    pair.add(
        Change(
            kind_of(here, there),
            what,
            at,
            to,
            f"{said} {value_words(here, there, old, new)}.",
            "/".join((table, key, word)),
            old,
            new,
            paths[0],
            paths[1],
        )
    )


def _written_at(branch: StateBranch, table: str, key: str, word: str) -> str:
    """Return the key of the entry with this word: that of an edge, or that of its name."""
    if table != "_operations" or word in branch.notes.written.get(key, ()):
        return key
    return note_key(Address.split(key)[-1])


def _goes_with_it(pair: BranchSides, table: str, keys: tuple[str, str], here: bool) -> bool:
    """Return whether an entry was added or removed together with its element. The change of the
    element is then sufficient.
    """
    old, new = (
        None if table == "_facts" else _stands(side, _address(side.name, table, key))
        for side, key in zip((pair.before, pair.after), keys, strict=True)
    )
    return (old, new) == ((True, False) if here else (False, True))


def _stands(branch: StateBranch, address: Address) -> bool | None:
    """Return whether a state or one operation exists, None for another address."""
    if not address.state:
        return None
    operations = branch.table.get(address.state)
    if operations is None or not address.operation:
        return operations is not None
    return address.operation in operations


def _element(branch: StateBranch, table: str, key: str) -> Address:
    """Return the element of an entry if it exists, else its SB."""
    address = _address(branch.name, table, key)
    return address if _stands(branch, address) else branch.address


def _address(branch: str, table: str, key: str) -> Address:
    """Return the state or the single operation of an entry, even if it does not exist, else its
    SB.
    """
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
    """Return the keys of the later side for the entries of the earlier one."""
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
    """Return the operation names that were renamed in the same way in every state."""
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
    """Return an entry of the earlier side, with required facts by their names on the later side."""
    if isinstance(note, dict) and isinstance(note.get("requires"), dict):
        requires = {pair.sides.fact(key): value for key, value in note["requires"].items()}
        return {**note, "requires": requires}
    return note
