"""The cheapest ways between two selected states, lit on the canvas."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.address import Address
from smsl_studio.graph.routing import Route, cheapest
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session

Ends = tuple[Address, ...]


class WaysBetween(QObject):
    """Lights the cheapest way there and the cheapest way back, until something else is selected.

    The ways follow edits and undo.
    """

    told = Signal(str, bool)
    """(words, asked): the ways in words, empty when they are no longer shown, and whether the user
    asked for them just now."""

    def __init__(self, session: Session, canvas: Canvas) -> None:
        super().__init__(canvas)
        self._session, self._canvas = session, canvas
        self._ends: Ends = ()
        session.selection_changed.connect(lambda _: self._chosen())
        session.blueprint_changed.connect(lambda *_: self._edited())

    def can_show(self) -> bool:
        """Whether exactly two states of one SB are selected."""
        chosen = self._session.selection
        both = len(chosen) == 2 and all(one.state and not one.operation for one in chosen)
        return both and chosen[0].branch == chosen[1].branch

    def show(self) -> None:
        """Light the ways between the two selected states, and tell them in words."""
        if self.can_show():
            self._ends = self._session.selection
            self._light(asked=True)

    def _chosen(self) -> None:
        """Hide the ways after another selection."""
        if self._ends and self._session.selection != self._ends:
            self._ends = ()
            self._mark(())
            self.told.emit("", False)

    def _edited(self) -> None:
        """Compute the ways anew. The states may have other names now, or be gone."""
        if self._ends and self.can_show():
            self._ends = self._session.selection
            table = self._session.blueprint[self._ends[0].branch].table
            if all(one.state in table for one in self._ends):
                self._light(asked=False)

    def _light(self, asked: bool) -> None:
        start, goal = self._ends
        branch = self._session.blueprint[start.branch]
        there = cheapest(branch, start.state, goal.state)
        back = cheapest(branch, goal.state, start.state)
        self._mark(tuple(at for way in (there, back) if way is not None for at in way.operations))
        words = f"{_words(start, goal, there)}\n{_words(goal, start, back)}"
        self.told.emit(words, asked)

    def _mark(self, ways: Ends) -> None:
        if self._canvas.marks.ways != ways:
            self._canvas.set_marks(replace(self._canvas.marks, ways=ways))


def _words(start: Address, goal: Address, way: Route | None) -> str:
    ends = f"{start.state} to {goal.state}"
    if way is None:
        return f"{ends}: no way."
    return f"{ends}: {counted(len(way.operations), 'operation')}, cost {way.cost:g}."
