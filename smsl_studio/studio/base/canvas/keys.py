"""The keys of the canvas. They act only while the canvas has the keyboard focus."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent

from smsl_studio.studio.base.announcement import announce
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.camera import STEP
from smsl_studio.studio.base.canvas.drawn_keys import ARROWS, press_drawn_key
from smsl_studio.studio.base.canvas.gestures import GRID
from smsl_studio.studio.base.canvas.operation_steps import (
    go_to_source,
    go_to_target,
    step_operation,
)
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.words import counted

Key, Modifier = Qt.Key, Qt.KeyboardModifier
VERBS = {
    Key.Key_C: "copy",
    Key.Key_X: "cut",
    Key.Key_V: "paste",
    Key.Key_D: "duplicate",
    Key.Key_F: "find",
}
"""The window actions for Ctrl and a key while the canvas has the focus."""
WAYS: dict[Qt.Key, tuple[Callable[[BranchView], bool], Callable[[BranchView], bool]]] = {
    Key.Key_O: (partial(step_operation, step=1), partial(step_operation, step=-1)),
    Key.Key_G: (go_to_target, go_to_source),
}
"""Keys that lead along operations, alone and with Shift."""
MISSING = {
    Key.Key_O: "Select one state first: Ctrl and an arrow. O then leads to its operations.",
    Key.Key_G: "Select one operation first: O on a state. G then leads to its target.",
}
"""What is said where such a key leads nowhere."""
NOTHING = "Nothing is selected. Ctrl and an arrow selects a state."
PLAIN = Modifier.NoModifier
NEEDS = {
    (PLAIN, Key.Key_F2), (PLAIN, Key.Key_Delete), (PLAIN, Key.Key_D), (PLAIN, Key.Key_B),
    (Modifier.ShiftModifier, Key.Key_B),
    *((Modifier.ControlModifier, key) for key in (Key.Key_C, Key.Key_X, Key.Key_D, Key.Key_G)),
}  # fmt: skip
"""Keys, with what is held, that do nothing as long as nothing is selected."""
NOTES = Modifier.ControlModifier | Modifier.AltModifier, Key.Key_M
"""The next note or group; without one the row of the menu waits, and the key comes here."""
WORDS = {(-1.0, 0.0): "left", (1.0, 0.0): "right", (0.0, -1.0): "up", (0.0, 1.0): "down"}
PAN_STEP = 64.0
ENTER = (Key.Key_Return, Key.Key_Enter)


def press(canvas: BranchView, event: QKeyEvent) -> bool:
    """Act on a key; False if the canvas has no use for it."""
    key = Key(event.key())
    modifiers = event.modifiers() & ~Modifier.KeypadModifier
    if press_drawn_key(canvas, key, modifiers):
        return True
    nothing = not canvas.marks.selection and canvas.drawn.chosen is None
    if canvas.editing and nothing and (modifiers, key) in NEEDS:
        canvas.say(NOTHING)
        return True
    if (modifiers, key) == NOTES and canvas.sheet and not canvas.sheet.drawn.listed():
        canvas.say("There is no note and no group here.")
        return True
    if key in ARROWS and not modifiers & ~(Modifier.ShiftModifier | Modifier.ControlModifier):
        return _arrow(canvas, *ARROWS[key], modifiers)
    if _is_view_key(canvas, key, event.text(), modifiers):
        return True
    if key in WAYS and not modifiers & ~Modifier.ShiftModifier:
        if not WAYS[key][bool(modifiers)](canvas):
            canvas.say(MISSING[key])
        return True
    if modifiers == Modifier.ControlModifier and key == Key.Key_A:
        select_all(canvas)
        return True
    if modifiers == Modifier.ControlModifier and key in VERBS and canvas.editing:
        canvas.verb_wanted.emit(VERBS[key])
        return True
    if key == Key.Key_Backtab and canvas.editing and canvas.marks.selection:
        canvas.sibling_wanted.emit()
        return True
    if key == Key.Key_K and canvas.editing and not modifiers & ~Modifier.ShiftModifier:
        if not any(address.state for address in canvas.marks.selection):
            canvas.say("Select one or more states first. K then pins them, Shift+K unpins them.")
        canvas.verb_wanted.emit("unpin" if modifiers else "pin")
        return True
    if modifiers:
        return False
    return _edit_key(canvas, key, event.text())


def _is_view_key(
    canvas: BranchView, key: Qt.Key, text: str, modifiers: Qt.KeyboardModifier
) -> bool:
    shift = modifiers == Modifier.ShiftModifier
    if (not modifiers and key == Key.Key_F) or (shift and key in (Key.Key_1, Key.Key_Exclam)):
        canvas.fit()
    elif shift and key in (Key.Key_0, Key.Key_ParenRight, Key.Key_Equal) and text != "+":
        canvas.zoom_to(1.0)
    elif text in ("+", "="):
        canvas.zoom_to(canvas.zoom * STEP)
    elif text == "-" and not modifiers:
        canvas.zoom_to(canvas.zoom / STEP)
    else:
        return False
    return True


def _edit_key(canvas: BranchView, key: Qt.Key, text: str) -> bool:
    selection = canvas.marks.selection
    if key == Key.Key_Escape:
        canvas.selection_wanted.emit(())
        if selection:
            announce(canvas, "Nothing is selected.")
    elif key in ENTER and canvas.editing and not canvas.positions:
        canvas.quick_add_wanted.emit()
    elif key in ENTER:
        return enter_sub(canvas)
    elif key == Key.Key_Backspace:
        canvas.leave_wanted.emit()
    elif not canvas.editing:
        return False
    elif key == Key.Key_Delete:
        canvas.delete_wanted.emit()
    elif key == Key.Key_F2 and len(selection) == 1:
        canvas.rename_wanted.emit(selection[0])
    elif key == Key.Key_F2:
        canvas.say(f"{len(selection):,} are selected. F2 renames one: select it alone first.")
    elif key == Key.Key_Tab or text == "/":
        canvas.quick_add_wanted.emit()
    elif key == Key.Key_C:
        canvas.verb_wanted.emit("connect")
    elif key == Key.Key_D:
        canvas.verb_wanted.emit("set_value")
    else:
        return False
    return True


def enter_sub(canvas: BranchView) -> bool:
    """Show the sub-SB of this SB. If there are several or none, a sentence says so."""
    sheet = canvas.sheet
    if sheet is None:
        return False
    subs = list(dict.fromkeys(sheet.picture.branch.subs.values()))
    if len(subs) == 1:
        canvas.enter_wanted.emit(subs[0])
    elif subs:
        canvas.say("Several facts have a sub-SB. Double-click the fact to enter its own.")
    else:
        canvas.say(f"No fact of {sheet.picture.branch.name} has a sub-SB to open.")
    return True


def select_all(canvas: BranchView) -> None:
    """Select every state that is shown."""
    sheet = canvas.sheet
    if sheet is not None:
        count = len(sheet.picture)
        canvas.selection_wanted.emit(tuple(sheet.address_of_state(i) for i in range(count)))
        announce(canvas, f"{counted(count, 'state')} selected.")


def _arrow(canvas: BranchView, dx: float, dy: float, modifiers: Qt.KeyboardModifier) -> bool:
    """Move the selected states, or with Ctrl select the next one; False if there is no use.

    Without ``editing`` an arrow selects as with Ctrl. Without a selected state it pans.
    """
    shift = bool(modifiers & Modifier.ShiftModifier)
    ctrl = bool(modifiers & Modifier.ControlModifier)
    sheet = canvas.sheet
    states = [s for a in canvas.marks.selection if sheet and (s := sheet.picture.node(a)) >= 0]
    if ctrl and not canvas.editing:
        return False
    if sheet is None or not (states or (ctrl and len(sheet.at))):
        if not canvas.marks.selection:
            # Those who see it see the view move. Others hear why no state has moved.
            announce(canvas, f"{NOTHING} The view has moved.")
        canvas.camera.pan(-dx * PAN_STEP, -dy * PAN_STEP)
    elif canvas.editing and not ctrl:
        step = 1.0 if shift else GRID
        canvas.nudge_wanted.emit(dx * step, dy * step)
        moved = sheet.picture.names[states[0]] if len(states) == 1 else f"{len(states):,} states"
        announce(canvas, f"{moved} moved {WORDS[dx, dy]} by {step:g}.")
    else:
        _select_next(canvas, sheet, states, (dx, dy), shift)
    return True


def _select_next(
    canvas: BranchView, sheet: Sheet, states: list[int], way: tuple[float, float], extend: bool
) -> None:
    """Select the next state in a direction, or the one in the middle of the view as the first."""
    if states:
        step = sheet.at - sheet.at[states[-1]]
        along = step[:, 0] * way[0] + step[:, 1] * way[1]
        across = np.abs(step[:, 0] * way[1] + step[:, 1] * way[0])
        # Sideways distance counts double, so that the next state is one of the same row.
        cost = np.where(along > 1.0, along + 2.0 * across, np.inf)
    else:
        middle = canvas.seen.center()
        cost = np.abs(sheet.at - (middle.x(), middle.y())).sum(axis=1)
    best = int(cost.argmin())
    if not np.isfinite(cost[best]):
        return
    address = sheet.address_of_state(best)
    chosen = (*canvas.marks.selection, address) if extend else (address,)
    canvas.selection_wanted.emit(tuple(dict.fromkeys(chosen)))
    canvas.reveal(address)
    if len(canvas.marks.selection) > 1:
        announce(canvas, f"{len(canvas.marks.selection):,} selected.")
