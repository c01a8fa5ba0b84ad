"""Moves chosen states of an SB into a new sub-SB, and writes the result.

Some operations only bring the sub-SB to ACTIVATING. Both SBs have such an operation. Other
operations also change further facts of the base. Only the base has them, and they set the facts of
the sub-SB themselves (``"subs": "load"``).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from smsl_studio.blueprint.address import Address, fact_text, note_key
from smsl_studio.blueprint.editing.draft import Draft, free_name
from smsl_studio.blueprint.editing.levels import levels_spread
from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.facts import shape_of
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.pins import PINNED, renamed_pins
from smsl_studio.blueprint.reading import HEADER
from smsl_studio.generate.shapes.chosen import CutRefused
from smsl_studio.generate.shapes.claims import named_places
from smsl_studio.generate.shapes.cut import Cut, Values, is_loaded
from smsl_studio.generate.shapes.moves import FactMoves
from smsl_studio.generate.shapes.state_names import (
    free_name_beside,
    named_by_facts,
    written_count,
)

Json = Any
OFF, ON = "0", "1"


def extracted(blueprint: Blueprint, cut: Cut, name: str) -> Blueprint:
    """Return the blueprint with the chosen states in an SB of their own.

    EditRefused if ``name`` is not free, or if a condition could not follow.
    """
    free_name(name, blueprint.branches, "a State Branch")
    return _Extraction(blueprint, cut, name).blueprint()


def fact_moves(blueprint: Blueprint, cut: Cut, name: str) -> FactMoves:
    """Return the new place of each fact of the base after the states were moved into ``name``."""
    base = cut.chosen.branch.name
    facts = {(base, digit): (base, at) for at, digit in enumerate(cut.kept)}
    facts |= {(base, digit): (name, at) for at, digit in enumerate(cut.digits)}
    return FactMoves(blueprint, facts)


class _Extraction:
    """The two SBs, while they are written."""

    def __init__(self, blueprint: Blueprint, cut: Cut, name: str) -> None:
        self._before, self._cut, self._name = blueprint, cut, name
        self._branch, self._chosen = cut.chosen.branch, cut.chosen
        self._levels = Levels(blueprint)
        self._base = self._branch.name
        self._moves = fact_moves(blueprint, cut, name)
        self._facts = self._moves.facts
        self._outer = named_by_facts(self._branch.table, self._base_facts(), self._branch)
        inner = {one: self._chosen.values(one, cut.digits) for one in self._chosen.states}
        self._done = free_name_beside("State_done", inner)
        self._inner = named_by_facts(inner, inner | {self._done: cut.done}, self._branch)
        self._place = self._outer[self._chosen.entry]

    def blueprint(self) -> Blueprint:
        """Return the blueprint."""
        self._refuse_named()
        draft = Draft(self._before)
        self._moves.follow(draft, self._new_state)
        levels_spread(draft, self._spread)
        file = draft.file(self._before.home(self._base))
        raw = draft.at(self._base)
        written = {self._base: self._written_base(raw), self._name: self._written_sub(raw)}
        values = [
            pair
            for key, value in file.items()
            for pair in (written.items() if key == self._base else [(key, value)])
        ]
        file.clear()
        file.update(values)
        after = draft.done()
        self._moves.must_be_named(after)
        return after

    def _base_facts(self) -> dict[str, Values]:
        """Return the facts of the states of the base; the entry stands for all chosen ones."""
        found = {}
        for state in (*self._chosen.outside, self._chosen.entry):
            digit = ON if state in self._cut.on else OFF
            found[state] = (*self._chosen.values(state, self._cut.kept), digit)
        return {state: found[state] for state in self._branch.table if state in found}

    # the base

    def _written_base(self, raw: dict[str, Json]) -> dict[str, Json]:
        facts = self._base_facts()
        header = dict(raw.get(HEADER) or {})
        header["INITIAL"] = self._at(self._branch.initial)
        header["ACTIVATING"] = self._at(self._branch.activating)
        if "NUM_FACTS" in header:
            header["NUM_FACTS"] = len(self._cut.kept) + 1
        if "NUM_STATES" in header:
            header["NUM_STATES"] = len(facts)
        moved = {digit: at for at, digit in enumerate(self._cut.kept)}
        subs = {sub: moved[digit] for digit, sub in self._branch.subs.items()}
        header["SUB_SBS"] = {**subs, self._name: len(self._cut.kept)}
        states: dict[str, Json] = {}
        for key, value in raw.items():
            if key == self._chosen.entry:
                states[self._place] = {e.name: self._at(e.target) for e in self._chosen.leaving}
            elif key in facts:
                states[self._outer[key]] = {
                    op: target if op.startswith("_") else self._at(target)
                    for op, target in value.items()
                }
        notes = {key: value for key, value in raw.items() if key.startswith("_")}
        notes["_facts"] = self._fact_notes(raw, self._cut.kept) | {
            str(len(self._cut.kept)): {"name": self._name, "on": ON}
        }
        notes["_states"] = self._state_notes(raw, facts, self._outer)
        notes["_operations"] = self._base_notes(raw)
        notes["_layout"] = _layout_part(raw, {key: self._outer[key] for key in facts})
        return {HEADER: header, **_filled(notes), **states}

    def _at(self, state: str) -> str:
        """Return the state of the base in which it is when it was in a state before."""
        return self._place if self._chosen.contains(state) else self._outer.get(state, state)

    def _base_notes(self, raw: dict[str, Json]) -> dict[str, Json]:
        written = _table(raw, "_operations")
        edges = [*self._chosen.leaving, *self._chosen.around]
        used = {edge.name for edge in edges}
        driven = {*self._cut.exits, *self._cut.returns}
        found = {
            key: self._touched(note, self._base) for key, note in written.items() if key in used
        }
        for edge in edges:
            own = dict(_note(written, note_key(edge.name, edge.source)))
            if self._chosen.contains(edge.source):
                own = self._same_note(written, edge)
            if edge in driven:
                # The operation of the sub-SB runs the function. A second binding would run it
                # twice.
                own.pop("binding", None)
            needs = self._needed(edge)
            if needs:
                own["requires"] = {**self._required(written, edge), **needs}
            if is_loaded(self._cut, edge):
                own["subs"] = "load"
            if own:
                key = note_key(edge.name, self._at(edge.source))
                found[key] = self._touched(own, self._base)
        return found

    def _needed(self, edge: Operation) -> dict[str, str]:
        """Return the state of the sub-SB, as facts, from which an edge of the base may begin."""
        if not self._chosen.contains(edge.source):
            return {}
        facts = self._cut.condition(self._cut.sources[edge.name])
        return {fact_text(*self._facts[self._base, digit]): value for digit, value in facts.items()}

    def _same_note(self, written: Mapping[str, Json], edge: Operation) -> dict[str, Json]:
        """Return the note of an edge that leaves. CutRefused if chosen states have other ones."""
        sources = self._cut.sources[edge.name]
        notes = [_note(written, note_key(edge.name, source)) for source in sources]
        levels = {
            self._levels.operation(Address(self._base, source, edge.name)) for source in sources
        }
        if len(levels) > 1 or any(note != notes[0] for note in notes):
            raise CutRefused(
                f"{edge.name} has other annotations or levels in {sources[0]} than in another "
                "chosen state, and the base has one state for them",
                edge.address,
            )
        return dict(notes[0])

    def _new_state(self, branch: str, state: str) -> str:
        return self._outer.get(state, state) if branch == self._base else state

    # the sub-SB

    def _written_sub(self, raw: dict[str, Json]) -> dict[str, Json]:
        cut = self._cut
        own: dict[str, Json] = {
            self._inner[state]: {
                op: value for op, value in raw[state].items() if op.startswith("_")
            }
            for state in self._chosen.states
        }
        own[self._inner[self._done]] = {}
        for edge in self._sub_edges():
            own[edge.source][edge.name] = edge.target
        facts = {state: self._chosen.values(state, cut.digits) for state in self._chosen.states}
        facts[self._done] = cut.done
        header: Json = {
            "INITIAL": self._inner[self._chosen.entry],
            "ACTIVATING": self._inner[self._done],
        }
        if self._branch.header.num_facts is not None:
            header["NUM_FACTS"] = len(cut.digits)
        notes = {
            "_facts": self._fact_notes(raw, cut.digits),
            "_states": self._state_notes(raw, facts, self._inner),
            "_operations": self._sub_notes(raw),
            "_layout": _layout_part(raw, {key: self._inner[key] for key in self._chosen.states}),
        }
        return {HEADER: header, **_filled(notes), **own}

    def _sub_edges(self) -> Iterator[Operation]:
        """Yield the operations of the sub-SB, with its names of states."""
        done, entry = self._inner[self._done], self._inner[self._chosen.entry]
        for edge in self._chosen.inner:
            yield replace(edge, source=self._inner[edge.source], target=self._inner[edge.target])
        for edge in self._crossing():
            yield replace(edge, source=self._inner[edge.source], target=done)
        for edge in self._cut.returns:
            yield replace(edge, source=done, target=entry)

    def _crossing(self) -> tuple[Operation, ...]:
        """Return the operations of the sub-SB that lead to ACTIVATING.

        If the base does all of them itself, return all that leave the chosen states, so that the
        drawing shows how the sub-SB ends.
        """
        leaving = (edge for edge in self._chosen.leaving if edge.target in self._cut.on)
        return self._cut.exits or tuple(leaving)

    def _sub_notes(self, raw: dict[str, Json]) -> dict[str, Json]:
        """Return the notes of its operations. Each requires the base to be where it stands for the
        chosen states."""
        written = _table(raw, "_operations")
        place = self._chosen.facts(self._chosen.entry)
        guard = {
            fact_text(*self._facts[self._base, digit]): place[digit] for digit in self._cut.guard
        }
        found: dict[str, Json] = {}
        names = {edge.name: None for edge in self._sub_edges()}
        for name in names:
            note = dict(_note(written, name))
            if guard:
                note["requires"] = {**(note.get("requires") or {}), **guard}
            if note:
                found[name] = self._touched(note, self._name)
        for edge, state in self._sub_states():
            own = _note(written, note_key(edge.name, edge.source))
            if own:
                note = dict(own)
                if guard and "requires" in note:
                    note["requires"] = {**(note["requires"] or {}), **guard}
                found[note_key(edge.name, state)] = self._touched(note, self._name)
        return found

    def _sub_states(self) -> Iterator[tuple[Operation, str]]:
        """Yield each operation of the sub-SB as it was before, with the new name of its source
        state.
        """
        for edge in (*self._chosen.inner, *self._crossing()):
            yield edge, self._inner[edge.source]
        for edge in self._cut.returns:
            yield edge, self._inner[self._done]

    def _spread(self, key: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
        """Yield the new keys in ``_levels`` for the key of an element that has moved."""
        base = self._base
        if key[0] != base or len(key) not in (2, 3):
            yield key
            return
        fact = self._facts.get((base, int(key[1]))) if key[1].isdecimal() else None
        if len(key) == 2 and fact is not None:
            yield fact[0], str(fact[1])
            return
        name = key[-1]
        for edge, state in self._sub_states():
            if edge.name == name and len(key) == 2:
                yield self._name, name
                break
            if (edge.source, edge.name) == key[1:]:
                yield self._name, state, name
        leaves = self._cut.sources
        if len(key) == 2 or not self._chosen.contains(key[1]) or key[1] in leaves.get(name, ()):
            yield (base, name) if len(key) == 2 else (base, self._at(key[1]), name)

    # both

    def _required(self, written: Mapping[str, Json], edge: Operation) -> dict[str, str]:
        """Return what an operation requires already."""
        common, own = _note(written, edge.name), _note(written, note_key(edge.name, edge.source))
        found = own.get("requires", common.get("requires"))
        return dict(found) if isinstance(found, dict) else {}

    def _touched(self, note: Mapping[str, Json], branch: str) -> dict[str, Json]:
        """Return a note whose ``touches`` are digits of the SB in which it stands now."""
        touches = note.get("touches")
        if not isinstance(touches, list):
            return dict(note)
        now = [self._facts.get((self._base, digit)) for digit in touches]
        return {**note, "touches": [one[1] for one in now if one is not None and one[0] == branch]}

    def _fact_notes(self, raw: dict[str, Json], digits: tuple[int, ...]) -> dict[str, Json]:
        written = _table(raw, "_facts")
        pairs = [(str(at), written.get(str(digit))) for at, digit in enumerate(digits)]
        return {at: note for at, note in pairs if note is not None}

    def _state_notes(
        self, raw: dict[str, Json], facts: Mapping[str, Values], names: Mapping[str, str]
    ) -> dict[str, Json]:
        """Return the notes of states under their new names, with their facts where the names do
        not show them."""
        written, found = _table(raw, "_states"), {}
        show = shape_of([names[state] for state in facts], written_count(self._branch, facts))
        given = show.opaque or any(
            show.values(names[state]) != values for state, values in facts.items()
        )
        for state, values in facts.items():
            note = {key: one for key, one in _note(written, state).items() if key != "facts"}
            if given:
                note["facts"] = list(values)
            if note:
                found[names[state]] = note
        return found

    def _refuse_named(self) -> None:
        """Raise CutRefused if a property names what is not in the base any more."""
        for one in named_places(self._before):
            if one.branch != self._base or (one.state and not self._chosen.contains(one.state)):
                continue
            what = one.state or f"operations of {self._base}"
            raise CutRefused(
                f"the property {one.claim!r} names {what}",
                None,
                "Write the property with facts, or take it out first.",
            )


def _table(raw: Mapping[str, Json], key: str) -> Mapping[str, Json]:
    found = raw.get(key)
    return found if isinstance(found, dict) else {}


def _layout_part(raw: Mapping[str, Json], names: Mapping[str, str]) -> dict[str, Json]:
    """Return the places and pins of some states under their new names."""
    layout = _table(raw, "_layout")
    pins = renamed_pins(layout, names)
    places = {names[key]: at for key, at in layout.items() if key in names}
    return {**places, PINNED: pins} if pins else places


def _note(table: Mapping[str, Json], key: str) -> Mapping[str, Json]:
    found = table.get(key)
    return found if isinstance(found, dict) else {}


def _filled(notes: Mapping[str, Json]) -> dict[str, Json]:
    """Return the notes without empty tables."""
    return {key: value for key, value in notes.items() if value != {}}
