"""The verbs of notes and groups that need no pointer; menus and keys call them."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from PySide6.QtWidgets import QMenu

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.actions import Action, Actions
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.drawn.drawn_editor import DrawnEditor

DRAWN = "Notes and groups"
"""The submenu of the menu Blueprint."""
ON_NOTE = ("rename", "", "cut", "copy", "duplicate", "", "hang_note", "free_note", "", "delete")
ON_GROUP = ("rename", "", "cut", "copy", "duplicate", "", "ungroup")


class DrawnVerbs:
    """Verbs on the notes and groups of the SB that is shown. ``can_…`` enable them."""

    def __init__(self, session: Session, canvas: Canvas, drawn: DrawnEditor) -> None:
        self._session, self._canvas, self._drawn = session, canvas, drawn

    def can_add(self) -> bool:
        """Whether an SB is shown."""
        return self._session.branch in self._session.blueprint.branches

    def can_group(self) -> bool:
        """Whether states are selected."""
        return bool(self._drawn.selected_states())

    def can_dissolve(self) -> bool:
        """Whether a group is selected, or a state that stands in one."""
        return bool(self._groups())

    def has_any(self) -> bool:
        """Whether there are notes or groups."""
        return bool(self._drawn.drawn)

    def can_hang(self) -> bool:
        """Whether a free note is selected, and there are states."""
        return self._note() is not None and not self._hung() and bool(self._canvas.positions)

    def can_free(self) -> bool:
        """Whether a note is selected that hangs on a state."""
        return bool(self._hung())

    def add_note(self) -> None:
        """Add a note to the one selected state, otherwise a free one."""
        states = self._drawn.selected_states()
        self._drawn.add_note(state=states[0] if len(states) == 1 else "")

    def dissolve(self) -> None:
        """Dissolve the selected group, or those of the selected states. Their states are selected
        then.
        """
        keys, groups = self._groups(), self._drawn.drawn.groups
        states = [state for key in keys for state in groups[key].states]
        if keys:
            self._drawn.dissolve(keys)
            self._session.select(Address(self._session.branch, state) for state in states)

    def show_next(self) -> None:
        """Select the next group or note, in written order."""
        sheet = self._canvas.sheet
        keys = sheet.drawn.listed() if sheet is not None else []
        if keys:
            chosen = self._drawn.chosen
            at = keys.index(chosen) + 1 if chosen in keys else 0
            self._drawn.show(keys[at % len(keys)])
            self._canvas.setFocus()

    def hang(self) -> None:
        """Hang the selected note on the nearest state."""
        key, sheet = self._note(), self._canvas.sheet
        rect = sheet.drawn.rect(key) if sheet is not None and key is not None else None
        if key is not None and sheet is not None and rect is not None:
            middle = (rect.center().x(), rect.center().y())
            nearest = int(((sheet.at - np.array(middle)) ** 2).sum(axis=1).argmin())
            self._drawn.hang(key.key, sheet.picture.names[nearest])

    def free(self) -> None:
        """Let the selected note hang on no state."""
        key = self._note()
        if key is not None:
            self._drawn.hang(key.key, "")

    def _note(self) -> DrawnKey | None:
        key = self._drawn.chosen
        return key if key is not None and key.kind == "note" else None

    def _hung(self) -> str:
        """The state that the selected note hangs on; empty for none."""
        key = self._note()
        note = self._drawn.drawn.notes.get(key.key) if key is not None else None
        return note.state if note is not None else ""

    def _groups(self) -> list[str]:
        key, drawn = self._drawn.chosen, self._drawn.drawn
        if key is not None:
            return [key.key] if key.kind == "group" and key.key in drawn.groups else []
        found = (drawn.group_of(state) for state in self._drawn.selected_states())
        return list(dict.fromkeys(group for group in found if group))


def drawn_actions(
    verbs: DrawnVerbs, drawn: DrawnEditor, shown: Callable[[], bool]
) -> tuple[Action, ...]:
    """The rows of the menu Blueprint about notes and groups. ``shown`` tells whether Draw mode is
    shown."""

    def when(can: Callable[[], bool]) -> Callable[[], bool]:
        """Enabled in Draw mode, if ``can`` says so."""
        return lambda: shown() and can()

    return (
        Action("add_note", "Add note", verbs.add_note, "Blueprint", "slip", ("Ctrl+Shift+M",),
               when(verbs.can_add), section=1, pointer=("state",),
               tip="Put a note on the selected state, or free on the canvas"),
        Action("next_note", "Next note or group", verbs.show_next, "Blueprint", "",
               ("Ctrl+Alt+M",), when(verbs.has_any), section=1, inner=DRAWN,
               tip="Select the next note or group, and show it"),
        Action("hang_note", "Hang on the nearest state", verbs.hang, "Blueprint", "",
               enabled=when(verbs.can_hang), section=1, inner=DRAWN,
               tip="Let the selected note move with the nearest state"),
        Action("free_note", "Free the note", verbs.free, "Blueprint", "",
               enabled=when(verbs.can_free), section=1, inner=DRAWN,
               tip="Let the selected note hang on no state"),
        Action("group", "Group", drawn.add_group, "Blueprint", "group", ("Ctrl+G",),
               when(verbs.can_group), section=1, pointer=("state",),
               tip="Draw a frame with a title around the selected states"),
        Action("ungroup", "Dissolve the group", verbs.dissolve, "Blueprint", "",
               ("Ctrl+Shift+G",), when(verbs.can_dissolve), section=1, inner=DRAWN,
               tip="Take the frame away; the states stay"),
    )  # fmt: skip


def fill_drawn(actions: Actions, key: DrawnKey, menu: QMenu) -> None:
    """Fill the menu at the pointer for a note or a group, which is selected."""
    actions.refresh()
    for name in ON_NOTE if key.kind == "note" else ON_GROUP:
        if not name:
            menu.addSeparator()
        elif name == "rename":
            words = "Edit the note" if key.kind == "note" else "Rename the group"
            menu.addAction(actions[name].icon(), words, partial(actions[name].trigger))
        elif actions[name].isEnabled():
            menu.addAction(actions[name])
