"""What leads to the elements of three versions, and what is noted about them.

Each answer is looked up in an index that is made once, because a version may have deleted very many
elements.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.edge_layout import IN_LAYOUT
from smsl_studio.blueprint.merge.conflict import Path
from smsl_studio.blueprint.merge.trees import Trees
from smsl_studio.blueprint.reading import HEADER

LAYOUT, LEVELS = "_layout", "_levels"
Index = dict[str, list[Path]]


class Incidence:
    """Answers from the values as they were before the merge (see ``Trees``)."""

    def __init__(self, trees: Trees) -> None:
        self._trees = trees
        self._into, self._notes = cache(self._all_into), cache(self._all_notes)
        self._subs, self._levels = cache(self._all_subs), cache(self._all_levels)

    def ways_into(self, at: int, branch: str, state: str) -> Sequence[Path]:
        """Return the operations of a version that lead to a state, in written order."""
        return self._into(at, branch).get(state, ())

    def notes_of(self, at: int, branch: str, state: str) -> Iterator[Path]:
        """Yield the annotations of a version about a state's operations, and the notes on it."""
        operations, notes = self._notes(at, branch)
        yield from operations.get(state, ())
        yield from self._levels(at).get((branch, state), ())
        yield from notes.get(state, ())

    def bases_of(self, at: int, sub: str) -> Sequence[Path]:
        """Return the entries of SUB_SBS of a version that name an SB."""
        return self._subs(at).get(sub, ())

    def _all_into(self, at: int, branch: str) -> Index:
        found: Index = {}
        for source in self._trees.states(at, branch):
            for operation, target in self._trees.map(at, (branch, source)).items():
                if isinstance(target, str):
                    found.setdefault(target, []).append((branch, source, operation))
        return found

    def _all_notes(self, at: int, branch: str) -> tuple[Index, Index]:
        operations: Index = {}
        for key in self._trees.map(at, (branch, "_operations")):
            if "/" in key:
                path = branch, "_operations", key
                operations.setdefault(Address.split(key)[0], []).append(path)
        for key in self._trees.map(at, (branch, LAYOUT, IN_LAYOUT)):
            place = branch, LAYOUT, IN_LAYOUT, key
            operations.setdefault(Address.split(key)[0], []).append(place)
        notes: Index = {}
        for key, note in self._trees.map(at, (branch, "_notes")).items():
            state = note.get("state") if isinstance(note, dict) else None
            if isinstance(state, str):
                notes.setdefault(state, []).append((branch, "_notes", key))
        return operations, notes

    def _all_levels(self, at: int) -> dict[tuple[str, ...], list[Path]]:
        found: dict[tuple[str, ...], list[Path]] = {}
        for key in self._trees.map(at, (LEVELS,)):
            if key.count("/") > 1:
                found.setdefault(Address.split(key)[:2], []).append((LEVELS, key))
        return found

    def _all_subs(self, at: int) -> Index:
        found: Index = {}
        for base in self._trees.branches():
            for sub in self._trees.map(at, (base, HEADER, "SUB_SBS")):
                found.setdefault(sub, []).append((base, HEADER, "SUB_SBS", sub))
        return found
