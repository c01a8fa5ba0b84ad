"""LitRun: shows one step of a counterexample on the drawing, in the SB that is open."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtCore import QObject, Signal

from smsl_studio.front.views.claim_run import RunStep
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.document.session import Session


class LitRun(QObject):
    """Shows one step of a run on the drawing: the active state of each SB.

    Earlier states are marked as visited, and the operations so far as a trail. Later states are
    marked as next states, so that a small picture shows their names, too.
    """

    moved = Signal(int)
    """The step that is lit now."""

    def __init__(self, session: Session, canvas: Canvas, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._canvas = session, canvas
        self.steps: tuple[RunStep, ...] = ()
        self.at = 0
        self._bad = False
        session.branch_changed.connect(lambda _: self._light())

    @property
    def last(self) -> int:
        """The number of the last step."""
        return len(self.steps) - 1

    def show_steps(self, steps: Sequence[RunStep], at: int = 0, bad: bool = False) -> None:
        """Light another run. Without steps nothing is lit. ``bad`` says that its last operation is
        marked as a fault."""
        self.steps, self.at, self._bad = tuple(steps), at, bad
        self._light()

    def go(self, at: int) -> None:
        """Light a step, and show the SB in which it happens."""
        if not 0 <= at <= self.last:
            return
        self.at = at
        operation = self.steps[at].operation
        moved = self.steps[at].changed
        if operation is not None and self._session.branch not in {operation.branch, *moved}:
            self._session.show_branch(operation.branch)
        if operation is not None and self._session.branch == operation.branch:
            self._canvas.reveal(operation)
        self._light()
        self.moved.emit(at)

    def _light(self) -> None:
        marks, branch = self._canvas.marks, self._session.branch
        if not self.steps:
            lit = replace(marks, active=None, visited=frozenset(), trail=(), running=None,
                          next_states=frozenset(), walked=False, failing=frozenset())  # fmt: skip
        else:
            step, past = self.steps[self.at], self.steps[: self.at + 1]
            later = {one.configuration.get(branch, "") for one in self.steps[self.at + 1 :]}
            during = step.during
            ends = self.steps[-1].edges if self._bad else ()
            running = (during, None) if during is not None and during.branch == branch else None
            lit = replace(
                marks,
                active=step.configuration.get(branch),
                visited=frozenset(one.configuration.get(branch, "") for one in past[:-1]),
                trail=tuple(edge for one in past for edge in one.edges if edge.branch == branch),
                running=running,
                next_states=frozenset(later - {step.configuration.get(branch, "")}),
                walked=True,
                failing=frozenset(edge for edge in ends if edge.branch == branch),
            )
        if lit != marks:
            self._canvas.set_marks(lit)
