"""The entries of ``_operations`` for edges: for all edges of a name, or for one edge alone."""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.annotations import PLAIN, OperationNote
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.features.draw.panels.note_form import NoteEntry, misfits_of, written_words

TABLE = "_operations"
NONE: frozenset[str] = frozenset()
SHORT = 8


def entries_of(blueprint: Blueprint, edges: Sequence[Address], only_here: bool) -> list[NoteEntry]:
    """The entry of every edge (``only_here``) or of every operation name, each once."""
    found: dict[tuple[str, str], NoteEntry] = {}
    odd = {name: misfits_of(blueprint[name], TABLE) for name in {at.branch for at in edges}}
    for edge in edges:
        key = note_key(edge.operation, edge.state if only_here else "")
        if (edge.branch, key) not in found:
            entry = _entry(blueprint, edge, key, odd[edge.branch].get(key, {}), only_here)
            found[edge.branch, key] = entry
    return list(found.values())


def noted_edges(blueprint: Blueprint, edges: Sequence[Address]) -> list[Address]:
    """The edges that have an entry of their own."""
    return [
        edge
        for edge in edges
        if note_key(edge.operation, edge.state) in _written(blueprint, edge.branch)
    ]


def _entry(
    blueprint: Blueprint, edge: Address, key: str, misfits: dict[str, str], only_here: bool
) -> NoteEntry:
    branch = blueprint[edge.branch]
    operations = branch.notes.operations
    note: OperationNote = operations.get(key, PLAIN)
    words = written_words(branch, TABLE, key) if key in _written(blueprint, edge.branch) else NONE
    written = words - set(misfits)
    if not only_here:
        return NoteEntry(edge.branch, key, note, PLAIN, written, misfits=misfits)
    name = note_key(edge.operation)
    common, said = operations.get(name, PLAIN), branch.notes.written.get(name, NONE)
    # A long name would leave no room for the value next to it.
    origin = f"all {edge.operation}" if len(edge.operation) <= SHORT else "all edges"
    return NoteEntry(edge.branch, key, note, common, written, origin, said, misfits)


def _written(blueprint: Blueprint, branch: str) -> dict[str, object]:
    table = blueprint[branch].fields.get(TABLE)
    return table if isinstance(table, dict) else {}
