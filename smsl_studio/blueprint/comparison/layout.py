"""Compares what is only drawing: the places and pins of states, and the lines of operations."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison.sides import BranchSides
from smsl_studio.blueprint.comparison.values import merged
from smsl_studio.blueprint.edge_layout import Edge
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.notes import NO_NOTES, Notes


def moved_states(pair: BranchSides) -> list[Address]:
    """Return the states (on the later side) that are on both sides and have another place."""
    old, new = _notes(pair.before).layout, _notes(pair.after).layout
    if old == new:
        return []
    before, after = pair.before.table, pair.after.table
    here = {pair.state(name): at for name, at in old.items() if name in before}
    stays = {pair.state(name) for name in before}
    return [
        pair.address_after(name)
        for name in merged(list(here), list(new))
        if here.get(name) != new.get(name) and name in after and name in stays
    ]


def redrawn_operations(pair: BranchSides) -> list[Address]:
    """Return the operations (on the later side) that are on both sides and have other bends, or
    their label at another place.
    """
    old, new = _notes(pair.before).edges, _notes(pair.after).edges
    if not (old or new):
        return []
    back = {_later(pair, edge): edge for edge in _edges(pair.before)}
    found = (edge for edge in _edges(pair.after) if edge in back)
    return [pair.address_after(*edge) for edge in found if old.get(back[edge]) != new.get(edge)]


def pinned_states(pair: BranchSides) -> list[Address]:
    """Return the states (on the later side) that are on both sides and are pinned on one of them
    only.
    """
    old, new = _notes(pair.before).pinned, _notes(pair.after).pinned
    if not (old or new):
        return []
    here = {pair.state(name) for name in pair.before.table}
    before = {pair.state(name) for name in old}
    names = [name for name in pair.after.table if name in here]
    return [pair.address_after(name) for name in names if (name in before) != (name in new)]


def _later(pair: BranchSides, edge: Edge) -> Edge:
    return pair.state(edge[0]), pair.operations.get(edge, edge[1])


def _edges(branch: StateBranch) -> list[Edge]:
    return [(state, name) for state, operations in branch.table.items() for name in operations]


def _notes(branch: StateBranch) -> Notes:
    return branch.notes if "_layout" in branch.fields else NO_NOTES
