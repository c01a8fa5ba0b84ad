"""StateCopy: proposes the copy of a state on the canvas, and makes it after a yes."""

from __future__ import annotations

from PySide6.QtCore import QPointF

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.canvas.sketch import Sketch, node_rect
from smsl_studio.studio.features.draw.canvas.copy_card import CopyCard
from smsl_studio.studio.features.draw.canvas.editor import CanvasEditor
from smsl_studio.studio.features.draw.canvas.free_places import free_place, on_grid


class StateCopy:
    """Asks for the copy of one state: a card with its facts, and a sketch where it will stand."""

    def __init__(self, editor: CanvasEditor) -> None:
        self._editor, self._session, self._canvas = editor, editor.session, editor.canvas

    def can_ask(self) -> bool:
        """Whether exactly one state of the SB that is shown is selected."""
        chosen = self._session.selection
        one = len(chosen) == 1 and chosen[0].state and not chosen[0].operation
        return bool(one) and chosen[0].branch == self._session.branch and self._canvas.editing

    def ask(self) -> None:
        """Propose a copy of the selected state, at a free place in view."""
        (state,) = self._session.selection
        canvas, branch = self._canvas, self._session.blueprint[state.branch]
        canvas.setFocus()
        canvas.reveal(state, smooth=False)
        place = on_grid(QPointF(*free_place(canvas, state.state)))
        canvas.reveal_point(QPointF(*place), smooth=False)

        def commit(name: str) -> str:
            """Add the copy and select it. Returns why that was refused, or the empty text."""
            reason = self._editor.edit(
                f"Duplicate {state.state} as {name}",
                lambda bp: editing.duplicate_state(bp, state, name, place),
            )
            if not reason:
                self._session.select((Address(state.branch, name),))
            return reason

        def sketch(name: str) -> None:
            """Show where the copy will stand."""
            canvas.gestures.put("sketch", Sketch(((node_rect(place), name),)))

        card = CopyCard(canvas, canvas.tokens, branch, state.state, commit)
        card.named.connect(sketch)
        card.closed.connect(lambda: canvas.gestures.put("sketch", None))
        self._editor.open_card(card, QPointF(canvas.mapFromScene(QPointF(*place))))
        sketch(card.name.text())
