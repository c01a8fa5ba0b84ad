"""The keys of the canvas while a note or a group is selected."""

from __future__ import annotations

from PySide6.QtCore import Qt

from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.gestures import GRID

Key, Modifier = Qt.Key, Qt.KeyboardModifier
ARROWS = {
    Key.Key_Left: (-1.0, 0.0),
    Key.Key_Right: (1.0, 0.0),
    Key.Key_Up: (0.0, -1.0),
    Key.Key_Down: (0.0, 1.0),
}


def press_drawn_key(canvas: BranchView, key: Qt.Key, modifiers: Qt.KeyboardModifier) -> bool:
    """Act on a key; False if nothing of the kind is selected, or if the key is not about it."""
    chosen = canvas.drawn.chosen
    if chosen is None or not canvas.editing or modifiers & ~Modifier.ShiftModifier:
        return False
    if key in ARROWS:
        step = 1.0 if modifiers & Modifier.ShiftModifier else GRID
        dx, dy = ARROWS[key]
        canvas.drawn_nudge_wanted.emit(dx * step, dy * step)
    elif modifiers:
        return False
    elif key in (Key.Key_F2, Key.Key_Return, Key.Key_Enter):
        canvas.drawn_edit_wanted.emit(chosen)
    elif key == Key.Key_Delete:
        canvas.delete_wanted.emit()
    else:
        return False
    return True
