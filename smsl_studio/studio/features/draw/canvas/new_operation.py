"""NewOperation: asks for the name and the target of a new operation, and adds it."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPointF

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.names import fresh_state_name
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.connect_card import ConnectCard
from smsl_studio.studio.features.draw.canvas.free_places import on_grid
from smsl_studio.studio.features.draw.canvas.suggest import Suggestions

Edit = Callable[[str, Callable[[Blueprint], Blueprint]], str]
"""Edits the session: called with the words of the step and the change. Returns why that was
refused, or the empty text."""
Open = Callable[[ConnectCard, QPointF], None]
"""Opens a card near a point of the view (pixels)."""


class NewOperation:
    """Opens the card of a new operation, and shows its line while the card is open."""

    def __init__(self, session: Session, canvas: Canvas, edit: Edit, open_card: Open) -> None:
        self._session, self._canvas = session, canvas
        self._edit, self._open = edit, open_card

    def ask(self, source: Address, target: Address | None, at: QPointF, pattern: str = "") -> None:
        """Ask for the name of a new operation. Without a target, a new state is added at the point.

        Operation and state are added as one step. ``at`` is a scene point. ``pattern`` is the name
        to begin with, or what comes before its first ``{``.
        """
        branch, place = source.branch, on_grid(at)
        shown = self._session.blueprint[branch]
        suggestions = Suggestions(shown)
        asked = None if target is not None else fresh_state_name(shown)

        def commit(name: str, typed: str) -> str:
            """Add the operation and select it. Returns why that was refused, or the empty text."""
            goal = target.state if target is not None else typed
            if not goal:
                return "The operation has no target. Name a state."

            def change(blueprint: Blueprint) -> Blueprint:
                """The blueprint with the operation; a new target state is added first."""
                if goal not in blueprint[branch].table:
                    blueprint = editing.add_state(blueprint, branch, goal, place)
                return editing.add_operation(blueprint, branch, source.state, name, goal)

            reason = self._edit(f"Connect {source.state} to {goal}", change)
            if not reason:
                self._session.select((Address(branch, source.state, name),))
            return reason

        card = ConnectCard(
            self._canvas,
            self._canvas.tokens,
            suggestions.names(source.state),
            (suggestions.name_for(source.state, target.state if target else None), asked),
            commit,
            None if target else lambda name: suggestions.target_for(source.state, name),
        )

        def lead_to(state: str) -> None:
            """Show the target that was clicked, and the name that fits it."""
            card.suggest(suggestions.name_for(source.state, state))
            self._canvas.show_pending(source, Address(branch, state), at)

        def preview(state: str) -> None:
            """Show a preview of the line to the state of this name, or to a new state."""
            there = state.strip() in self._session.blueprint[branch].table
            known = Address(branch, state.strip()) if there else None
            point = at if known is not None else QPointF(*place)
            self._canvas.show_pending(source, known, point)

        card.target_named.connect(preview)
        card.target_picked.connect(lead_to)
        card.gone_on.connect(self._canvas.quick_add_wanted)
        if pattern:
            card.begin_with(pattern.partition("{")[0], whole="{" not in pattern)
        end = QPointF(*place) if target is None else at
        self._canvas.show_pending(source, target, end)
        drawn = self._canvas.gestures.drawn
        card.line = (drawn.start, drawn.end) if drawn is not None else None
        card.about = (source, target) if target is not None else (source,)
        self._open(card, QPointF(self._canvas.mapFromScene(at)))
        # A card that was open before has closed now, and its line was removed with it. So the line
        # of this card is shown last.
        self._canvas.show_pending(source, target, end)
