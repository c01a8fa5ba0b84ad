"""The verbs of drawing that need no pointer: what menus, keys and buttons ask for."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPointF

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.names import fresh_branch_name
from smsl_studio.graph.layout import place_states
from smsl_studio.studio.canvas.editor import CanvasEditor
from smsl_studio.studio.session import Session

GAP = 218.0
"""Pixels between a new state and the rightmost one."""


class Drawing:
    """Verbs on the SB that is shown and on the selection."""

    def __init__(self, session: Session, editor: CanvasEditor) -> None:
        self._session, self._editor, self.canvas = session, editor, editor.canvas

    # What can be done now.

    def has_branch(self) -> bool:
        return self._session.branch in self._session.blueprint.branches

    def has_states(self) -> bool:
        return self.has_branch() and bool(self._branch.table)

    def has_selection(self) -> bool:
        return bool(self._session.selection)

    def can_rename(self) -> bool:
        return len(self._session.selection) == 1

    def can_connect(self) -> bool:
        return bool(self._states()) and len(self._states()) <= 2

    def can_enter(self) -> bool:
        return self.has_branch() and any(
            sub in self._session.blueprint.branches for sub in self._branch.subs.values()
        )

    def can_leave(self) -> bool:
        return self._session.branch in self._session.blueprint.bases

    # Doing it.

    def add_state(self) -> None:
        """Name a new state beside the others."""
        self.canvas.setFocus()
        at = QPointF(*self._free_place())
        self._editor.add_state_at(at)

    def add_branch(self) -> None:
        """Add an SB and show it."""
        name = fresh_branch_name(self._session.blueprint)
        if self._edit(f"Add State Branch {name}", lambda bp: editing.add_branch(bp, name)):
            self._session.show_branch(name)

    def connect(self) -> None:
        """An operation from the selected state; of two, from the first to the second."""
        self.canvas.setFocus()
        self._editor.quick_add()

    def attach(self, digit: int, sub: str | None) -> None:
        """Let an SB (a new one, where ``sub`` is None) expand a fact of the SB that is shown."""
        base = self._session.branch
        name = sub or fresh_branch_name(self._session.blueprint)

        def change(blueprint: Blueprint) -> Blueprint:
            if sub is None:
                blueprint = editing.add_branch(blueprint, name)
            return editing.attach_sub(blueprint, base, digit, name)

        self._edit(f"Attach {name} to fact {digit} of {base}", change)

    def rename(self) -> None:
        """Edit the name of the selected element in place."""
        if self.can_rename():
            self.canvas.setFocus()
            self.canvas.reveal(self._session.selection[0])
            self._editor.rename(self._session.selection[0])

    def delete(self) -> None:
        self._editor.delete_selected()

    def select_all(self) -> None:
        self._session.select(Address(self._branch.name, name) for name in self._branch.table)

    def tidy(self) -> None:
        """Lay the SB out anew, as one step."""
        branch = self._branch
        places = place_states(branch)
        if self._edit(
            f"Tidy {branch.name}", lambda bp: editing.set_layout(bp, branch.name, places)
        ):
            self.canvas.fit()

    def enter(self) -> None:
        """Show the sub-SB of the first fact that has one."""
        branches = self._session.blueprint.branches
        subs = [sub for _, sub in sorted(self._branch.subs.items()) if sub in branches]
        if subs:
            self._session.show_branch(subs[0])

    def leave(self) -> None:
        """Show the base SB."""
        self._editor.leave()

    @property
    def _branch(self) -> StateBranch:
        return self._session.blueprint[self._session.branch]

    def _states(self) -> tuple[Address, ...]:
        return tuple(a for a in self._session.selection if a.state and not a.operation)

    def _free_place(self) -> tuple[float, float]:
        """Right of the selected state, else right of all, else the middle."""
        places = self.canvas.positions
        if not places:
            return 0.0, 0.0
        chosen = [places[a.state] for a in self._states() if a.state in places]
        x, y = chosen[-1] if chosen else max(places.values())
        taken = set(places.values())
        while any(abs(x + GAP - ox) < 120 and abs(y - oy) < 60 for ox, oy in taken):
            x += GAP
        return x + GAP, y

    def _edit(self, words: str, change: Callable[[Blueprint], Blueprint]) -> bool:
        return self._session.edit(words, change)
