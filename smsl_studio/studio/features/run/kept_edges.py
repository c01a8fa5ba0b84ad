"""Edges that counted in one run: they may be kept in the drawing afterwards."""

from __future__ import annotations

from smsl_studio.blueprint.editing.generated_edges import with_edges
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.running.run_session import RunSession
from smsl_studio.studio.running.window_parts import WindowParts


def offer_to_keep(run: RunSession, parts: WindowParts, exists: bool) -> None:
    """Offer to draw the edges that counted in a run, once it has ended: one step of the history."""
    made = dict(run.status.generated) if run.status is not None else {}
    if exists or not made or run.foreign:
        return
    what, are = counted(len(made), "operation"), "is" if len(made) == 1 else "are"
    words = f"Keep {what} of the run"

    def keep() -> None:
        """Draw them."""
        parts.session.edit(words, lambda drawn: with_edges(drawn, made))

    parts.toast.tell(f"{what} of this run {are} not in the drawing.", "Keep in the drawing", keep)
