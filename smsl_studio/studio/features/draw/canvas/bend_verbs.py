"""Bends: the lines of operations as they are drawn by hand, and the verbs on them."""

from __future__ import annotations

import time
from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.edge_layout import EdgeLayout
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.nudge import PAUSE


class Bends(QObject):
    """Turns ``line_wanted`` of a canvas into edits of a session, one step for each gesture.

    Keys that are pressed soon after each other are one step, and are carried out together.
    """

    def __init__(self, session: Session, canvas: Canvas) -> None:
        super().__init__(canvas)
        self._session, self._canvas = session, canvas
        self.clock: Callable[[], float] = time.monotonic
        """The time in seconds."""
        self._last, self._run, self._moved = -PAUSE, 0, Address("")
        self._waiting: tuple[Address, EdgeLayout] | None = None
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self.settle)
        canvas.line_wanted.connect(self.draw)
        session.settling.connect(self.settle)

    # What can be done now.

    def can_bend(self) -> bool:
        """Whether exactly one operation is selected, and leads to a state."""
        chosen = self._session.selection
        if len(chosen) != 1 or not chosen[0].operation:
            return False
        branch = self._session.blueprint.branches.get(chosen[0].branch)
        table = branch.table if branch is not None else {}
        return table.get(chosen[0].state, {}).get(chosen[0].operation) in table

    def has_bends(self) -> bool:
        """Whether a selected operation has bends."""
        return any(layout.bends for layout in self._drawn())

    def has_moved_labels(self) -> bool:
        """Whether the label of a selected operation was moved."""
        return any(layout.label is not None for layout in self._drawn())

    # The verbs.

    def add(self) -> None:
        """Add a bend to the selected operation, and choose it."""
        self._canvas.setFocus()
        self._canvas.reveal(self._session.selection[0], smooth=False)
        self._canvas.hand.line.add_bend()

    def choose_next(self) -> None:
        """Choose the next bend of the selected operation, or its label."""
        self._canvas.setFocus()
        self._canvas.hand.line.choose_next()

    def clear(self) -> None:
        """Remove all bends of the selected operations."""
        chosen = self._operations()
        what = _words(chosen)
        self._session.edit(f"Clear bends of {what}", lambda bp: editing.set_bends(bp, chosen, ()))

    def reset_labels(self) -> None:
        """Leave the places of the selected operations' labels to the drawing."""
        chosen = self._operations()
        what = _words(chosen)
        self._session.edit(
            f"Reset label of {what}", lambda bp: editing.place_label(bp, chosen, None)
        )

    def draw(self, operation: Address, layout: EdgeLayout, going_on: bool) -> None:
        """Draw the line of an operation so. With ``going_on`` in a moment, as a key asks for it."""
        if self._waiting is not None and self._waiting[0] != operation:
            self.settle()
        if going_on:
            self._waiting = operation, layout
            self._timer.start(0)
        else:
            self._waiting = None
            self._edit(operation, layout, -1)

    def settle(self) -> None:
        """Carry out the presses that wait. Edits and commands call it first."""
        self._timer.stop()
        waiting, self._waiting = self._waiting, None
        if waiting is None:
            return
        if waiting[0] != self._moved or self.clock() - self._last >= PAUSE:
            self._run += 1
        self._moved = waiting[0]
        self._edit(*waiting, self._run)
        self._last = self.clock()

    # Inside

    def _edit(self, operation: Address, layout: EdgeLayout, run: int) -> None:
        former = self._layout_of(operation)

        def change(blueprint: Blueprint) -> Blueprint:
            """The blueprint with the line and the label where they are wanted."""
            if layout.bends != former.bends:
                blueprint = editing.set_bends(blueprint, operation, layout.bends)
            if layout.label != former.label:
                blueprint = editing.place_label(blueprint, operation, layout.label)
            return blueprint

        if not self._session.edit(_step(operation, former, layout), change, run):
            edge = self._canvas.sheet.picture.edge(operation) if self._canvas.sheet else -1
            if edge >= 0:
                self._canvas.redraw_edge(edge, former)
                self._canvas.hand.show_grip()

    def _operations(self) -> list[Address]:
        return [address for address in self._session.selection if address.operation]

    def _drawn(self) -> list[EdgeLayout]:
        return [self._layout_of(address) for address in self._operations()]

    def _layout_of(self, operation: Address) -> EdgeLayout:
        branch = self._session.blueprint.branches.get(operation.branch)
        edges = branch.notes.edges if branch is not None else {}
        return edges.get((operation.state, operation.operation), EdgeLayout())


def _step(operation: Address, former: EdgeLayout, layout: EdgeLayout) -> str:
    """The words of the undo step."""
    name = operation.operation
    if layout.bends == former.bends:
        return f"Move the label of {name}" if layout.label is not None else (
            f"Reset label of {name}")  # fmt: skip
    if len(layout.bends) == len(former.bends):
        return f"Move a bend of {name}"
    return f"Bend {name}" if len(layout.bends) > len(former.bends) else f"Remove a bend of {name}"


def _words(operations: list[Address]) -> str:
    many = len(operations) != 1
    return counted(len(operations), "operation") if many else operations[0].operation


LINES = "Lines and labels"
"""The submenu of the menu Edit."""


def bend_actions(bends: Bends, drawn: Callable[[], bool]) -> tuple[Action, ...]:
    """The rows of the Edit menu about lines. ``drawn`` tells whether Draw mode is shown."""
    pointer = ("operation",)
    return (
        Action("add_bend", "Add bend", bends.add, "Edit", "", ("B",),
               lambda: drawn() and bends.can_bend(), scope="canvas", section=3, inner=LINES,
               pointer=pointer,
               tip="Lead the line of the operation through one point more; drag its handle"),
        Action("next_bend", "Choose next bend or label", bends.choose_next, "Edit", "",
               ("Shift+B",), lambda: drawn() and bends.can_bend(), scope="canvas", section=3,
               inner=LINES, tip="Arrows move it, Del removes it"),
        Action("clear_bends", "Clear bends", bends.clear, "Edit", "",
               enabled=lambda: drawn() and bends.has_bends(), section=3, inner=LINES,
               pointer=pointer, tip="Remove all bends of the selected operations"),
        Action("reset_label", "Reset label", bends.reset_labels, "Edit", "",
               enabled=lambda: drawn() and bends.has_moved_labels(), section=3, inner=LINES,
               pointer=pointer, tip="Put the label of the selected operations where there is room"),
    )  # fmt: skip
