"""Edits of what is only drawn: notes (``_notes``), and groups (``_groups`` in ``_layout``).

``states_follow`` and ``states_gone`` are what the edits of states do to them.
"""

from __future__ import annotations

from collections.abc import Collection, Container, Iterable, Iterator, Mapping
from itertools import count
from typing import Any

from smsl_studio.blueprint.annotations import DrawnNote, Group, validated
from smsl_studio.blueprint.drawn import GROUPS, LAYOUT, NOTES
from smsl_studio.blueprint.editing.draft import Draft, branch_of
from smsl_studio.blueprint.editing.notes import plain_value
from smsl_studio.blueprint.editing.positions import point
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import EditRefused, did_you_mean

Json = Any
Values = Mapping[str, Json]
Entries = Mapping[str, Mapping[str, Json] | None]
"""New values for the fields of entries, by key. None removes a field, or the whole entry."""


def put_notes(blueprint: Blueprint, branch: str, drawn_notes: Entries) -> Blueprint:
    """Add, change or delete notes on the drawing of an SB. ``at`` is rounded as other places are.

    EditRefused if a note hangs on no state of the SB, or if its fields do not fit.
    """
    states = branch_of(blueprint, branch).table
    draft = Draft(blueprint)
    table = draft.table(branch, NOTES)
    for key, words in drawn_notes.items():
        after = _entry(table, key, words)
        if after is None:
            table.pop(key, None)
            continue
        _must_fit(DrawnNote, after, f"{NOTES} of {branch}")
        if "at" in (words or {}):
            after["at"] = point(after["at"])
        if after.get("state"):
            must_be_states(branch, states, [after["state"]])
        table[key] = after
    if not table:
        del draft.at(branch)[NOTES]
    return draft.done()


def put_groups(blueprint: Blueprint, branch: str, groups: Entries) -> Blueprint:
    """Add, change or delete groups of an SB. A state that gets into a group leaves the others, and
    a group without states is deleted.

    EditRefused if a group names no state of the SB, or if its fields do not fit.
    """
    states = branch_of(blueprint, branch).table
    draft = Draft(blueprint)
    table = layout_map(draft, branch, GROUPS)
    for key, words in groups.items():
        after = _entry(table, key, words)
        if after is None:
            table.pop(key, None)
            continue
        _must_fit(Group, after, f"{GROUPS} of {branch}")
        if "states" in (words or {}):
            must_be_states(branch, states, after["states"])
            after["states"] = list(dict.fromkeys(after["states"]))
            _leave(table, set(after["states"]), spared=key)
        table[key] = after
    if not table:
        del draft.at(branch, LAYOUT)[GROUPS]
        if not draft.at(branch, LAYOUT):
            del draft.at(branch)[LAYOUT]
    return draft.done()


def free_keys(taken: Container[str]) -> Iterator[str]:
    """Yield the numbers that are no key of another note or group."""
    return (key for key in map(str, count(1)) if key not in taken)


def states_follow(draft: Draft, branch: str, names: Mapping[str, str]) -> None:
    """Let notes and groups follow states that get other names.

    What is left of a former state with such a name does not come to the new one.
    """
    former = set(names.values()) - draft.before[branch].table.keys()
    for table in draft.tables(branch, NOTES):
        for key, note in table.items():
            if _state_of(note) in former:
                table[key] = {word: value for word, value in note.items() if word != "state"}
            elif _state_of(note) in names:
                table[key] = {**note, "state": names[note["state"]]}
    if not has_layout_map(draft, branch, GROUPS):
        return
    table = layout_map(draft, branch, GROUPS)
    for key, group in table.items():
        listed = _listed(group)
        if any(name in names or name in former for name in listed):
            kept = [names.get(name, name) for name in listed if name not in former]
            table[key] = {**group, "states": kept}


def states_gone(draft: Draft, branch: str, gone: Collection[str]) -> None:
    """Delete the notes that hang on deleted states, and take these out of their groups."""
    for table in draft.tables(branch, NOTES):
        for key, note in list(table.items()):
            if _state_of(note) in gone:
                del table[key]
        if not table:
            del draft.at(branch)[NOTES]
    if has_layout_map(draft, branch, GROUPS):
        table = layout_map(draft, branch, GROUPS)
        _leave(table, gone)
        if not table:
            del draft.at(branch, LAYOUT)[GROUPS]


def part_of(written: Values, states: Collection[str]) -> tuple[dict[str, Json], dict[str, Json]]:
    """Return the notes that hang on some states, and the groups that have no others."""
    notes, groups = _map(written, NOTES), _map(_map(written, LAYOUT), GROUPS)
    return (
        {key: note for key, note in notes.items() if _state_of(note) in states},
        {
            key: one
            for key, one in groups.items()
            if _listed(one) and all(name in states for name in _listed(one))
        },
    )


def put_pasted(draft: Draft, branch: str, value: Values, names: Mapping[str, str]) -> None:
    """Add the notes and groups of pasted states, which have other names now."""
    notes, groups = part_of(value, names.keys())
    if notes:
        table = draft.table(branch, NOTES)
        for key, note in zip(free_keys(table), notes.values(), strict=False):
            table[key] = {**note, "state": names[note["state"]]}
    if groups:
        table = layout_map(draft, branch, GROUPS)
        for key, group in zip(free_keys(table), groups.values(), strict=False):
            table[key] = {**group, "states": [names[s] for s in _listed(group)]}


def _entry(table: Values, key: str, words: Mapping[str, Json] | None) -> dict[str, Json] | None:
    """Return an entry after its change, None if it is to be deleted."""
    if words is None:
        return None
    former = table.get(key)
    after = {**(former if isinstance(former, dict) else {}), **plain_value(words)}
    return {word: value for word, value in after.items() if value is not None}


def _must_fit(kind: type[Any], entry: Values, where: str) -> None:
    faults: list[Any] = []
    validated(kind, entry, (), faults)
    if faults:
        raise EditRefused(
            f"this is no entry of {where}: {faults[0][1]}", advice="See the table of annotations."
        )


def must_be_states(branch: str, states: Mapping[str, Any], names: Iterable[str]) -> None:
    """Raise EditRefused if a name is not among the states of an SB."""
    for name in names:
        if name not in states:
            raise EditRefused(
                f"there is no state {name!r} in {branch}", advice=did_you_mean(name, states)
            )


def has_layout_map(draft: Draft, branch: str, key: str) -> bool:
    """Return whether ``_layout`` of an SB has a map under a key, such as that of its groups."""
    return any(isinstance(table.get(key), dict) for table in draft.tables(branch, LAYOUT))


def layout_map(draft: Draft, branch: str, key: str) -> dict[str, Json]:
    """Return a map of ``_layout`` for changes. EditRefused if something else stands there."""
    layout = draft.table(branch, LAYOUT)
    if not isinstance(layout.setdefault(key, {}), dict):
        raise EditRefused(
            f"{key} of {branch} is no map, so nothing can be added to it",
            draft.before.home(branch).place((branch, LAYOUT, key)),
            f"Write {key} as {{ ... }} in the text, or rename it.",
        )
    return draft.at(branch, LAYOUT, key)


def _leave(table: dict[str, Json], states: Collection[str], spared: str = "") -> None:
    """Take states out of all groups but one. A group that loses its last state is deleted."""
    for key, group in list(table.items()):
        listed = _listed(group)
        kept = [name for name in listed if name not in states]
        if key == spared or len(kept) == len(listed):
            continue
        if kept:
            table[key] = {**group, "states": kept}
        else:
            del table[key]


def _listed(group: Json) -> list[str]:
    """Return the names in a group as it is written."""
    listed = group.get("states") if isinstance(group, dict) else None
    return [name for name in listed if isinstance(name, str)] if isinstance(listed, list) else []


def _state_of(note: Json) -> str:
    """Return the state that a note hangs on as it is written."""
    state = note.get("state") if isinstance(note, dict) else None
    return state if isinstance(state, str) else ""


def _map(values: Values, key: str) -> Values:
    found = values.get(key)
    return found if isinstance(found, dict) else {}
