"""The rows of the View menu that lead along operations, for those who use no pointer."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.operation_steps import (
    go_to_source,
    go_to_target,
    step_operation,
)

ALONG = "Along operations"
"""The submenu of the menu View."""


def walk_actions(canvas: Canvas, drawn: Callable[[], bool]) -> tuple[Action, ...]:
    """From a state to its operations, and from an operation to its states."""

    def one() -> bool:
        """Whether one state or operation is selected."""
        return drawn() and len(canvas.marks.selection) == 1

    def on_operation() -> bool:
        """Whether one operation is selected."""
        return one() and bool(canvas.marks.selection[0].operation)

    def bundled() -> bool:
        """Whether operations are drawn as one line."""
        return drawn() and canvas.collapsed

    return (
        Action("next_operation", "Next operation of the state",
               partial(step_operation, canvas, 1), "View", "", ("O",), one, scope="canvas",
               section=1, inner=ALONG,
               tip="Select the next operation that leaves the selected state"),
        Action("previous_operation", "Previous operation of the state",
               partial(step_operation, canvas, -1), "View", "", ("Shift+O",), one,
               scope="canvas", section=1, inner=ALONG),
        Action("go_to_target", "Go to its target", partial(go_to_target, canvas), "View", "",
               ("G",), on_operation, scope="canvas", section=1, inner=ALONG,
               tip="Select the state that the selected operation leads to"),
        Action("go_to_source", "Go to its source", partial(go_to_source, canvas), "View", "",
               ("Shift+G",), on_operation, scope="canvas", section=1, inner=ALONG,
               tip="Select the state that the selected operation leaves"),
        Action("list_bundle", "List the next bundle", partial(canvas.hand.list_bundle, 1), "View",
               "", ("L",), bundled, scope="canvas", section=1, inner=ALONG,
               tip="Show the operations of the next thick line; Shift+L: of the former one"),
    )  # fmt: skip
