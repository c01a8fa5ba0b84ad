"""The shortcuts of a run, for a separate window beside the run's own window."""

from __future__ import annotations

from collections.abc import Collection

from PySide6.QtWidgets import QWidget

LENT = frozenset(
    {"run_play", "run_pause", "run_step", "run_stop", "replay_back", "mode_draw", "mode_run",
     "mode_supervise"}
)  # fmt: skip
"""The ids of the actions that work there. Actions that edit the drawing are not among them."""


def lend_run_keys(page: QWidget, window: QWidget, own: Collection[str] = ()) -> None:
    """Add the run's actions of ``window``, and those with the ids ``own``, to ``page``.

    The shortcut of an action works in the windows of all widgets to which it was added.
    """
    for action in window.actions():
        if action.objectName() in LENT.union(own):
            page.addAction(action)
