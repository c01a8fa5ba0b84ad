"""Pins: the verbs that fix states at their places, so that Tidy leaves them there."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session


class PinVerbs:
    """Pins and unpins the selected states of the SB that is shown, as one step each."""

    def __init__(self, session: Session, canvas: Canvas) -> None:
        self._session, self._canvas = session, canvas

    def can_pin(self) -> bool:
        """Whether a state that is not pinned is selected."""
        return bool(self._selected(pinned=False))

    def can_unpin(self) -> bool:
        """Whether a pinned state is selected."""
        return bool(self._selected(pinned=True))

    def has_pins(self) -> bool:
        """Whether a state of the SB that is shown is pinned."""
        branch = self._branch
        return branch is not None and not branch.notes.pinned.isdisjoint(branch.table)

    def pin(self) -> None:
        """Pin the selected states where they stand."""
        name, states = self._session.branch, self._selected(pinned=False)
        shown = self._canvas.positions
        places = {state: shown[state] for state in states}
        self._session.edit(f"Pin {_words(states)}", lambda bp: editing.pin(bp, name, places))

    def unpin(self) -> None:
        """Let Tidy move the selected states again."""
        name, states = self._session.branch, self._selected(pinned=True)
        self._session.edit(f"Unpin {_words(states)}", lambda bp: editing.unpin(bp, name, states))

    def unpin_all(self) -> None:
        """Let Tidy move all states of the SB again."""
        name = self._session.branch
        self._session.edit(f"Unpin all of {name}", lambda bp: editing.unpin(bp, name))

    @property
    def _branch(self) -> StateBranch | None:
        return self._session.blueprint.branches.get(self._session.branch)

    def _selected(self, pinned: bool) -> list[str]:
        """The selected states that are pinned, or those that are not."""
        branch = self._branch
        chosen = [a for a in self._session.selection if a.state and not a.operation]
        if branch is None or not chosen:
            return []
        own = [a.state for a in chosen if a.branch == branch.name and a.state in branch.table]
        return [state for state in own if (state in branch.notes.pinned) is pinned]


def _words(states: list[str]) -> str:
    return states[0] if len(states) == 1 else counted(len(states), "state")


def pin_actions(pins: PinVerbs, drawn: Callable[[], bool]) -> tuple[Action, ...]:
    """The rows about pins. ``drawn`` tells whether Draw mode is shown."""
    pointer = ("state",)
    return (
        Action("pin", "Pin", pins.pin, "Edit", "pin", ("K",),
               lambda: drawn() and pins.can_pin(), scope="canvas", section=3, pointer=pointer,
               tip="Fix the selected states at their places; Tidy leaves them there"),
        Action("unpin", "Unpin", pins.unpin, "Edit", "", ("Shift+K",),
               lambda: drawn() and pins.can_unpin(), scope="canvas", section=3, pointer=pointer,
               tip="Let Tidy move the selected states again"),
        Action("unpin_all", "Unpin all", pins.unpin_all, "Edit", "",
               enabled=lambda: drawn() and pins.has_pins(), section=3,
               tip="Let Tidy move all states of this State Branch again"),
    )  # fmt: skip
