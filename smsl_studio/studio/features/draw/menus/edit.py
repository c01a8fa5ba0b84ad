"""The Edit menu."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.errors import EditRefused
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Shell
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.clipboard import ClipboardVerbs
from smsl_studio.studio.features.draw.canvas.draw_verbs import DrawVerbs, selection_actions
from smsl_studio.studio.features.draw.find.drawing_search import DrawingSearch

NOT_SHOWN = EditRefused(
    "undo and redo work only while the drawing is shown",
    advice="Ctrl+1 shows it.",
)


def edit_actions(
    session: Session,
    drawing: DrawVerbs,
    clipping: ClipboardVerbs,
    search: DrawingSearch,
    shell: Shell,
) -> tuple[Action, ...]:
    """The rows of the Edit menu."""
    history = session.history

    def drawn() -> bool:
        """Whether Draw mode is shown."""
        return shell.mode == "draw"

    def of_drawing(call: Callable[[], object]) -> Callable[[], None]:
        """Run ``call`` in Draw mode and on its pages only, so that nobody changes what is not
        shown."""

        def act() -> None:
            """Do it in Draw mode. In another mode, refuse it and say why."""
            if shell.mode in ("draw", "merge", "rules", "physics", "cycle"):
                call()
            else:
                session.refused.emit(NOT_SHOWN)

        return act

    return (
        Action("undo", "Undo", of_drawing(history.undo), "Edit", "undo", ("Ctrl+Z",),
               history.canUndo, tip="Undo the last step"),
        Action("redo", "Redo", of_drawing(history.redo), "Edit", "redo",
               ("Ctrl+Shift+Z", "Ctrl+Y"), history.canRedo, tip="Do the undone step again"),
        Action("cut", "Cut", clipping.cut, "Edit", "", ("Ctrl+X",),
               lambda: drawn() and clipping.can_copy(), scope="canvas", section=1,
               tip="Move the selection to the clipboard"),
        Action("copy", "Copy", clipping.copy, "Edit", "", ("Ctrl+C",),
               lambda: drawn() and clipping.can_copy(), scope="canvas", section=1,
               tip="Copy what is selected as SMSL text, for any window or editor"),
        Action("paste", "Paste", clipping.paste, "Edit", "", ("Ctrl+V",), drawn,
               scope="canvas", section=1,
               tip="Paste what was copied, or any SMSL text, at the pointer"),
        Action("duplicate", "Duplicate", clipping.duplicate, "Edit", "", ("Ctrl+D",),
               lambda: drawn() and clipping.can_duplicate(), scope="canvas", section=1,
               tip="Add a copy of the selection next to it; of a state with the next free facts"),
        *selection_actions(drawing, drawn),
        Action("palette", "Find anything, or run a command", shell.open_palette, "Edit",
               "search", ("Ctrl+K",), section=2),
        Action("find", "Find in the drawing", search.open, "Edit", "", ("Ctrl+F",),
               drawn, section=2,
               tip="Go from hit to hit on the canvas, also by fact values such as Disk 2 = b"),
        Action("find_back", "Back to before the find", search.go_back, "Edit", "", ("Alt+Left",),
               lambda: drawn() and search.can_go_back(), section=2,
               tip="Show the place, the zoom and the selection as they were when it began"),
    )  # fmt: skip
