"""The edges of one State Branch as examples: from these values an operation leads to those."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import chain
from typing import NamedTuple

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import PlanningError
from smsl_studio.stop import heed

MOST_EDGES = 50_000
"""More examples than this are refused."""
MOST_NAMES = 500
"""More names of operations are refused."""
_BRACES = frozenset("{}")
Values = tuple[str, ...]
Edges = Mapping[str, Mapping[Values, Values]]
"""For each operation, in written order, where it leads from which values."""


class Example(NamedTuple):
    """One example."""

    operation: str
    source: Values
    target: Values


@dataclass(frozen=True)
class ExampleTable:
    """What is known of one State Branch. ``names`` has the name of the state with some values;
    ``labels`` the plain name of each fact, empty if it has none."""

    branch: str
    names: Mapping[Values, str]
    edges: Edges
    start: Values
    goal: Values | None
    labels: tuple[str, ...]

    @property
    def states(self) -> tuple[Values, ...]:
        """The values of every state, in written order."""
        return tuple(self.names)

    @property
    def alphabets(self) -> tuple[tuple[str, ...], ...]:
        """The values of each fact, in order of code points."""
        return tuple(tuple(sorted(set(column))) for column in zip(*self.names, strict=True))

    @property
    def count(self) -> int:
        """The number of edges."""
        return sum(len(own) for own in self.edges.values())

    def all_edges(self) -> Iterator[Example]:
        """Every edge, by operation."""
        for operation, own in self.edges.items():
            for source, target in own.items():
                yield Example(operation, source, target)

    def with_edge(self, operation: str, source: Values, target: Values | None) -> ExampleTable:
        """Return the table in which one edge leads elsewhere, or nowhere (None)."""
        own = dict(self.edges.get(operation, {}))
        own.pop(source, None)
        if target is not None:
            own[source] = target
        return replace(self, edges={**self.edges, operation: own})


def examples_of(blueprint: Blueprint) -> ExampleTable:
    """Return the examples of a blueprint with one State Branch.

    PlanningError if it has several, or no facts that tell its states apart.
    """
    if len(blueprint.branches) != 1:
        raise PlanningError(
            f"rules are learnt from one State Branch, and there are {len(blueprint.branches)}",
            advice="Make one of them first: smsl-studio flatten FILE -o FLAT.json.",
        )
    return _branch_examples(next(iter(blueprint.branches.values())))


def _branch_examples(branch: StateBranch) -> ExampleTable:
    if sum(map(len, branch.table.values())) > MOST_EDGES:
        raise _untold(f"there are more than {MOST_EDGES:,} operations in it")
    if len(branch.operation_names) > MOST_NAMES:
        raise _untold(f"there are more than {MOST_NAMES:,} names of operations in it")
    names: dict[Values, str] = {}
    values_of: dict[str, Values] = {}
    for name in branch.table:
        heed()
        values = tuple(branch.facts(name))
        if values in names:
            raise _untold(f"{names[values]} and {name} have the same facts")
        names[values] = name
        values_of[name] = values
    lengths = {len(values) for values in names}
    if len(lengths) != 1 or 0 in lengths:
        raise _untold("the states do not all have facts")
    if len({len(value) for values in names for value in values}) != 1:
        raise _untold("the values of the facts do not all have the same number of characters")
    braces = [
        one for one in (*branch.operation_names, *chain.from_iterable(names)) if _BRACES & set(one)
    ]
    if braces:
        raise _untold(f"{braces[0]} has braces, in which rules have parameters")
    edges: dict[str, dict[Values, Values]] = {name: {} for name in branch.operation_names}
    for name, row in branch.table.items():
        heed()
        for operation, target in row.items():
            if target not in values_of:
                raise _untold(f"{name}/{operation} leads to {target}, which is no state")
            edges[operation][values_of[name]] = values_of[target]
    labels = tuple(
        note.name if (note := branch.fact_note(digit)) and note.name else ""
        for digit in range(lengths.pop())
    )
    return ExampleTable(
        branch.name,
        names,
        edges,
        values_of[branch.initial],
        values_of.get(branch.activating),
        labels,
    )


def _untold(reason: str) -> PlanningError:
    return PlanningError(
        f"no rules can be learnt: {reason}",
        advice="Rules change facts: give each state its own values, see docs/rules.md.",
    )
