"""The edges for which a new name of an operation may hold: chosen ones, or all of its name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.base.words import counted


@dataclass(frozen=True)
class RenameScope:
    """Some edges of one name, and the words for them as an answer."""

    words: str
    addresses: tuple[Address, ...]


def rename_scopes(blueprint: Blueprint, chosen: Sequence[Address]) -> tuple[RenameScope, ...]:
    """Return the answers to "where?": the chosen edges, all in their SB, and all in all SBs.

    An answer that would add no edge is left out. The edges share a name and an SB.
    """
    if not chosen or not chosen[0].operation:
        return ()
    name, home = chosen[0].operation, chosen[0].branch
    every = tuple(
        Address(branch.name, state, name)
        for branch in blueprint
        for state, operations in branch.table.items()
        if name in operations
    )
    inside = tuple(one for one in every if one.branch == home)
    here = "Here only" if len(chosen) == 1 else f"These {len(chosen):,} only"
    scopes = [RenameScope(here, tuple(chosen))]
    if len(inside) > len(chosen):
        scopes.append(RenameScope(f"All {len(inside):,} in {home}", inside))
    if len(every) > len(inside):
        branches = counted(len({one.branch for one in every}), "State Branch", "State Branches")
        scopes.append(RenameScope(f"All {len(every):,} in {branches}", every))
    return tuple(scopes)
