"""QuickAdd: new operations by a key, from the selected element to a new state."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPointF

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.chain_places import chain_offsets
from smsl_studio.studio.features.draw.canvas.free_places import AROUND, SIBLINGS, free_place

Connect = Callable[[Address, Address | None, QPointF], object]


CARD = 200.0
"""The room that the card of a new state needs at its right (pixels)."""


class QuickAdd:
    """Asks for operations with ``connect`` (source, target or None for a new state, point)."""

    def __init__(self, session: Session, canvas: BranchView, connect: Connect) -> None:
        self._session, self._canvas, self._connect = session, canvas, connect

    def go_on(self) -> None:
        """Add an operation from the selected state, or from the first of two to the second.

        A selected operation stands for its target, so that the key draws a chain. Without any state
        it adds the first one.
        """
        chosen = self._session.selection
        states = [a for a in chosen if a.state and not a.operation]
        if not states and len(chosen) == 1 and self._target(chosen[0]):
            states = [Address(chosen[0].branch, self._target(chosen[0]))]
        if not self._canvas.positions:
            self._canvas.add_state_wanted.emit(QPointF(*free_place(self._canvas)))
        elif not states or len(states) > 2 or states[0].branch != self._session.branch:
            self._canvas.say("Select the state the operation starts from.")
        elif len(states) == 2:
            places = self._canvas.positions
            (ax, ay), (bx, by) = places[states[0].state], places[states[1].state]
            self._canvas.reveal(states[0], smooth=False)
            self._connect(states[0], states[1], QPointF((ax + bx) / 2, (ay + by) / 2))
        else:
            row = self._session.blueprint[states[0].branch].table
            around = chain_offsets(self._canvas, row, states[0].state)
            self._begin(states[0], states[0].state, around)

    def sibling(self) -> None:
        """Add an operation to a new state from where the selected operation starts.

        A selected state stands for the first operation that leads to it from another state.
        """
        chosen = self._session.selection
        if len(chosen) != 1 or not chosen[0].state or chosen[0].branch != self._session.branch:
            self._canvas.say("Select one state or operation to add a sibling.")
            return
        one = chosen[0]
        source = one.state if one.operation else self._first_source(one)
        beside = self._target(one) if one.operation else one.state
        if not source:
            self._canvas.say(f"No operation leads to {one.state}. Tab goes on from it.")
        elif not beside or beside == source:
            self._begin(Address(one.branch, source), source, AROUND)
        else:
            self._begin(Address(one.branch, source), beside, SIBLINGS)

    def _begin(self, source: Address, beside: str, around: tuple[tuple[float, float], ...]) -> None:
        self._canvas.reveal(source, smooth=False)
        place = QPointF(*free_place(self._canvas, beside, around))
        if not self._canvas.clear_view.contains(place):
            # The card of the new state needs room beside it.
            self._canvas.reveal_point(place + QPointF(CARD / self._canvas.zoom, 0.0), smooth=False)
        self._canvas.reveal_point(place, smooth=False)
        self._connect(source, None, place)

    def _first_source(self, state: Address) -> str:
        """The first other state with an operation to this one; empty if there is none."""
        table = self._session.blueprint[state.branch].table
        found = (name for name, row in table.items() if state.state in row.values())
        return next((name for name in found if name != state.state), "")

    def _target(self, operation: Address) -> str:
        """The state to which an operation leads; empty if it is no operation or leads nowhere."""
        branch = self._session.blueprint.branches.get(operation.branch)
        target = branch.table.get(operation.state, {}).get(operation.operation) if branch else None
        return target if branch is not None and target in branch.table else ""
