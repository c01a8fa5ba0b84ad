"""The Edit menu."""

from __future__ import annotations

from smsl_studio.studio.actions import Action
from smsl_studio.studio.commands.shell import Shell
from smsl_studio.studio.drawing import Drawing
from smsl_studio.studio.session import Session


def edit_actions(session: Session, drawing: Drawing, shell: Shell) -> tuple[Action, ...]:
    history = session.history
    return (
        Action("undo", "Undo", history.undo, "Edit", "undo", ("Ctrl+Z",), history.canUndo,
               tip="Undo the last step"),
        Action("redo", "Redo", history.redo, "Edit", "redo", ("Ctrl+Shift+Z", "Ctrl+Y"),
               history.canRedo, tip="Do the undone step again"),
        Action("rename", "Rename", drawing.rename, "Edit", "pencil", ("F2",),
               lambda: shell.mode == "draw" and drawing.can_rename(), scope="canvas", section=1,
               tip="Edit the name in place"),
        Action("delete", "Delete", drawing.delete, "Edit", "trash", ("Del",),
               lambda: shell.mode == "draw" and drawing.has_selection(), scope="canvas",
               section=1),
        Action("select_all", "Select all states", drawing.select_all, "Edit", "", ("Ctrl+A",),
               lambda: shell.mode == "draw" and drawing.has_states(), scope="canvas", section=1),
        Action("palette", "Find or run a command", shell.open_palette, "Edit", "search",
               ("Ctrl+K",), section=2),
    )  # fmt: skip
