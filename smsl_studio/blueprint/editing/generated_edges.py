"""Edges that a run has generated: a blueprint in memory that has them, too.

No file gets them. ``_origin`` of the State Branch says who has proposed them, so that the blueprint
counts as generated and not inspected.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing.additions import add_operation
from smsl_studio.blueprint.editing.draft import Draft
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import EditRefused

Json = Any


def with_edge(blueprint: Blueprint, edge: Address, target: str, origin: Json = None) -> Blueprint:
    """Return the blueprint with one more edge, and with its ``_origin`` if one is given.

    EditRefused if it cannot have this edge: a state does not exist, or the name is taken.
    """
    made = add_operation(blueprint, edge.branch, edge.state, edge.operation, target)
    if origin is None:
        return made
    draft = Draft(made)
    draft.at(edge.branch)["_origin"] = origin
    return draft.done()


def with_edges(blueprint: Blueprint, edges: Mapping[Address, str]) -> Blueprint:
    """Return the blueprint with these edges, each with its target. Those that it cannot have are
    left out.
    """
    for edge, target in edges.items():
        with suppress(EditRefused):
            blueprint = with_edge(blueprint, edge, target)
    return blueprint
