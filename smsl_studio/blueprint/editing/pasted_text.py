"""Pasting: the elements in a text become part of a blueprint, with free names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from typing import Any

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.edge_layout import IN_LAYOUT, edge_layouts_of, point_of
from smsl_studio.blueprint.editing.additions import recount
from smsl_studio.blueprint.editing.bends import put_edge
from smsl_studio.blueprint.editing.draft import Draft, branch_of
from smsl_studio.blueprint.editing.drawn import put_pasted
from smsl_studio.blueprint.editing.excerpts import MARK, OPERATIONS, STATES, parts_of
from smsl_studio.blueprint.editing.given_facts import give_facts
from smsl_studio.blueprint.editing.pasted_places import ASIDE, PastedPlaces, Point
from smsl_studio.blueprint.editing.pins import put_pins
from smsl_studio.blueprint.editing.renames import renamed_requires, renamed_subs
from smsl_studio.blueprint.facts import fact_string
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.names import FreeNames, fresh_state_names
from smsl_studio.blueprint.pins import renamed_pins
from smsl_studio.blueprint.reading import HEADER, branches_of
from smsl_studio.errors import EditRefused, ReadError, did_you_mean
from smsl_studio.smsl.forms import form_named, form_of

Json = Any
Values = Mapping[str, Json]
FILE = "the pasted text"


def paste(
    blueprint: Blueprint, branch: str, text: str, at: Point | None = None
) -> tuple[Blueprint, tuple[Address, ...]]:
    """Put a copied text (see ``excerpt``), or any SMSL text, into the blueprint. Return the new
    addresses too.

    States and operations go into ``branch``, also a text that is only states, and whole SBs after
    the others. An element whose name is taken gets a free one, and references to it follow. ``at``
    is the new middle of the states. EditRefused if the text is no SMSL.
    """
    return _put(blueprint, [(branch, *item) for item in _values(text).items()], PastedPlaces(at=at))


def duplicate(
    blueprint: Blueprint, addresses: Iterable[Address], offset: Point = ASIDE
) -> tuple[Blueprint, tuple[Address, ...]]:
    """Add a copy of each chosen element, moved by ``offset``. Return the new addresses too."""
    parts = [(name, name, value) for name, value in parts_of(blueprint, addresses).items()]
    return _put(blueprint, parts, PastedPlaces(offset))


def _values(text: str) -> Values:
    """Return the SBs in a text. EditRefused if it is no SMSL."""
    try:
        return _read(text)
    except ReadError as error:
        with suppress(ReadError):
            if text.strip():
                return _read(_as_states(text))
        where = f" (line {error.place.line})" if error.place else ""
        raise EditRefused(
            f"{FILE} is no SMSL: {error.sentence}{where}",
            advice="Copy states, operations or State Branches, or the text of an SMSL file.",
        ) from None


def _read(text: str) -> Values:
    document = form_named(form_of("", text)).parse(text, FILE)
    branches_of(document)
    return {name: value for name, value in document.values.items() if not name.startswith("_")}


def _as_states(text: str) -> str:
    """Return the text of some states, without an SB around them, as an excerpt."""
    inner = text.strip()
    if inner[:1] == '"':
        return f'{{"SB": {{"{MARK}": "{STATES}", {inner.rstrip(",")}}}}}'
    return f'{{\n# NAME: SB\n# {MARK}: "{STATES}"\n{inner}\n}}'


def _put(
    blueprint: Blueprint, parts: Iterable[tuple[str, str, Values]], places: PastedPlaces
) -> tuple[Blueprint, tuple[Address, ...]]:
    """Put in every part. A part is the SB that it goes into, the SB that it comes from, and its
    values.
    """
    draft = Draft(blueprint)
    made: list[Address] = []
    whole: dict[str, Values] = {}
    into: dict[str, _Into] = {}
    for target, name, value in parts:
        kind = value.get(MARK)
        if kind not in (STATES, OPERATIONS):
            whole[name] = value
            continue
        if target not in into:
            if not target:
                raise EditRefused(
                    "there is no State Branch to paste into", advice="Add a State Branch first."
                )
            into[target] = _Into(draft, target)
        put = into[target].states if kind == STATES else into[target].operations
        made.extend(put(value, places))
    for target, one in into.items():
        recount(draft, target, one.added)
    made.extend(_put_branches(draft, whole))
    if not made:
        raise EditRefused(
            "the pasted text holds nothing that could be put in",
            advice="Copy states, operations or State Branches.",
        )
    # States whose fact values are taken here got none, and take free ones.
    return give_facts(draft.before, draft.done()), tuple(made)


def _put_branches(draft: Draft, whole: Mapping[str, Values]) -> Iterator[Address]:
    """Add SBs after the others. SUB_SBS and ``requires`` follow their new names."""
    inner = draft.file()
    free = FreeNames({*draft.before.branches, *inner})
    names = {name: free.take(name) for name in whole}
    for name, value in whole.items():
        fresh = dict(value)
        header = fresh.get(HEADER)
        if isinstance(header, dict) and "SUB_SBS" in header:
            fresh[HEADER] = {**header, "SUB_SBS": renamed_subs(header["SUB_SBS"], names)}
        if "_operations" in fresh:
            fresh["_operations"] = renamed_requires(fresh["_operations"], names)
        inner[names[name]] = fresh
        yield Address(names[name])


class _Into:
    """One SB that states and operations are put into."""

    def __init__(self, draft: Draft, branch: str) -> None:
        self._draft, self._branch = draft, branch
        self._found = branch_of(draft.before, branch)
        self._names = _StateNames(self._found)
        self._known = {name for ops in self._found.table.values() for name in ops}
        self._values = [list(one.facts) for one in self._found.notes.states.values()]
        self.added = 0

    def states(self, value: Values, places: PastedPlaces) -> Iterator[Address]:
        """Put in states with their annotations."""
        draft, branch = self._draft, self._branch
        states = [key for key in value if not key.startswith("_") and key != HEADER]
        names = {state: self._names.take(state) for state in states}
        inner = draft.at(branch)
        edges = []
        for state in states:
            written = value[state].items()
            inner[names[state]] = {
                key: names.get(item, item) if key[:1] != "_" else item for key, item in written
            }
            edges += [(state, key, names[state], key) for key, _ in written if key[:1] != "_"]
            yield Address(branch, names[state])
        self.added += len(states)
        self._edge_notes(value, edges)
        notes = _map(value, "_states")
        for state in states:
            if state in notes:
                draft.table(branch, "_states")[names[state]] = self._own_values(notes[state])
        self._fact_notes(_map(value, "_facts"))
        taken, layout = self._found.notes.layout.values(), _map(value, "_layout")
        placed = dict(places.of(states, layout, taken))
        for state, place in placed.items():
            draft.table(branch, "_layout")[names[state]] = place
        for (state, operation), line in edge_layouts_of(layout.get(IN_LAYOUT, {}), []).items():
            former = point_of(layout.get(state))
            if former is not None and state in placed and operation in value[state]:
                x, y = placed[state]
                moved = line.moved(x - former[0], y - former[1])
                put_edge(draft, branch, (names[state], operation), moved)
        put_pins(draft, branch, renamed_pins(layout, {state: names[state] for state in placed}))
        put_pasted(draft, branch, value, names)

    def _own_values(self, note: Json) -> Json:
        """Return the note of a state, without its fact values if another state here has them."""
        facts = note.get("facts") if isinstance(note, dict) else None
        if not isinstance(facts, list) or self._found.shape.width or self._found.shape.opaque:
            return note
        if facts in self._values:
            return {key: item for key, item in note.items() if key != "facts"}
        self._values.append(facts)
        return note

    def _fact_notes(self, notes: Values) -> None:
        """Take the names and meanings of facts along, if the SB has none for its facts."""
        found = self._found
        fit = all(key.isdecimal() and int(key) < found.num_facts for key in notes)
        fit = fit or not found.table
        if notes and fit and not found.notes.facts and "_facts" not in self._draft.at(self._branch):
            self._draft.table(self._branch, "_facts").update(notes)

    def operations(self, value: Values, _: PastedPlaces) -> Iterator[Address]:
        """Put operations into the states with the same names as those from which they were
        copied.
        """
        states = [key for key in value if not key.startswith("_") and key != HEADER]
        edges = []
        for state in states:
            operations = {key: to for key, to in value[state].items() if not key.startswith("_")}
            for end in (state, *operations.values()):
                if end not in self._found.table:
                    raise EditRefused(
                        f"there is no state {end!r} in {self._branch} for a pasted operation",
                        advice=did_you_mean(end, self._found.table)
                        or "Copy the states along with it.",
                    )
            inner = self._draft.at(self._branch, state)
            free = FreeNames(inner)
            for operation, target in operations.items():
                name = free.take(operation)
                inner[name] = target
                edges.append((state, operation, state, name))
                yield Address(self._branch, state, name)
        self._edge_notes(value, edges)

    def _edge_notes(self, value: Values, edges: Iterable[tuple[str, str, str, str]]) -> None:
        """Copy the notes of operations. Edges are (state, operation) before, then after pasting.

        A note for all operations of a name must not apply to operations that were here before.
        """
        notes, branch = _map(value, "_operations"), self._branch
        here = _map(self._found.fields, "_operations")
        for state, operation, new_state, new_operation in edges if notes else ():
            common = notes.get(note_key(operation))
            own = notes.get(note_key(operation, state))
            if common is not None and operation == new_operation:
                if operation not in self._known:
                    self._draft.table(branch, "_operations")[note_key(operation)] = common
                    common = None
                elif here.get(note_key(operation)) == common:
                    common = None
            if isinstance(common, dict) and isinstance(own, dict | None):
                own = {**common, **(own or {})}
            if own is not None:
                self._draft.table(branch, "_operations")[note_key(new_operation, new_state)] = own


class _StateNames:
    """Names for new states of an SB.

    A state keeps its own name if it is free, has as many facts as the others, and no other state
    has the same facts. Otherwise it gets the next name of the form that the SB uses.
    """

    def __init__(self, branch: StateBranch) -> None:
        shape = branch.shape
        self._free = FreeNames({*branch.table, *branch.fields, HEADER})
        self._written = shape.written
        self._length = 0 if shape.opaque or not branch.table else shape.num_facts * shape.width
        self._facts = {self._facts_of(name) for name in branch.table}
        self._fresh = fresh_state_names(branch)

    def take(self, name: str) -> str:
        """Return a free name for a state that was called ``name``, and take it."""
        if self._length:
            name = self._with_own_facts(name)
        free = self._free.take(name)
        self._facts.add(self._facts_of(free))
        return free

    def _with_own_facts(self, name: str) -> str:
        if self._is_free(name) and len(self._facts_of(name)) == self._length:
            return name
        return next(fresh for fresh in self._fresh if self._is_free(fresh))

    def _is_free(self, name: str) -> bool:
        return name not in self._free.taken and self._facts_of(name) not in self._facts

    def _facts_of(self, name: str) -> str:
        return fact_string(name, self._written)


def _map(values: Values, key: str) -> Mapping[str, Json]:
    found = values.get(key)
    return found if isinstance(found, dict) else {}
