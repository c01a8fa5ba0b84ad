"""What it means to drop a template of the library on a state or an operation."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from PySide6.QtCore import QPointF, QRectF

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.editing.templates import TRIES, Made, free_digit
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.studio.base.canvas.sketch import Sketch, node_rect
from smsl_studio.studio.base.words import counted, refusal_words
from smsl_studio.studio.features.draw.canvas.drop_places import state_below
from smsl_studio.studio.features.draw.canvas.editor import CanvasEditor
from smsl_studio.studio.features.draw.canvas.free_places import SIBLINGS, free_place
from smsl_studio.studio.features.draw.canvas.intent import Intent

CONFIRM: Mapping[str, Any] = {
    "confirm": ["supervisor"],
    "question": "Is everything ready for this?",
    "answer_within": 120,
}
"""What the template of a confirmation writes. Properties changes it."""
TIMEOUT = 60
"""The time limit that the template writes, in seconds."""


@dataclass(frozen=True)
class Template:
    """A template: what the library and the menu call it, its icon, and what it is good for."""

    name: str
    icon: str
    tip: str


TEMPLATES: Mapping[str, Template] = {
    "recovery": Template(
        "Recovery", "undo", "A failure state of a state, and an operation that leads back"
    ),
    "confirmation": Template(
        "Confirmation by a person", "person", "A supervisor is asked before an operation begins"
    ),
    "retry": Template(
        "Retry with a limit",
        "loop",
        f"An operation is tried {TRIES} more times; then the run holds",
    ),
    "timeout": Template(
        "Time-out", "clock", f"An operation that takes longer than {TIMEOUT} s has failed"
    ),
    "sub_sb": Template("Sub-SB", "layers", "A new State Branch expands a fact"),
}


class TemplateDrop:
    """Knows what each place of the canvas would make of one template."""

    def __init__(self, editor: CanvasEditor, kind: str) -> None:
        self._editor, self._session, self._canvas = editor, editor.session, editor.canvas
        self._kind = kind
        self._known: dict[tuple[Address, int], Intent] = {}
        """A drag asks at every move of the pointer, and a sketch takes an edit."""

    def at(self, point: QPointF) -> Intent:
        """What a drop at a scene point would do."""
        sheet = self._canvas.sheet
        state = state_below(sheet, point) if sheet is not None else ""
        if sheet is not None and state:
            digit = self._canvas.hand.hover.fact_at(sheet.picture.index[state], point)
            return self.on(Address(self._session.branch, state), digit)
        edge = sheet.operation_at(point.x(), point.y()) if sheet is not None else -1
        if sheet is not None and edge >= 0:
            return self.on(sheet.picture.address(edge))
        return self.on(Address(self._session.branch))

    def on(self, address: Address, digit: int = -1) -> Intent:
        """What it would do to a state (at a fact of it), an operation, or the SB."""
        found = self._known.get((address, digit))
        if found is None:
            try:
                found = self._found(address, digit)
            except EditRefused as error:
                found = Intent(refusal_words(error))
            self._known[address, digit] = found
        return found

    def _found(self, address: Address, digit: int) -> Intent:
        if self._session.branch not in self._session.blueprint.branches:
            return Intent("Add a state first.")
        if self._kind == "sub_sb":
            return self._sub_sb(digit)
        if not address.state:
            wanted = "state" if self._kind == "recovery" else "operation"
            return Intent(f"{TEMPLATES[self._kind].name}: choose the {wanted} that it is for.")
        if self._kind == "recovery":
            return self._recovery(Address(address.branch, address.state))
        edges = self._edges(address)
        if not edges:
            return Intent(f"No operation starts from {address.state}. Add one first.")
        if self._kind == "retry":
            if len(edges) > 1:
                return Intent("Choose the operation that is tried again.")
            return self._retry(edges[0])
        return self._noted(edges)

    def _edges(self, address: Address) -> list[Address]:
        """The operation itself, or all that start from a state."""
        if address.operation:
            return [address]
        row = self._session.blueprint[address.branch].table[address.state]
        return [Address(address.branch, address.state, name) for name in row]

    def _recovery(self, state: Address) -> Intent:
        place = free_place(self._canvas, state.state, SIBLINGS)
        change = partial(_recovered, state, place)
        made = change(self._session.blueprint)[1]
        node, rect = node_rect(place), self._rect(state)
        name = made[0].state
        sketch = Sketch(((node, name),), ((node, rect, made[1].operation),))
        words = f"{name}, a failure of {state.state}, and {made[1].operation} back"
        return Intent(words, partial(self._do, f"Add a recovery to {state.state}", change), sketch)

    def _retry(self, edge: Address) -> Intent:
        change = partial(_tried, edge)
        made = change(self._session.blueprint)[1]
        words = f"{edge.operation} is tried {len(made)} more times, each at a higher cost"
        step = f"Add tries of {edge.operation}"
        return Intent(words, partial(self._do, step, change), self._lines(edge))

    def _noted(self, edges: list[Address]) -> Intent:
        confirms = self._kind == "confirmation"
        changes = self._changes(edges, CONFIRM if confirms else {"timeout": TIMEOUT})
        if not changes:
            return Intent("A person confirms it already." if confirms else "It has a time limit.")
        one = len(changes) == 1
        what = next(iter(changes)).operation if one else counted(len(changes), "operation")
        if confirms:
            words = f"A supervisor confirms {what} before {'it begins' if one else 'they begin'}"
        else:
            words = f"{what} {'fails' if one else 'fail'} after {TIMEOUT} s"
        change = partial(_annotated, changes)
        change(self._session.blueprint)
        step = f"{'Confirm' if confirms else 'Limit the time of'} {what}"
        return Intent(words, partial(self._do, step, change), self._lines(*changes))

    def _changes(
        self, edges: list[Address], note: Mapping[str, Any]
    ) -> dict[Address, dict[str, Any]]:
        """What each operation gets: the words that it has not, if it lacks the first of them."""
        changes = {}
        for edge in edges:
            had = self._session.blueprint[edge.branch].operation_note(edge.state, edge.operation)
            lacks = {word: value for word, value in note.items() if not getattr(had, word)}
            if next(iter(note)) in lacks:
                changes[edge] = lacks
        return changes

    def _sub_sb(self, digit: int) -> Intent:
        branch = self._session.blueprint[self._session.branch]
        digit = digit if digit >= 0 else free_digit(branch)
        if digit < 0:
            return Intent("A sub-SB expands a fact. Add a state with a fact that has none yet.")
        if len(branch.alphabet[digit]) > 2:
            return Intent("A sub-SB expands a fact with two values. This one has more.")
        change = partial(_expanded, branch.name, digit)
        name = change(self._session.blueprint)[1][0].branch
        fact = branch.fact_name(digit)
        act = partial(self._do, f"Let {name} expand {fact}", change)
        return Intent(f"{name}, a new State Branch, expands {fact} (digit {digit})", act)

    def _do(self, words: str, change: Callable[[Blueprint], Made]) -> None:
        """Make the edit as one step; show and select what it added or changed."""
        session, made = self._session, change(self._session.blueprint)[1]
        if session.edit(words, lambda bp: change(bp)[0]):
            session.show_branch(made[0].branch)
            session.select(made)
            self._canvas.reveal(made[0])
            self._canvas.setFocus()

    def _lines(self, *edges: Address) -> Sketch:
        table = self._session.blueprint[edges[0].branch].table
        ends = [(edge, table[edge.state][edge.operation]) for edge in edges]
        lines = tuple(
            (self._rect(Address(edge.branch, edge.state)), rect, edge.operation)
            for edge, target in ends
            if (rect := self._canvas.rect_of(Address(edge.branch, target))) is not None
        )
        return Sketch((), lines)

    def _rect(self, state: Address) -> QRectF:
        rect = self._canvas.rect_of(state)
        assert rect is not None
        return rect


def _recovered(state: Address, place: tuple[float, float], blueprint: Blueprint) -> Made:
    return editing.add_recovery(blueprint, state, place)


def _tried(edge: Address, blueprint: Blueprint) -> Made:
    return editing.add_tries(blueprint, edge)


def _expanded(base: str, digit: int, blueprint: Blueprint) -> Made:
    return editing.expand_fact(blueprint, base, digit)


def _annotated(notes: Mapping[Address, Mapping[str, Any]], blueprint: Blueprint) -> Made:
    changes = {(e.branch, note_key(e.operation, e.state)): note for e, note in notes.items()}
    return editing.change_notes(blueprint, "_operations", changes), tuple(notes)
