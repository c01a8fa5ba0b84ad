"""The copy of one state under a name of its own."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing.draft import branch_of, existing, free_name
from smsl_studio.blueprint.editing.notes import set_layout
from smsl_studio.blueprint.editing.pasted_text import duplicate
from smsl_studio.blueprint.editing.renames import rename
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import EditRefused


def duplicate_state(
    blueprint: Blueprint, address: Address, name: str, at: tuple[float, float] | None = None
) -> Blueprint:
    """Add a copy of a state as ``duplicate`` does, but under this name and at this place.

    EditRefused if ``address`` is no state or if the name is not free.
    """
    state = existing(blueprint, address)
    if not state.state or state.operation:
        raise EditRefused(f"{address} is no state", advice="Choose a state.")
    free_name(name, branch_of(blueprint, state.branch).table, "a state")
    after, (made,) = duplicate(blueprint, [state])
    if made.state != name:
        after = rename(after, made, name)
    if at is None:
        return after
    return set_layout(after, state.branch, {name: at}, after[state.branch].notes.layout)
