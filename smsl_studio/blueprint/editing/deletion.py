"""Deletes elements together with everything that would point at nothing afterwards."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from smsl_studio.blueprint.address import Address, note_key, split_fact
from smsl_studio.blueprint.editing.additions import recount
from smsl_studio.blueprint.editing.bends import edges_forgotten
from smsl_studio.blueprint.editing.draft import Draft, existing
from smsl_studio.blueprint.editing.drawn import states_gone
from smsl_studio.blueprint.editing.headers import drop_sub
from smsl_studio.blueprint.editing.levels import levels_follow
from smsl_studio.blueprint.editing.pins import pins_gone
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.follow import terms_of
from smsl_studio.blueprint.properties.property import properties_of
from smsl_studio.errors import EditRefused


def delete(blueprint: Blueprint, addresses: Iterable[Address]) -> Blueprint:
    """Return the blueprint without some SBs, states and operations.

    With a state its incoming operations and its annotations are deleted. If it was initial or
    activating, INITIAL or ACTIVATING names the state that is so now. With an SB its entries in
    SUB_SBS of its bases are deleted. EditRefused if a hazard or a ``requires`` names the SB,
    because a safety condition must not disappear unnoticed.
    """
    wanted = {existing(blueprint, address) for address in addresses}
    branches = {address.branch for address in wanted if not address.state}
    states: dict[str, set[str]] = {}
    operations: dict[str, set[tuple[str, str]]] = {}
    for address in wanted:
        if address.branch in branches:
            continue
        if address.operation:
            edge = (address.state, address.operation)
            operations.setdefault(address.branch, set()).add(edge)
        elif address.state:
            states.setdefault(address.branch, set()).add(address.state)
    draft = Draft(blueprint)
    for branch, edges in operations.items():
        _delete_operations(draft, branch, edges)
    for branch, gone in states.items():
        _delete_states(draft, branch, gone)
    _delete_branches(draft, branches)
    _delete_levels(draft)
    return draft.done()


def _delete_operations(draft: Draft, branch: str, edges: Collection[tuple[str, str]]) -> None:
    for state, operation in edges:
        del draft.at(branch, state)[operation]
    for table in draft.tables(branch, "_operations"):
        for state, operation in edges:
            table.pop(note_key(operation, state), None)
    edges_forgotten(draft, branch, edges)


def _delete_states(draft: Draft, branch: str, gone: Collection[str]) -> None:
    found = draft.before[branch]
    edges = {
        (state, operation)
        for state, operations in found.table.items()
        for operation, target in operations.items()
        if (target in gone or state in gone) and operation in draft.at(branch, state)
    }
    _delete_operations(draft, branch, edges)
    for state in gone:
        del draft.at(branch)[state]
    for table in draft.tables(branch, "_states", "_layout"):
        for state in gone:
            table.pop(state, None)
    states_gone(draft, branch, gone)
    pins_gone(draft, branch, gone)
    _decide_ends(draft, branch, gone)
    recount(draft, branch, -len(gone))


def _decide_ends(draft: Draft, branch: str, gone: Collection[str]) -> None:
    """Write which state is initial or activating in the place of one that is gone.

    It is the first or the last state that is left, and not the other of the two. Where at most one
    state is left, there is nothing to decide.
    """
    found = draft.before[branch]
    left = [state for state in found.table if state not in gone]
    ends = {"INITIAL": found.initial, "ACTIVATING": found.activating}
    for key, end in ends.items():
        if end not in gone:
            continue
        if len(left) < 2:
            draft.header(branch).pop(key, None)
            continue
        others = {state for other, state in ends.items() if other != key}
        order = left if key == "INITIAL" else left[::-1]
        ends[key] = next(state for state in order if state not in others)
        draft.header(branch)[key] = ends[key]


def _delete_branches(draft: Draft, gone: Collection[str]) -> None:
    blueprint = draft.before
    for name in gone:
        del draft.file(blueprint.home(name))[name]
    for branch in blueprint:
        if branch.name in gone:
            continue
        for sub, _ in branch.header.sub_sbs:
            if sub in gone:
                drop_sub(draft, branch.name, sub)
        for key, note in branch.notes.operations.items():
            _refuse_named(gone, note.requires, f"{key} of {branch.name} requires")
    for hazard in blueprint.hazards:
        _refuse_named(gone, hazard.facts, f"the hazard {hazard.name!r} names")
    for one in properties_of(blueprint):
        goal = Address.split(one.goal)
        named = {term.branch for formula in one.formulas for term in terms_of(formula)}
        for name in (named | set(goal[:1] if len(goal) > 1 else ())) & set(gone):
            raise EditRefused(
                f"the property {one.name!r} speaks of {name}, which would be gone",
                advice="Change that property first.",
            )


def _delete_levels(draft: Draft) -> None:
    """Delete the levels of operations that are gone. A level for all operations of a name stays,
    like its note.
    """
    blueprint = draft.before

    def follow(key: tuple[str, ...]) -> tuple[str, ...] | None:
        """Return the key, or None if its element is gone."""
        branch = blueprint.branches.get(key[0])
        if branch is None:
            return key
        left = draft.file(blueprint.home(key[0])).get(key[0])
        if left is None:
            return None
        stood = len(key) == 3 and key[2] in branch.table.get(key[1], {})
        return None if stood and key[2] not in left.get(key[1], {}) else key

    if blueprint.levels:
        levels_follow(draft, follow)


def _refuse_named(gone: Collection[str], facts: Iterable[str], who: str) -> None:
    for text in facts:
        fact = split_fact(text)
        if fact and fact[0] in gone:
            raise EditRefused(
                f"{who} the fact {text}, and {fact[0]} would be gone",
                advice="Change that condition first.",
            )
