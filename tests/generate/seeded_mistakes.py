"""One mistake in a table of edges, drawn at random."""

from __future__ import annotations

import random
from typing import Literal

from smsl_studio.generate.examples.table import Example, ExampleTable

Kind = Literal["deleted", "elsewhere", "renamed", "added"]
KINDS: tuple[Kind, ...] = ("deleted", "elsewhere", "renamed", "added")


def mistaken(table: ExampleTable, kind: Kind, rng: random.Random) -> ExampleTable | None:
    """The table with one edge that is gone, leads elsewhere, has the name of another operation, or
    is too much. None if the state that was drawn has every operation."""
    edge = rng.choice(sorted(table.all_edges()))
    if kind == "added":
        edge = Example("", rng.choice(table.states), rng.choice(table.states))
    operation, source, target = edge
    if kind == "deleted":
        return table.with_edge(operation, source, None)
    if kind == "elsewhere":
        others = [values for values in table.states if values != target]
        return table.with_edge(operation, source, rng.choice(others))
    free = [name for name, own in table.edges.items() if source not in own]
    if not free:
        return None
    rest = table.with_edge(operation, source, None) if kind == "renamed" else table
    return rest.with_edge(rng.choice(free), source, target)
