"""The keys of a run, lent to what stands in a window of its own beside the run."""

from __future__ import annotations

from collections.abc import Collection

from PySide6.QtWidgets import QWidget

LENT = frozenset(
    {"run_play", "run_pause", "run_step", "run_stop", "replay_back", "mode_draw", "mode_run",
     "mode_supervise"}
)  # fmt: skip
"""The actions whose keys go on there; what edits the drawing is for who sees it."""


def lend_run_keys(page: QWidget, window: QWidget, own: Collection[str] = ()) -> None:
    """Have ``page`` answer the keys of a run as its window does: the same actions, its ``own``, and
    no others.

    The keys of an action count in the windows of all widgets that have it.
    """
    for action in window.actions():
        if action.objectName() in LENT.union(own):
            page.addAction(action)
