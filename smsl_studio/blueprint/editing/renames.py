"""Renaming: everything that names the element follows."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from smsl_studio.blueprint.address import Address, fact_text, note_key, split_fact
from smsl_studio.blueprint.edge_layout import Edge
from smsl_studio.blueprint.editing.bends import edges_follow
from smsl_studio.blueprint.editing.conditions import properties_follow
from smsl_studio.blueprint.editing.draft import Draft, existing, free_name, rename_keys
from smsl_studio.blueprint.editing.drawn import states_follow
from smsl_studio.blueprint.editing.levels import levels_carried, levels_follow
from smsl_studio.blueprint.editing.open_conflicts import conflicts_follow
from smsl_studio.blueprint.editing.pins import pins_follow
from smsl_studio.blueprint.levels import digit_of
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties import StateTerm
from smsl_studio.errors import EditRefused

Json = Any


def rename(
    blueprint: Blueprint, address: Address, new_name: str, rename_everywhere: bool = False
) -> Blueprint:
    """Give an SB, a state or an operation another name, in its place. EditRefused if it is not
    free.

    For an SB, SUB_SBS, ``requires`` and hazards follow. For a state, targets, INITIAL, ACTIVATING
    and its annotations follow. For an operation only this edge changes, and it keeps what holds for
    it: what stood under its former name is written for the edge alone. With ``rename_everywhere``
    every edge of that name in the SB changes, and the annotations of the name. The keys of
    ``_levels`` always follow.
    """
    existing(blueprint, address)
    if new_name == address.path[-1]:
        return blueprint
    draft = Draft(blueprint)
    if not address.state:
        free_name(new_name, blueprint.branches, "a State Branch")
        _rename_branch(draft, address.branch, new_name)
    elif not address.operation:
        free_name(new_name, blueprint[address.branch].table, "a state")
        rename_states(draft, address.branch, {address.state: new_name})
    else:
        _rename_operation(draft, address, new_name, rename_everywhere)
    return draft.done()


def _rename_branch(draft: Draft, old: str, new: str) -> None:
    before, names = draft.before, {old: new}
    for branch in before:
        if any(sub == old for sub, _ in branch.header.sub_sbs):
            header = draft.header(branch.name)
            header["SUB_SBS"] = renamed_subs(header["SUB_SBS"], names)
        notes = branch.fields.get("_operations")
        renamed = renamed_requires(notes, names)
        if renamed != notes:
            draft.at(branch.name)["_operations"] = renamed
    for document in before.documents:
        hazards = document.values.get("_hazards")
        if isinstance(hazards, list):
            renamed = [_renamed_hazard(item, names) for item in hazards]
            if renamed != hazards:
                draft.file(document)["_hazards"] = renamed
    properties_follow(
        draft,
        lambda term: replace(term, branch=names.get(term.branch, term.branch)),
        lambda goal: replace(goal, branch=names.get(goal.branch, goal.branch)),
        lambda text: new + text[len(old) :] if text.startswith(f"{old}/") else text,
    )
    levels_follow(draft, lambda key: (new, *key[1:]) if key[0] == old else key)
    conflicts_follow(draft, lambda key: (names.get(key[0], key[0]), *key[1:]))
    rename_keys(draft.file(before.home(old)), names)


def renamed_subs(value: Json, names: Mapping[str, str]) -> Json:
    """Return SUB_SBS (a map or a list of maps) with other names for some SBs."""
    if isinstance(value, list):
        return [renamed_subs(item, names) for item in value]
    if not isinstance(value, dict):
        return value
    return {names.get(key, key): inner for key, inner in value.items()}


def renamed_requires(notes: Json, names: Mapping[str, str]) -> Json:
    """Return ``_operations`` with other names for some SBs in every ``requires``."""
    if not isinstance(notes, dict):
        return notes
    renamed = dict(notes)
    for key, note in notes.items():
        if isinstance(note, dict) and isinstance(note.get("requires"), dict):
            renamed[key] = {**note, "requires": _renamed_facts(note["requires"], names)}
    return renamed


def _renamed_hazard(hazard: Json, names: Mapping[str, str]) -> Json:
    if isinstance(hazard, dict) and isinstance(hazard.get("facts"), dict):
        return {**hazard, "facts": _renamed_facts(hazard["facts"], names)}
    return hazard


def _renamed_facts(facts: dict[str, Json], names: Mapping[str, str]) -> dict[str, Json]:
    return {_renamed_fact(key, names): value for key, value in facts.items()}


def _renamed_fact(text: str, names: Mapping[str, str]) -> str:
    fact = split_fact(text)
    return fact_text(names[fact[0]], fact[1]) if fact and fact[0] in names else text


def rename_states(draft: Draft, branch: str, names: Mapping[str, str]) -> None:
    """Give states of an SB other names in their places. All that names them follows."""
    states_renamed(draft, branch, names)
    former = set(names.values()) - draft.before[branch].table.keys()

    def follow(key: tuple[str, ...]) -> tuple[str, ...] | None:
        """Return the key of a level after the edit. One that is left of a former state goes."""
        if len(key) != 3 or key[0] != branch:
            return key
        return None if key[1] in former else (branch, names.get(key[1], key[1]), key[2])

    levels_follow(draft, follow)


def states_renamed(draft: Draft, branch: str, names: Mapping[str, str]) -> None:
    """Give states of an SB other names in their places. All that names them follows, but for
    ``_levels``.

    An entry that is left of a former state is removed if one of the states gets its name.
    """
    found = draft.before[branch]
    for state, inside in found.table.items():
        leading = {op: names[target] for op, target in inside.items() if target in names}
        if leading:
            draft.at(branch, state).update(leading)
    rename_keys(draft.at(branch), names)
    for key in ("INITIAL", "ACTIVATING"):
        named = getattr(found.header, key.lower())
        if named in names:
            draft.header(branch)[key] = names[named]
    former = set(names.values()) - found.table.keys()
    for table in draft.tables(branch, "_states", "_layout"):
        for key in former & table.keys():
            del table[key]
        rename_keys(table, names)
    states_follow(draft, branch, names)
    pins_follow(draft, branch, names)
    for table in draft.tables(branch, "_sources"):
        rename_keys(table, names)
    for table in draft.tables(branch, "_operations", "_sources"):
        moved = {}
        for key in list(table):
            state, *operation = Address.split(key)
            if len(operation) == 1 and state in former:
                del table[key]
            elif len(operation) == 1 and operation[0] in found.table.get(state, {}):
                moved[key] = note_key(operation[0], names.get(state, state))
        rename_keys(table, moved)

    def follow(edge: Edge) -> Edge | None:
        """Return a state and its operation after the renaming."""
        state, operation = edge
        if state in former:
            return None
        stands = operation in found.table.get(state, {})
        return (names.get(state, state), operation) if stands else edge

    edges_follow(draft, branch, follow)
    properties_follow(
        draft,
        lambda term: (
            replace(term, state=names.get(term.state, term.state))
            if isinstance(term, StateTerm) and term.branch == branch
            else term
        ),
        lambda goal: (
            replace(goal, state=names.get(goal.state, goal.state))
            if goal.branch == branch
            else goal
        ),
    )
    conflicts_follow(
        draft,
        lambda key: (
            (branch, names.get(key[1], key[1]), *key[2:])
            if key[0] == branch and len(key) > 1
            else key
        ),
    )


def rename_operations(
    blueprint: Blueprint, addresses: Iterable[Address], new_name: str
) -> Blueprint:
    """Give several edges of one name another name, in their places, in one or several SBs.

    What names them follows as in ``rename``. EditRefused if the name is not free in a state, or if
    the edges have several names.
    """
    chosen: dict[str, dict[str, None]] = {}
    names = set()
    for address in addresses:
        existing(blueprint, address)
        if not address.operation:
            raise EditRefused(f"{address} is no operation", advice="Choose operations.")
        names.add(address.operation)
        chosen.setdefault(address.branch, {})[address.state] = None
    if len(names) > 1:
        raise EditRefused("the operations have several names", advice="Choose those of one name.")
    old = next(iter(names), new_name)
    if old == new_name:
        return blueprint
    draft = Draft(blueprint)
    for branch, states in chosen.items():
        for state in states:
            free_name(new_name, blueprint[branch].table[state], f"in {state} an operation")
    _rename_edges(draft, chosen, old, new_name)
    return draft.done()


def _rename_operation(draft: Draft, address: Address, new: str, everywhere: bool) -> None:
    old, branch = address.operation, address.branch
    table = draft.before[branch].table
    bearers = [state for state, operations in table.items() if old in operations]
    chosen = bearers if everywhere else [address.state]
    for state in chosen:
        free_name(new, table[state], f"in {state} an operation" if everywhere else "an operation")
    _rename_edges(draft, {branch: chosen}, old, new)


def _rename_edges(draft: Draft, chosen: Mapping[str, Iterable[str]], old: str, new: str) -> None:
    """Rename the edges ``old`` of the chosen states of each SB, with their notes and levels."""
    levels: dict[tuple[str, ...], tuple[str, ...]] = {}
    carried: dict[tuple[str, ...], tuple[str, ...]] = {}
    for branch, states in chosen.items():
        found = draft.before[branch]
        unused = not any(new in operations for operations in found.table.values())
        left = {state for state, operations in found.table.items() if old in operations}
        left.difference_update(states)
        for state in states:
            rename_keys(draft.at(branch, state), {old: new})
        whole = unused and not left
        for notes in draft.tables(branch, "_operations"):
            _notes_follow(notes, list(states), old, new, whole)
        for cited in draft.tables(branch, "_sources"):
            _sources_follow(cited, list(states), old, new, whole)
        lines: dict[Edge, Edge | None] = {(state, new): None for state in states}
        lines |= {(state, old): (state, new) for state in states}
        edges_follow(draft, branch, partial(_renamed, lines))
        levels |= {(branch, state, old): (branch, state, new) for state in states}
        if not left:
            _pattern_follows(draft, branch, old, new)
        if digit_of(found, old) is None and whole:
            levels[branch, old] = (branch, new)
        elif digit_of(found, old) is None:
            carried |= {(branch, state, new): (branch, old) for state in states}
    levels_follow(draft, lambda key: levels.get(key, key))
    levels_carried(draft, carried)
    edges: dict[tuple[str, ...], tuple[str, ...]] = {
        key: name for key, name in levels.items() if len(key) == 3
    }
    conflicts_follow(draft, lambda key: edges.get(key, key))


def _pattern_follows(draft: Draft, branch: str, old: str, new: str) -> None:
    """Let the properties follow that speak of an operation, when all its edges get a name."""
    others = [one for one in draft.before if one.name != branch and old in one.operation_names]
    patterns = {f"{branch}/{old}": f"{branch}/{new}"} | ({} if others else {old: new})
    properties_follow(draft, operation=lambda text: patterns.get(text, text))


def _notes_follow(
    notes: dict[str, Json], states: Sequence[str], old: str, new: str, whole: bool
) -> None:
    """Let ``_operations`` follow when the edges ``old`` of some states get a name.

    ``whole`` is true if no other edge keeps the old name or has the new one. Then the entry of the
    name gets the new name, too. Otherwise its keys are written for each edge alone, except those
    that the entry of the new name has itself.
    """
    former, named = notes.get(note_key(old)), notes.get(note_key(new))
    if whole and named is None:
        rename_keys(notes, {note_key(old): note_key(new)})
        former = None
    carried = replaced_words(former, named)[0]
    for state in states:
        own, key = notes.get(note_key(old, state)), note_key(new, state)
        if own is None:
            # An entry at the new key is left of an edge that is gone.
            notes.pop(key, None)
        rename_keys(notes, {note_key(old, state): key})
        if carried and (own is None or isinstance(own, dict)):
            notes[key] = {**carried, **(own or {})}


def _sources_follow(
    cited: dict[str, Json], states: Sequence[str], old: str, new: str, whole: bool
) -> None:
    """Let ``_sources`` follow. Edges that get another name keep their own sources."""
    shared = cited.get(note_key(old))
    if whole:
        rename_keys(cited, {note_key(old): note_key(new)})
    for state in states:
        rename_keys(cited, {note_key(old, state): note_key(new, state)})
        if shared is not None and not whole:
            cited.setdefault(note_key(new, state), shared)


def replaced_words(former: Json, named: Json) -> tuple[dict[str, Json], tuple[str, ...]]:
    """Return the keys that an edge keeps from the entry of its former name, with their values, and
    the keys that have another value in the entry of its new name."""
    before: dict[str, Json] = former if isinstance(former, dict) else {}
    said: dict[str, Json] = named if isinstance(named, dict) else {}
    carried = {word: value for word, value in before.items() if word not in said}
    other = tuple(word for word in before if word in said and said[word] != before[word])
    return carried, other


def _renamed(lines: Mapping[Edge, Edge | None], edge: Edge) -> Edge | None:
    return lines.get(edge, edge)
