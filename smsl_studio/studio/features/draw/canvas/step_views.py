"""StepViews: an undo or redo shows what it changes, and the view as it was."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.studio.base.canvas.camera import CameraStand
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.document.session import Session


@dataclass(frozen=True)
class _Whereabouts:
    """Where a person was at a step: the SB, and the view if the step itself moved it."""

    branch: str
    before: CameraStand | None = None
    after: CameraStand | None = None


class StepViews(QObject):
    """Follows undo and redo with the canvas.

    A step that moved the view moves it back. After any other one the view stays if something that
    changed is in it. Else it scrolls to the first change, in the SB in which the step was made.
    Where what changes is not in the SB that was shown, that SB is shown, and ``told`` says what
    was undone or done again.
    """

    told = Signal(str)
    """str: what was undone or done again, and in which SB."""

    def __init__(self, session: Session, canvas: Canvas) -> None:
        super().__init__(canvas)
        self._session, self._canvas = session, canvas
        self._steps: list[_Whereabouts] = []
        self._index = 0
        self._former: Blueprint | None = None
        session.opened.connect(self._forget)
        session.blueprint_changed.connect(self._changed)
        session.stepped.connect(self._went)

    def keep(self, before: CameraStand) -> None:
        """Let an undo of the last step show the view as it was ``before``, and a redo as it is."""
        if self._steps:
            here = self._canvas.camera.stand
            self._steps[-1] = replace(self._steps[-1], before=before, after=here)

    def _forget(self) -> None:
        self._steps.clear()
        self._index, self._former = 0, None

    def _changed(self, before: Blueprint, after: Blueprint) -> None:
        if self._former is None:
            self._former = before

    def _went(self, index: int) -> None:
        former, self._former = self._former, None
        last, self._index = self._index, index
        if self._session.adds_step:
            self._steps[index - 1 :] = [_Whereabouts(self._session.branch)]
        elif former is not None and index != last and max(index, last) <= len(self._steps):
            back = index < last
            step = self._steps[index if back else index - 1]
            words = self._session.history.text(index if back else index - 1)
            self._follow(step, back, former, f"{'Undone' if back else 'Done again'}: {words}")

    def _follow(self, step: _Whereabouts, back: bool, former: Blueprint, done: str) -> None:
        session, shown, home = self._session, self._session.branch, step.branch
        view, now = step.before if back else step.after, session.blueprint.branches
        changed = changed_branches(former, session.blueprint)
        if changed and shown not in changed:
            there = [name for name in (home, *changed) if name in changed and name in now]
            if there:
                session.show_branch(there[0])
                session.select_again()
            self.told.emit(f"{done}, in {there[0] if there else changed[0]}")
        if session.branch != home:
            return
        if view is not None:
            self._canvas.camera.look_back(view)
        elif home in former.branches and home in now:
            self._reveal(former[home], now[home])

    def _reveal(self, before: StateBranch, after: StateBranch) -> None:
        """Scroll to the first change, if no change is in view. A change is in view if it is seen
        whole, with both ends of an operation that is new."""
        canvas, first = self._canvas, None
        for address in changes(before, after):
            rect = canvas.rect_of(address)
            if rect is None:
                continue
            if canvas.seen.contains(rect.center()) and self._sees_ends(address, before, after):
                return
            first = first or address
        if first is not None:
            canvas.reveal(first)
            end = _new_end(first, before, after)
            if end is not None:
                canvas.reveal(end)

    def _sees_ends(self, address: Address, before: StateBranch, after: StateBranch) -> bool:
        """Whether the state that an operation newly leads to is in view."""
        end = _new_end(address, before, after)
        rect = self._canvas.rect_of(end) if end is not None else None
        return rect is None or self._canvas.seen.contains(rect.center())


def changed_branches(before: Blueprint, after: Blueprint) -> list[str]:
    """The SBs that mean something else, are new or are gone; without any, those drawn otherwise."""
    names = dict.fromkeys((*after.branches, *before.branches))
    other = [name for name in names if before.branches.get(name) is not after.branches.get(name)]
    meant = [name for name in other if not _means_the_same(before, after, name)]
    return meant or other


def _means_the_same(before: Blueprint, after: Blueprint, name: str) -> bool:
    was, now = before.branches.get(name), after.branches.get(name)
    return was is not None and now is not None and was.meaning == now.meaning


def _new_end(address: Address, before: StateBranch, after: StateBranch) -> Address | None:
    """The state to which an operation leads since a step; None for none, and for a state."""
    target = after.table.get(address.state, {}).get(address.operation)
    former = before.table.get(address.state, {}).get(address.operation)
    return Address(address.branch, target) if target in after.table and target != former else None


def changes(before: StateBranch, after: StateBranch) -> Iterator[Address]:
    """The states and operations of an SB that are new, or drawn or written otherwise."""
    name, places, lines = after.name, before.notes.layout, before.notes.edges
    layout, edges = after.notes.layout, after.notes.edges
    for state, row in after.table.items():
        former = before.table.get(state)
        if former is None or places.get(state) != layout.get(state):
            yield Address(name, state)
        elif former is not row:
            yield from (
                Address(name, state, operation)
                for operation, target in row.items()
                if former.get(operation) != target
            )
            if former.keys() - row.keys():
                yield Address(name, state)
    for edge in {**edges, **lines} if lines is not edges else ():
        if lines.get(edge) != edges.get(edge):
            yield Address(name, *edge)
