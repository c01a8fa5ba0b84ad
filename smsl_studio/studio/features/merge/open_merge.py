"""OpenMerge: the merge that is being decided in a window, and what was chosen so far."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.merge import Conflict, Side, choose, chosen_side, open_conflicts
from smsl_studio.blueprint.merge.conflict import Path
from smsl_studio.blueprint.merge.sides import MergeSides, sides_of_entries
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.session import Session

WORDS = {"ours": "Mine", "theirs": "Theirs", "base": "Base"}


class OpenMerge(QObject):
    """The conflicts of the blueprint that is open.

    ``conflicts`` are all that were open since the file was opened, in their order. One that is no
    longer open stays in it until the file is saved, so that it can be decided anew. An undo opens
    it again.
    """

    changed = Signal()
    """Conflicts were found or chosen, or the versions became known."""

    def __init__(self, session: Session, files: Files, parent: QObject) -> None:
        super().__init__(parent)
        self._session, self._files = session, files
        self.conflicts: tuple[Conflict, ...] = ()
        self.sides: MergeSides | None = None
        self._open: tuple[Conflict, ...] = ()
        self._open_at: dict[Path, list[Conflict]] = {}
        session.opened.connect(self._forget)
        session.blueprint_changed.connect(self._follow)
        files.changed.connect(self._end_if_saved)

    @property
    def exists(self) -> bool:
        """Whether there is anything to decide, or to decide anew."""
        return bool(self.conflicts)

    @property
    def open_ones(self) -> tuple[Conflict, ...]:
        """The conflicts that nobody has chosen yet."""
        return self._open

    def is_open(self, conflict: Conflict) -> bool:
        """Whether a conflict waits for a choice."""
        return conflict in self._open_at.get(conflict.path, ())

    def side_of(self, conflict: Conflict) -> Side | None:
        """The version that was chosen; None for an open conflict, or for another value."""
        if self.is_open(conflict):
            return None
        return chosen_side(self._session.blueprint, conflict)

    def take(self, conflict: Conflict, side: Side) -> bool:
        """Choose a version for a conflict, as one step of the history; False if it is refused."""
        words = f"Take {WORDS[side].lower()} for {conflict.address}"
        return self._session.edit(words, lambda blueprint: choose(blueprint, conflict, side))

    def following(self, conflict: Conflict) -> Conflict:
        """The next open conflict after one, else the first open one, else this one itself."""
        order = self.conflicts
        at = order.index(conflict) + 1 if conflict in order else 0
        around = (*order[at:], *order[:at])
        others = (one for one in around if one != conflict and self.is_open(one))
        return next(others, conflict)

    def know(self, sides: MergeSides) -> None:
        """Take the versions, which were found in git or in the marked file."""
        self.sides = sides
        self.changed.emit()

    def _forget(self) -> None:
        self.conflicts, self._open, self.sides = (), (), None
        self._open_at = {}

    def _follow(self, _before: Blueprint, after: Blueprint) -> None:
        if self._session.broken is not None:
            # An undo went back to the text with conflict markers.
            self._forget()
            self.changed.emit()
            return
        now = open_conflicts(after)
        if not now and not self.conflicts:
            return
        if not self.conflicts:
            self.sides = self.sides or sides_of_entries(after)
        known = by_path(self.conflicts)
        new = [one for one in now if one not in known.get(one.path, ())]
        if new and len(now) == len(self._open):
            # Elements got other names, and the entries followed them in their order.
            names = [pair for pair in zip(self._open, now, strict=True) if pair[0] != pair[1]]
            self.conflicts = tuple(
                next((after for before, after in names if before == one), one)
                for one in self.conflicts
            )
        else:
            self.conflicts = (*self.conflicts, *new)
        self._open, self._open_at = now, by_path(now)
        self.changed.emit()

    def _end_if_saved(self) -> None:
        if self.conflicts and not self._open and not self._session.edited:
            self._forget()
            self.changed.emit()


def by_path(conflicts: Iterable[Conflict]) -> dict[Path, list[Conflict]]:
    """The conflicts by their paths. They have values that cannot be hashed."""
    found: dict[Path, list[Conflict]] = {}
    for one in conflicts:
        found.setdefault(one.path, []).append(one)
    return found
