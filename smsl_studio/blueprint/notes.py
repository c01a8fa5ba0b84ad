"""All annotations of one SB, read from its ``_`` fields.

``annotations`` has the kinds of notes and their checks. It is loaded only if an SB has a note.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from typing import TYPE_CHECKING, Any

from smsl_studio.blueprint.address import note_key
from smsl_studio.blueprint.edge_layout import IN_LAYOUT, Edge, EdgeLayout, edge_layouts_of, point_of
from smsl_studio.blueprint.pins import PINNED, pins_of

if TYPE_CHECKING:
    from smsl_studio.blueprint.annotations import FactNote, OperationNote, StateNote
    from smsl_studio.blueprint.predicates import FactSense

Json = Any


@dataclass(frozen=True)
class Notes:
    """The annotations of one SB, and the faults in them with their paths.

    ``written`` has the keys in each entry of ``operations``.
    """

    facts: Mapping[int, FactNote] = field(default_factory=dict)
    states: Mapping[str, StateNote] = field(default_factory=dict)
    operations: Mapping[str, OperationNote] = field(default_factory=dict)
    layout: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    edges: Mapping[Edge, EdgeLayout] = field(default_factory=dict)
    """The lines of operations that are drawn by hand."""
    pinned: frozenset[str] = frozenset()
    """The states that a tidy drawing leaves where they are. Each has a place in ``layout``."""
    faults: tuple[tuple[tuple[str, ...], str], ...] = ()
    written: Mapping[str, frozenset[str]] = field(default_factory=dict)
    senses: Mapping[int, FactSense] = field(default_factory=dict)
    """How facts are sensed whose entry has sources or predicates."""

    def operation(self, state: str, operation: str) -> OperationNote:
        """Return the note of one edge: that of its name, with the changes of the edge's own
        note.
        """
        if not self.operations:
            return _plain()
        key = note_key(operation, state)
        common, own = self.operations.get(note_key(operation)), self.operations.get(key)
        if common is None or own is None:
            return own or common or _plain()
        return replace(common, **{word: getattr(own, word) for word in self.written[key]})


def read_notes(fields: Mapping[str, Json]) -> Notes:
    """Return the annotations in an SB's ``_`` fields. ``faults`` has paths and reasons."""
    from smsl_studio.blueprint.annotations import (
        FactNote,
        OperationNote,
        StateNote,
        validated,
        with_words,
    )

    faults: list[tuple[tuple[str, ...], str]] = []

    def table(key: str) -> dict[str, Json]:
        """Return the map under ``key``, or an empty one. Another value is a fault."""
        raw = fields.get(key, {})
        if isinstance(raw, dict):
            return raw
        faults.append(((key,), f"{key} must be a map"))
        return {}

    facts: dict[int, FactNote] = {}
    senses: dict[int, FactSense] = {}
    for digit, raw in table("_facts").items():
        fact = validated(FactNote, raw, ("_facts", digit), faults)
        if fact is not None and digit.isdecimal() and digit.isascii():
            facts[int(digit)] = fact
        elif fact is not None:
            faults.append((("_facts", digit), f"{digit!r} is no digit of a fact"))
        if isinstance(raw, dict) and not _SENSED.isdisjoint(raw) and digit.isdecimal():
            sense = _sense(raw)
            if sense is not None:
                senses[int(digit)] = sense
    states: dict[str, StateNote] = {}
    for name, raw in table("_states").items():
        state = validated(StateNote, raw, ("_states", name), faults)
        if state is not None:
            states[name] = state
    operations: dict[str, OperationNote] = {}
    written: dict[str, frozenset[str]] = {}
    for name, raw in table("_operations").items():
        path = ("_operations", name)
        operation, words = with_words(OperationNote, raw, path, faults)
        if operation is not None:
            operations[name], written[name] = operation, words
    layout: dict[str, tuple[float, float]] = {}
    edges: Mapping[Edge, EdgeLayout] = {}
    drawn = table("_layout")
    for name, at in drawn.items():
        if name == IN_LAYOUT:
            edges = edge_layouts_of(at, faults)
        if name.startswith("_"):
            continue  # what is drawn besides the places of states, see ``drawn``
        point = point_of(at)
        if point is not None:
            layout[name] = point
        else:
            faults.append((("_layout", name), "a position is [x, y]"))
    pinned = pins_of(drawn[PINNED], layout, faults) if PINNED in drawn else frozenset()
    return Notes(facts, states, operations, layout, edges, pinned, tuple(faults), written, senses)


_SENSED = frozenset(("sources", "predicate", "range"))


def _sense(raw: Mapping[str, Json]) -> FactSense | None:
    """Return how a fact is sensed. Most files have no predicates, and load nothing for them."""
    if (
        isinstance(raw.get("predicate", ""), str)
        and not raw.get("sources")
        and not raw.get("range")
    ):
        return None
    from smsl_studio.blueprint.predicates import sense_of

    return sense_of(raw)


NO_NOTES = Notes()
"""The notes of an SB without annotations."""


@cache
def _plain() -> OperationNote:
    """Return the note of an operation without annotations."""
    from smsl_studio.blueprint.annotations import PLAIN

    return PLAIN
