"""Tidy as work that can be done beside the window: what it starts from and what comes of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QObject

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.graph.tidied import tidied
from smsl_studio.stop import heed
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.overlays.work_card import WorkCard
from smsl_studio.studio.base.words import counted

Position = tuple[float, float]
LARGE = 500
"""A State Branch with more states is tidied beside the window, which goes on meanwhile."""
TENTH = 0.1
"""In scene units. Positions that differ by less are equal when the layout is written."""


@dataclass(frozen=True)
class TidyWork:
    """A drawing that shall be tidied. ``shown`` has the places of all states now, ``chosen`` the
    states that may move, None for all."""

    blueprint: Blueprint
    branch: str
    shown: dict[str, Position]
    chosen: frozenset[str] | None
    kind: str

    def do(self) -> Tidied:
        """Compute the tidy drawing. It can be called off."""
        before = self.blueprint[self.branch]
        pinned = before.notes.pinned
        places = tidied(before, self.shown, self.chosen or (), self.kind)
        heed()
        moved = self.chosen
        if pinned:
            moved = frozenset(before.table if moved is None else moved) - pinned
        straight = editing.straighten(self.blueprint, self.branch, moved)
        same = all(_together(at, self.shown.get(name)) for name, at in places.items())
        bent = straight[self.branch].notes.edges != before.notes.edges
        if same and not bent:
            return Tidied(places, straight, straight, same=True)
        # The places of pinned states stay as they are written, to the last digit.
        free = {name: at for name, at in places.items() if name not in pinned}
        placed = editing.set_layout(straight, self.branch, free)
        return Tidied(places, straight, placed)


@dataclass(frozen=True)
class Tidied:
    """A tidy drawing: the places of the states, and the blueprint without bends, before and after
    its states were placed. ``same`` says that nothing differs from before."""

    places: dict[str, Position]
    straight: Blueprint
    placed: Blueprint
    same: bool = False


class TidyBeside(QObject):
    """Does one such work at a time in a second thread, with a card that can call it off."""

    def __init__(self, canvas: Canvas) -> None:
        super().__init__(canvas)
        self._canvas, self._beside = canvas, Beside(self)
        self.card: WorkCard | None = None

    def begin(self, work: TidyWork, then: Callable[[TidyWork, Tidied], object]) -> None:
        """Begin; ``then`` gets the result, unless the person cancels."""
        self.give_up()
        states = counted(len(work.blueprint[work.branch].table), "state")
        canvas = self._canvas
        card = self.card = WorkCard(canvas, canvas.tokens, f"Tidying {states}")
        card.cancelled.connect(self.give_up)
        card.move((canvas.width() - card.width()) // 2, canvas.top_room() + 8)
        card.show()
        card.raise_()
        card.cancel.setFocus()
        self._beside.do(work.do, lambda found: self._done(work, found, then))

    def give_up(self) -> None:
        """Call the work off, if there is some. Nothing is changed."""
        self._beside.drop()
        self._close()

    def wait(self) -> None:
        """Wait until the work is done. Its result is handed over later."""
        self._beside.wait()

    def stop(self) -> None:
        """Call the work off for good, because the window closes."""
        self._beside.stop()

    def _done(
        self, work: TidyWork, found: Tidied, then: Callable[[TidyWork, Tidied], object]
    ) -> None:
        self._close()
        then(work, found)

    def _close(self) -> None:
        card, self.card = self.card, None
        if card is not None:
            card.close_field()


def _together(a: Position, b: Position | None) -> bool:
    """Whether two positions are equal once they are written."""
    return b is not None and max(abs(a[0] - b[0]), abs(a[1] - b[1])) <= TENTH
