"""Align: the verbs that line the selected states up, distribute them, or space them equally."""

from __future__ import annotations

from functools import partial

import numpy as np
from PySide6.QtWidgets import QMenu

from smsl_studio.picture.alignment import (
    ARRANGEMENTS,
    SIDES,
    Box,
)
from smsl_studio.picture.levels import COMPACT_SIZE, FULL_SIZE, spacing_of
from smsl_studio.studio.base.actions import Action, Actions
from smsl_studio.studio.base.feature import Shell
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.features.draw.canvas.editor import CanvasEditor
from smsl_studio.studio.features.draw.canvas.tidy_work import TENTH

WORDS = {
    "left": ("Align left", "Put the left edges of the selected states on one line"),
    "centre": ("Align centre", "Put the selected states under each other, middle on middle"),
    "right": ("Align right", "Put the right edges of the selected states on one line"),
    "top": ("Align top", "Put the top edges of the selected states on one line"),
    "middle": ("Align middle", "Put the selected states beside each other, middle on middle"),
    "bottom": ("Align bottom", "Put the bottom edges of the selected states on one line"),
    "distribute_across": (
        "Distribute across",
        "Equal distances from middle to middle, from left to right; the outermost states stay",
    ),
    "distribute_down": (
        "Distribute down",
        "Equal distances from middle to middle, from top to bottom; the outermost states stay",
    ),
    "space_across": (
        "Space equally across",
        "Equal gaps from left to right, wide enough for an arrow",
    ),
    "space_down": (
        "Space equally down",
        "Equal gaps from top to bottom, wide enough for an arrow",
    ),
}
"""The words and the tip of each way to arrange states."""
BREAKS = ("top", "distribute_across", "space_across")
"""The rows of the menu with a line above them."""


class AlignVerbs:
    """Arranges the selected states of the SB that is shown, as one step."""

    def __init__(self, editor: CanvasEditor) -> None:
        self._editor, self._session, self._canvas = editor, editor.session, editor.canvas

    def can_align(self, least: int = 2) -> bool:
        """Whether at least this many states of the SB that is shown are selected."""
        return len(self._selected()) >= least

    def arrange(self, name: str) -> None:
        """Arrange the selected states in one of the ways of ``ARRANGEMENTS``.

        If nothing would change, say so.
        """
        boxes = self._boxes()
        places = ARRANGEMENTS[name](boxes)
        changed = {
            state: at
            for state, at in places.items()
            if abs(at[0] - boxes[state][0]) > TENTH or abs(at[1] - boxes[state][1]) > TENTH
        }
        if not changed:
            self._canvas.say("The selected states stand so already.")
            return
        branch = self._session.branch
        words = f"{WORDS[name][0]}: {counted(len(boxes), 'state')}"
        moved = self._session.places.moved
        self._session.edit(words, lambda bp: moved(bp, branch, changed))

    def _selected(self) -> list[str]:
        branch = self._session.branch
        chosen = self._session.selection
        return [a.state for a in chosen if a.branch == branch and a.state and not a.operation]

    def _boxes(self) -> dict[str, Box]:
        """The boxes of the selected states, with full nodes or, in a dense SB, compact ones.

        The selected states do not count for that: they may cover each other for a moment.
        """
        sheet = self._canvas.sheet
        assert sheet is not None
        names = self._selected()
        chosen = [sheet.picture.index[name] for name in names]
        others = (np.delete(part, chosen, 0) for part in
                  (sheet.at, sheet.full_widths, sheet.compact_widths))  # fmt: skip
        roomy = spacing_of(*others).roomy
        widths = sheet.full_widths if roomy else sheet.compact_widths
        height = (FULL_SIZE if roomy else COMPACT_SIZE)[1]
        return {
            name: (*sheet.at[state].tolist(), float(widths[state]), height)
            for name, state in zip(names, chosen, strict=True)
        }


def align_actions(align: AlignVerbs, shell: Shell) -> tuple[Action, ...]:
    """One action for each way to arrange states. They stand in the menu Align."""

    def enabled(least: int) -> bool:
        """Whether Draw mode is shown and enough states are selected."""
        return shell.mode == "draw" and align.can_align(least)

    return tuple(
        Action(f"align_{name}", words, partial(align.arrange, name), icon=_icon(name), tip=tip,
               enabled=partial(enabled, 3 if name.startswith("distribute") else 2))
        for name, (words, tip) in WORDS.items()
    )  # fmt: skip


def _icon(name: str) -> str:
    return f"align-{name}" if name in SIDES else name.replace("_", "-")


def fill_align(actions: Actions, menu: QMenu) -> None:
    """Fill the menu Align with its actions as they are enabled now."""
    menu.clear()
    actions.refresh()
    for name in WORDS:
        if name in BREAKS:
            menu.addSeparator()
        menu.addAction(actions[f"align_{name}"])
