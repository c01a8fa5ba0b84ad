"""Edits of where operations start and lead, and of order: move_source, retarget and reorder."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.editing.bends import edges_forgotten
from smsl_studio.blueprint.editing.draft import Draft, existing, rename_keys
from smsl_studio.blueprint.editing.levels import Names, levels_follow
from smsl_studio.blueprint.editing.open_conflicts import conflicts_follow
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import HEADER
from smsl_studio.errors import EditRefused, did_you_mean


def retarget(blueprint: Blueprint, address: Address | Sequence[Address], target: str) -> Blueprint:
    """Let an operation, or several of one SB, lead to another state of their SB. EditRefused if one
    of them or the state does not exist.

    The bends of its line and the place of its label were made for the former way, so they go.
    """
    addresses = [address] if isinstance(address, Address) else list(address)
    for one in addresses:
        _check_ends(blueprint, one, target)
    draft = Draft(blueprint)
    for one in addresses:
        if blueprint[one.branch].table[one.state][one.operation] != target:
            draft.at(one.branch, one.state)[one.operation] = target
            edges_forgotten(draft, one.branch, [(one.state, one.operation)])
    return draft.done()


def move_source(blueprint: Blueprint, address: Address, source: str) -> Blueprint:
    """Let an operation start from another state of its SB, after the operations there. EditRefused
    if it or the state does not exist, or if an operation of its name starts there already.

    Its annotations and levels follow. The bends of its line and the place of its label were made
    for the former way, so they go.
    """
    _check_ends(blueprint, address, source)
    branch, state, operation = address.path
    table = blueprint[branch].table
    if source == state:
        return blueprint
    if operation in table[source]:
        raise EditRefused(
            f"{source} has an operation {operation!r} already",
            advice="Rename one of the two first.",
        )
    draft = Draft(blueprint)
    draft.at(branch, source)[operation] = table[state][operation]
    del draft.at(branch, state)[operation]
    for notes in draft.tables(branch, "_operations"):
        # An entry at the new key is left of an edge that is gone.
        notes.pop(note_key(operation, source), None)
        rename_keys(notes, {note_key(operation, state): note_key(operation, source)})
    edges_forgotten(draft, branch, [(state, operation), (source, operation)])
    former: Names = (branch, state, operation)
    now: Names = (branch, source, operation)
    levels_follow(draft, lambda key: now if key == former else None if key == now else key)
    conflicts_follow(draft, lambda key: now if key == former else key)
    return draft.done()


def reorder(blueprint: Blueprint, address: Address, index: int) -> Blueprint:
    """Move an element to place ``index`` (from 0) among the elements of its kind: the SBs of its
    file, the states or the operations. EditRefused for a place outside.

    Order has meaning: the first state is the default INITIAL, the last the default ACTIVATING.
    """
    existing(blueprint, address)
    draft = Draft(blueprint)
    *above, name = address.path
    inner = draft.at(*above) if above else draft.file(blueprint.home(name))
    movable = [key for key in inner if not _stays(key, len(above))]
    if not 0 <= index < len(movable):
        raise EditRefused(
            f"place {index} is outside 0 to {len(movable) - 1}",
            advice="Choose a place among the others.",
        )
    movable.remove(name)
    movable.insert(index, name)
    order = iter(movable)
    items = [key if _stays(key, len(above)) else next(order) for key in inner]
    _sort(inner, items)
    return draft.done()


def _check_ends(blueprint: Blueprint, address: Address, state: str) -> None:
    """Raise EditRefused if an address is no operation, or a name is no state of its SB."""
    existing(blueprint, address)
    if not address.operation:
        raise EditRefused(f"{address} is no operation", advice="Choose an operation.")
    table = blueprint[address.branch].table
    if state not in table:
        raise EditRefused(
            f"there is no state {state!r} in {address.branch}",
            advice=did_you_mean(state, table),
        )


def _stays(key: str, depth: int) -> bool:
    return key.startswith("_") or (key == HEADER and depth == 1)


def _sort(inner: dict[str, object], order: Iterable[str]) -> None:
    values = dict(inner)
    inner.clear()
    inner.update((key, values[key]) for key in order)
