"""The verbs of drawing that need no pointer: what menus, keys and buttons ask for."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.names import fresh_branch_name, fresh_operation_name, fresh_state_name
from smsl_studio.graph.layout import place_states
from smsl_studio.studio.canvas.canvas import Canvas
from smsl_studio.studio.session import Session
from smsl_studio.studio.words import counted

GAP = 218.0
"""Pixels between a new state and the rightmost one."""


class Drawing:
    """Verbs on the SB that is shown and on the selection."""

    def __init__(self, session: Session, canvas: Canvas) -> None:
        self._session, self.canvas = session, canvas

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
        """Add a state beside the others and start naming it."""
        name = fresh_state_name(self._branch)
        branch, at = self._session.branch, self._free_place()
        if self._edit(f"Add {name}", lambda bp: editing.add_state(bp, branch, name, at)):
            self._name(Address(branch, name))

    def add_branch(self) -> None:
        """Add an SB and show it."""
        name = fresh_branch_name(self._session.blueprint)
        if self._edit(f"Add State Branch {name}", lambda bp: editing.add_branch(bp, name)):
            self._session.show_branch(name)

    def connect(self) -> None:
        """Two states: an operation from the first to the second; one: ask where to."""
        states = self._states()
        if len(states) == 1:
            self._session.select(states)
            self.canvas.setFocus()
            self.canvas.quick_add_wanted.emit()
            return
        source, target = states[:2]
        name = fresh_operation_name(self._branch, source.state)
        branch = source.branch
        if self._edit(
            f"Connect {source.state} to {target.state}",
            lambda bp: editing.add_operation(bp, branch, source.state, name, target.state),
        ):
            self._name(Address(branch, source.state, name))

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
            self.canvas.rename_wanted.emit(self._session.selection[0])

    def delete(self) -> None:
        chosen = self._session.selection
        words = chosen[0].path[-1] if len(chosen) == 1 else counted(len(chosen), "element")
        self._edit(f"Delete {words}", lambda bp: editing.delete(bp, chosen))

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
        bases = self._session.blueprint.bases.get(self._session.branch)
        if bases:
            self._session.show_branch(bases[0][0])

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

    def _name(self, address: Address) -> None:
        self._session.select((address,))
        self.canvas.reveal(address)
        self.canvas.setFocus()
        self.canvas.rename_wanted.emit(address)

    def _edit(self, words: str, change: Callable[[Blueprint], Blueprint]) -> bool:
        return self._session.edit(words, change)
