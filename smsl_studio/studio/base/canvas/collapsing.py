"""Collapsing: what several canvases know of which drawings are collapsed, so that all agree."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.model import StateBranch


class Collapsing(QObject):
    """Knows what a person chose for each file, and which SBs are crowded.

    It forgets both when it is gone. ``CollapseChoice`` keeps the choices for files on the disk.
    """

    chosen = Signal(str, bool)
    """(file, on): the drawings of a file shall be collapsed, or show every operation."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._wishes: dict[str, bool] = {}
        self._crowded: dict[str, tuple[StateBranch, bool]] = {}

    def wish(self, file: str) -> bool | None:
        """What the person chose for a file; None if there was no choice."""
        return self._wishes.get(file)

    def keep(self, file: str, on: bool) -> None:
        """Remember the choice for a file."""
        self._wishes[file] = on

    def choose(self, file: str, on: bool) -> None:
        """Collapse the drawings of a file or show all operations, in every canvas, from now on."""
        self.keep(file, on)
        self.chosen.emit(file, on)

    def crowded(self, branch: StateBranch) -> bool | None:
        """Whether this very SB is known to be crowded; None if no canvas has looked."""
        known = self._crowded.get(branch.name)
        return known[1] if known is not None and known[0] is branch else None

    def learn(self, branch: StateBranch, crowded: bool) -> None:
        """Note what a canvas has found out about an SB."""
        self._crowded[branch.name] = branch, crowded
