"""What it means to drop an operation of the library on a state, between two, or elsewhere."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QPointF

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.names import fresh_state_name
from smsl_studio.studio.base.canvas.sketch import Sketch, node_rect
from smsl_studio.studio.features.draw.canvas.drop_places import state_below, states_around
from smsl_studio.studio.features.draw.canvas.editor import CanvasEditor
from smsl_studio.studio.features.draw.canvas.free_places import free_place, on_grid
from smsl_studio.studio.features.draw.canvas.intent import Intent
from smsl_studio.studio.features.draw.canvas.suggest import Suggestions

NOWHERE = "Drop {} on a state or between two. On empty canvas it starts from the selected state."


class OperationDrop:
    """Knows what each place of the canvas would make of one operation.

    A name with ``{`` is the pattern of a plugin. Its beginning is offered, and the rest is typed.
    """

    def __init__(self, editor: CanvasEditor, name: str) -> None:
        self._editor, self._session, self._canvas = editor, editor.session, editor.canvas
        self._name = name
        self._whole = "{" not in name
        self._branch = self._session.blueprint.branches.get(self._session.branch)
        self._suggestions = Suggestions(self._branch) if self._branch is not None else None
        self._places: dict[str, tuple[float, float]] = {}
        """The free places beside states. A drag asks for them at every move of the pointer."""

    def at(self, point: QPointF) -> Intent:
        """What a drop at a scene point would do."""
        sheet = self._canvas.sheet
        if sheet is None or self._branch is None or not self._branch.table:
            return Intent("Add a state first. An operation starts from a state.")
        state = state_below(sheet, point)
        if state:
            return self.on_state(state)
        pair = states_around(sheet, point)
        if pair is not None:
            return self.between(*pair)
        chosen = self.selected()
        if len(chosen) == 1:
            return self._to_new(chosen[0], on_grid(point))
        return Intent(NOWHERE.format(self._name))

    def selected(self) -> list[str]:
        """The selected states of the SB that is shown, if nothing else is selected."""
        chosen = self._session.selection
        states = [a.state for a in chosen if a.state and not a.operation]
        here = all(a.branch == self._session.branch for a in chosen)
        return states if here and len(states) == len(chosen) else []

    def on_state(self, source: str) -> Intent:
        """Begin it at a state: to where the same operation leads by its effect, else to a new
        state.
        """
        assert self._suggestions is not None
        target = self._suggestions.target_for(source, self._name) if self._whole else ""
        if target:
            return self.between(source, target)
        if source not in self._places:
            self._places[source] = free_place(self._canvas, source)
        return self._to_new(source, self._places[source])

    def between(self, source: str, target: str) -> Intent:
        """Lead it from one state to another."""
        if self._is_taken(source):
            return Intent(f"{source} has an operation {self._name} already.")
        start, end = self._address(source), self._address(target)
        from_, to = self._canvas.rect_of(start), self._canvas.rect_of(end)
        assert from_ is not None
        assert to is not None
        middle = (from_.center() + to.center()) / 2
        act = partial(self._add, source, target)
        if not self._whole:
            act = partial(self._ask, start, end, (middle.x(), middle.y()))
        sketch = Sketch((), ((from_, to, self._name),))
        return Intent(f"{self._name}: {source} to {target}", act, sketch)

    def _to_new(self, source: str, place: tuple[float, float]) -> Intent:
        if self._is_taken(source):
            return Intent(f"{source} has an operation {self._name} already.")
        assert self._branch is not None
        start = self._address(source)
        rect, node = self._canvas.rect_of(start), node_rect(place)
        assert rect is not None
        act = partial(self._ask, start, None, place)
        sketch = Sketch(((node, fresh_state_name(self._branch)),), ((rect, node, self._name),))
        words = f"{self._name}: {source} to a new state, or to one that you click"
        return Intent(words, act, sketch)

    def _ask(self, source: Address, target: Address | None, place: tuple[float, float]) -> None:
        """Ask for the rest: the target, or what a pattern leaves open of the name."""
        self._canvas.setFocus()
        self._canvas.reveal(source, smooth=False)
        self._canvas.reveal_point(QPointF(*place), smooth=False)
        self._editor.new_operation.ask(source, target, QPointF(*place), self._name)

    def _add(self, source: str, target: str) -> None:
        branch, name = self._session.branch, self._name
        words = f"Connect {source} to {target}"
        if self._session.edit(
            words, lambda bp: editing.add_operation(bp, branch, source, name, target)
        ):
            made = Address(branch, source, name)
            self._session.select((made,))
            self._canvas.reveal(made)
            self._canvas.setFocus()

    def _is_taken(self, source: str) -> bool:
        return self._branch is not None and self._name in self._branch.table[source]

    def _address(self, state: str) -> Address:
        return Address(self._session.branch, state)
