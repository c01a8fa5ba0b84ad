"""SharedCollapse: lets several canvases agree on which drawings are collapsed."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.model import StateBranch


class SharedCollapse(QObject):
    """Remembers two things for all canvases: the person's choice for each file, and the crowded
    SBs.

    A drawing is collapsed if all operations between two states are one line. An SB is crowded if
    its drawing has no space for the names of operations. This object keeps both in memory only.
    ``CollapseChoice`` also stores the choices in the settings.
    """

    chosen = Signal(str, bool)
    """(file, on): the drawings of this file are collapsed from now on (True), or show every
    operation (False)."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._wishes: dict[str, bool] = {}
        self._crowded: dict[str, tuple[StateBranch, bool]] = {}

    def wish(self, file: str) -> bool | None:
        """The person's choice for a file. None if the person has not chosen."""
        return self._wishes.get(file)

    def keep(self, file: str, on: bool) -> None:
        """Remember the choice for a file."""
        self._wishes[file] = on

    def choose(self, file: str, on: bool) -> None:
        """Collapse the drawings of a file (True), or show all operations, in every canvas from now
        on.
        """
        self.keep(file, on)
        self.chosen.emit(file, on)

    def crowded(self, branch: StateBranch) -> bool | None:
        """Whether this SB is crowded. None if no canvas has found out yet."""
        known = self._crowded.get(branch.name)
        return known[1] if known is not None and known[0] is branch else None

    def learn(self, branch: StateBranch, crowded: bool) -> None:
        """Remember whether an SB is crowded, as a canvas has found out."""
        self._crowded[branch.name] = branch, crowded
