"""Edits that add an element."""

from __future__ import annotations

from smsl_studio.blueprint.editing.bends import edges_forgotten
from smsl_studio.blueprint.editing.draft import Draft, branch_of, document_named, free_name
from smsl_studio.blueprint.editing.positions import point
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import HEADER
from smsl_studio.errors import EditRefused, did_you_mean


def add_branch(blueprint: Blueprint, name: str, file: str | None = None) -> Blueprint:
    """Return a blueprint with a new SB without states, after the others of its file. ``file`` is
    the blueprint's own by default. EditRefused if the name is not free.
    """
    free_name(name, blueprint.branches, "a State Branch")
    draft = Draft(blueprint)
    whole = draft.file(document_named(blueprint, file))
    free_name(name, whole, "a State Branch")
    whole[name] = {HEADER: {}}
    return draft.done()


def add_state(
    blueprint: Blueprint, branch: str, name: str, at: tuple[float, float] | None = None
) -> Blueprint:
    """Return a blueprint with a new state without operations, after the others, at ``at`` (pixels
    at 100 %). EditRefused if the name is not free.

    Its facts need not fit those of the SB. Inspection reports that (R05).
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
    """Return a blueprint with a new operation from ``state`` to ``target``, after the state's
    others. EditRefused if a state does not exist or the name is not free.
    """
    found = branch_of(blueprint, branch)
    for end in (state, target):
        if end not in found.table:
            raise EditRefused(
                f"there is no state {end!r} in {branch}", advice=did_you_mean(end, found.table)
            )
    free_name(name, found.table[state], "an operation")
    draft = Draft(blueprint)
    draft.at(branch, state)[name] = target
    edges_forgotten(draft, branch, [(state, name)])  # of a former operation
    return draft.done()


def recount(draft: Draft, branch: str, change: int) -> None:
    """Adapt NUM_STATES if it was correct before."""
    before = draft.before[branch]
    if before.header.num_states == len(before.table):
        draft.header(branch)["NUM_STATES"] = len(before.table) + change
