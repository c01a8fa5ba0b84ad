"""The keys of the canvas, for the list of shortcuts."""

from __future__ import annotations

CANVAS_KEYS = (
    ("Add an operation from the selected state, or go on from its new state", "Tab or /"),
    ("Add a sibling of the selected operation or state", "Shift+Tab"),
    ("Pan", "Space and drag, or the middle button"),
    ("Zoom", "Mouse wheel"),
    ("Add a state there", "Double click on empty canvas"),
    ("Connect", "Drag from a state's handle"),
    ("Move the selected states", "Arrows; with Shift by one pixel"),
    ("Drag without snapping to grid and states", "Alt"),
    ("Bend the selected operation, move its label", "Drag its line, its label"),
    ("Remove a bend", "Double click on its handle"),
    ("Select the next state", "Ctrl and an arrow; with Shift it is added"),
    ("Select several", "Drag over empty canvas, Shift and click"),
    ("Edit a selected note, or the title of a selected group", "Enter or F2"),
)
