"""Clashes: one side deleted an element that the other side changed, or led to anew.

Each clash is one conflict, about the whole element. The element with all that belongs to it is
then kept as ``ours`` has it, so that no further conflict arises from it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from smsl_studio.blueprint.address import escape, note_key
from smsl_studio.blueprint.edge_layout import IN_LAYOUT
from smsl_studio.blueprint.merge.conflict import ABSENT, Attachment, Conflict, Path
from smsl_studio.blueprint.merge.incidence import LAYOUT, LEVELS, Incidence
from smsl_studio.blueprint.merge.trees import Trees
from smsl_studio.blueprint.merge.values import equal, equal_branches
from smsl_studio.blueprint.pins import PINNED

Json = Any
OURS, THEIRS = 1, 2


class Clashes:
    """Finds the clashes in three trees of values and settles them there.

    ``renamed`` has for each side the paths of the elements that it renamed.
    """

    def __init__(self, trees: Trees, renamed: tuple[frozenset[Path], frozenset[Path]]) -> None:
        self.conflicts: list[Conflict] = []
        self._trees, self._renamed = trees, renamed
        self._renamed_in = tuple(frozenset(path[0] for path in side) for side in renamed)
        self._incidence = Incidence(trees)

    def settle(self) -> None:
        """Settle all clashes: those of SBs, then of states, then of operations."""
        for branch in self._trees.branches():
            self._settle_branch(branch)
        for branch in self._trees.branches_of_all():
            for state in self._trees.states(0, branch):
                self._settle_state(branch, state)
            for state in self._trees.states(0, branch):
                self._settle_operations(branch, state)

    def _keeper(self, path: Path) -> int | None:
        """Return the side that alone still has an element of the base, None if there is none."""
        base, ours, theirs = (self._trees.get(at, path) is not ABSENT for at in range(3))
        if not base or ours == theirs:
            return None
        return OURS if ours else THEIRS

    def _add(self, path: Path, parts: Iterator[Path] = iter(())) -> None:  # noqa: B008
        """Record the conflict of an element, and keep it as ours has it."""
        found = [self._part(one) for one in dict.fromkeys(parts)]
        told = tuple(one for one in found if not one.is_equal_everywhere())
        self.conflicts.append(Conflict(path, *self._trees.values_at(path), parts=told))
        for one in (path, *(part.path for part in found)):
            self._trees.keep_ours(one)

    def _part(self, path: Path) -> Attachment:
        return Attachment(path, *self._trees.values_at(path))

    # SBs.

    def _settle_branch(self, branch: str) -> None:
        keeper = self._keeper((branch,))
        if keeper is None:
            return
        before, after = (
            {key: value for key, value in self._trees.branch(at, branch).items() if key != LAYOUT}
            for at in (0, keeper)
        )
        new = list(self._subs_that_are(keeper, branch))
        renamed = branch in self._renamed_in[keeper - 1]
        if new or not equal_branches(before, after) or renamed:
            self._add((branch,))
            for path in new:
                self._add(path)

    def _subs_that_are(self, keeper: int, branch: str) -> Iterator[Path]:
        """Yield the entries of SUB_SBS with which a side made an SB a sub-SB anew."""
        for path in self._incidence.bases_of(keeper, branch):
            if not equal(self._trees.get(keeper, path), self._trees.get(0, path)):
                yield path

    # States.

    def _settle_state(self, branch: str, state: str) -> None:
        path = (branch, state)
        keeper = self._keeper(path)
        if keeper is None:
            return
        new = list(self._edges_into(branch, state, keeper))
        changed = any(
            not equal(self._trees.get(0, one), self._trees.get(keeper, one))
            for one in (path, *self._parts_of_state(branch, state))
            if one[1] != LAYOUT
        )
        if not (new or changed or path in self._renamed[keeper - 1]):
            return
        parts = [*self._parts_of_state(branch, state)]
        parts += self._ways_in(branch, state, keeper)
        self._add(path, iter(parts))
        for edge in new:
            if not self._trees.is_kept(edge):
                self._add(edge, self._parts_of_edge(*edge))

    def _parts_of_state(self, branch: str, state: str) -> Iterator[Path]:
        """Yield the paths of all that belongs to a state in any version, beside its operations."""
        yield branch, "_states", state
        yield branch, LAYOUT, state
        yield branch, LAYOUT, PINNED, state
        for at in range(3):
            yield from self._incidence.notes_of(at, branch, state)

    def _edges_into(self, branch: str, state: str, keeper: int) -> Iterator[Path]:
        """Yield the operations of other states that one side let lead to a state anew."""
        for path in self._incidence.ways_into(keeper, branch, state):
            if path[1] != state and self._trees.get(0, path) != state:
                yield path

    def _ways_in(self, branch: str, state: str, keeper: int) -> Iterator[Path]:
        """Yield the operations that one side deleted together with the state they lead to, with all
        that belongs to them.

        One whose notes the keeper of the state changed is a clash of its own.
        """
        other = THEIRS if keeper == OURS else OURS
        for path in self._incidence.ways_into(keeper, branch, state):
            if self._trees.get(other, path[:2]) is ABSENT:
                continue
            gone = self._trees.get(other, path) is ABSENT
            if gone and self._trees.get(0, path) == state and not self._is_noted_anew(keeper, path):
                yield path
                yield from self._parts_of_edge(*path)

    # Operations.

    def _settle_operations(self, branch: str, state: str) -> None:
        if any(self._trees.get(at, (branch, state)) is ABSENT for at in range(3)):
            return
        for operation in list(self._trees.map(0, (branch, state))):
            path = (branch, state, operation)
            keeper = self._keeper(path)
            if keeper is None or operation.startswith("_") or self._trees.is_kept(path):
                continue
            same = equal(self._trees.get(0, path), self._trees.get(keeper, path))
            if not same or self._is_noted_anew(keeper, path):
                self._add(path, self._parts_of_edge(*path))

    def _is_noted_anew(self, side: int, edge: Path) -> bool:
        """Whether a side changed what is noted about an operation."""
        return any(
            not equal(self._trees.get(0, one), self._trees.get(side, one))
            for one in self._parts_of_edge(*edge)
            if one[1] != LAYOUT
        )

    @staticmethod
    def _parts_of_edge(branch: str, state: str, operation: str) -> Iterator[Path]:
        yield branch, "_operations", note_key(operation, state)
        yield branch, LAYOUT, IN_LAYOUT, note_key(operation, state)
        yield LEVELS, "/".join(map(escape, (branch, state, operation)))
