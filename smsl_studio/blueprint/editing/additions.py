"""Edits that add an element."""

from __future__ import annotations

from smsl_studio.blueprint.editing.draft import Draft, branch_of, document_named, free_name
from smsl_studio.blueprint.editing.notes import point
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import HEADER
from smsl_studio.errors import EditRefused, did_you_mean


def add_branch(blueprint: Blueprint, name: str, file: str | None = None) -> Blueprint:
    """A new SB without states, behind the others of its file: the blueprint's own, or ``file``."""
    free_name(name, blueprint.branches, "a State Branch")
    draft = Draft(blueprint)
    whole = draft.file(document_named(blueprint, file))
    free_name(name, whole, "a State Branch")
    whole[name] = {HEADER: {}}
    return draft.done()


def add_state(
    blueprint: Blueprint, branch: str, name: str, at: tuple[float, float] | None = None
) -> Blueprint:
    """A new state without operations, behind the others, placed at ``at`` (pixels at 100 %).

    Any name is accepted: where its facts do not fit the SB's, inspection says so (R05).
    """
    found = branch_of(blueprint, branch)
    free_name(name, found.table, "a state")
    draft = Draft(blueprint)
    draft.at(branch)[name] = {}
    recount(draft, branch, 1)
    if at is not None:
        draft.table(branch, "_layout")[name] = point(at)
    return draft.done()


def add_operation(
    blueprint: Blueprint, branch: str, state: str, name: str, target: str
) -> Blueprint:
    """A new operation from ``state`` to ``target``, behind the state's others."""
    found = branch_of(blueprint, branch)
    for end in (state, target):
        if end not in found.table:
            raise EditRefused(
                f"there is no state {end!r} in {branch}", advice=did_you_mean(end, found.table)
            )
    free_name(name, found.table[state], "an operation")
    draft = Draft(blueprint)
    draft.at(branch, state)[name] = target
    return draft.done()


def recount(draft: Draft, branch: str, change: int) -> None:
    """Let a NUM_STATES that was right stay right."""
    before = draft.before[branch]
    if before.header.num_states == len(before.table):
        draft.header(branch)["NUM_STATES"] = len(before.table) + change
