"""Edits of targets and of order: retarget and reorder."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing.bends import edges_forgotten
from smsl_studio.blueprint.editing.draft import Draft, existing
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
        existing(blueprint, one)
        if not one.operation:
            raise EditRefused(f"{one} is no operation", advice="Choose an operation.")
        table = blueprint[one.branch].table
        if target not in table:
            raise EditRefused(
                f"there is no state {target!r} in {one.branch}",
                advice=did_you_mean(target, table),
            )
    draft = Draft(blueprint)
    for one in addresses:
        if blueprint[one.branch].table[one.state][one.operation] != target:
            draft.at(one.branch, one.state)[one.operation] = target
            edges_forgotten(draft, one.branch, [(one.state, one.operation)])
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


def _stays(key: str, depth: int) -> bool:
    return key.startswith("_") or (key == HEADER and depth == 1)


def _sort(inner: dict[str, object], order: Iterable[str]) -> None:
    values = dict(inner)
    inner.clear()
    inner.update((key, values[key]) for key in order)
