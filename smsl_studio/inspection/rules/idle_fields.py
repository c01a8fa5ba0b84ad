"""Annotations that have no effect on an operation that only moves a sub-SB.

Such an operation runs no function of its own (docs/running.md, clause 5): its sub-SB does the work.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.model import StateBranch

PEOPLE = ("human", "shared")


def idle_actors(branch: StateBranch) -> Iterator[Operation]:
    """Yield the operations that a person should carry out, and that run nothing of their own."""
    if not branch.subs or all(n.actor not in PEOPLE for n in branch.notes.operations.values()):
        return
    for edge in branch.edges():
        if branch.operation_note(edge.source, edge.name).actor in PEOPLE and moved_sub(
            branch, edge
        ):
            yield edge


def moved_sub(branch: StateBranch, edge: Operation) -> str:
    """Return the sub-SB that an operation moves, if it does nothing else; else an empty text."""
    if edge.target not in branch.table:
        return ""
    note = branch.operation_note(edge.source, edge.name)
    if note.subs == "load" or note.binding is not None:
        return ""
    values: Mapping[int, tuple[str, str]] = dict(
        enumerate(zip(branch.facts(edge.source), branch.facts(edge.target), strict=False))
    )
    changed = [digit for digit, (before, after) in values.items() if before != after]
    return branch.subs.get(changed[0], "") if len(changed) == 1 else ""
