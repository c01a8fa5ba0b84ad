"""The meaning of a blueprint and its annotations as plain values, which are equal for equal
meanings.

Defaults are left out: a cost of 1 and no cost are the same. An entry that does not fit its table is
kept literally, and so are the arguments of a binding.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import MISSING, asdict, fields, replace
from typing import TYPE_CHECKING, Any, Protocol

from smsl_studio.blueprint.continuum import DEFAULTS

if TYPE_CHECKING:
    from smsl_studio.blueprint.annotations import FactNote, OperationNote, StateNote
    from smsl_studio.blueprint.elements import Header
    from smsl_studio.blueprint.facts import FactShape
    from smsl_studio.blueprint.notes import Notes
    from smsl_studio.smsl.document import Document

Json = Any
OF_PROPERTY: Mapping[str, Json] = {"severity": "E", "why": ""}
"""The default values of keys that an entry of ``_properties`` may leave out."""
MEANING_FIELDS = ("_facts", "_states", "_operations")
AS_WRITTEN = "as written"
"""The key of the entries that do not fit their table, by their path."""

_COST = 1.0
"""The cost of an operation without a declared cost."""

_EXACT = 2**53


class MeantBranch(Protocol):
    """The parts of a State Branch (``model.StateBranch``) that have a meaning."""

    @property
    def name(self) -> str:
        """The name of the SB."""

    @property
    def header(self) -> Header:
        """The header as written."""

    @property
    def table(self) -> Mapping[str, Mapping[str, str]]:
        """For each state its operations, and the target of each, in written order."""

    @property
    def fields(self) -> Mapping[str, Json]:
        """The ``_`` fields of the SB as they were read."""

    @property
    def initial(self) -> str:
        """The state in which the SB starts, empty if there are no states."""

    @property
    def activating(self) -> str:
        """The state that turns the digit of a base on, empty if there are no states."""

    @property
    def shape(self) -> FactShape:
        """How the names of the states show their facts."""

    @property
    def notes(self) -> Notes:
        """The typed annotations."""

    @property
    def meaning(self) -> Json:
        """The SB as plain values (see ``branch_meaning``)."""

    def default_on_value(self, digit: int) -> str:
        """Return the value of a digit that counts as on if ``_facts`` does not say it."""


class MeantBlueprint(Protocol):
    """The parts of a blueprint (``model.Blueprint``) that have a meaning."""

    @property
    def fields(self) -> Mapping[str, Json]:
        """The ``_`` fields of the file as they were read."""

    @property
    def documents(self) -> tuple[Document, ...]:
        """The documents of the blueprint, its own first."""

    def __iter__(self) -> Iterator[MeantBranch]: ...


def blueprint_meaning(blueprint: MeantBlueprint) -> dict[str, Json]:
    """Return the meaning of a blueprint (see ``Blueprint.meaning``)."""
    return {
        "branches": [[branch.name, branch.meaning] for branch in blueprint],
        "hazards": hazards_meaning(_hazards_written(blueprint)),
        "properties": properties_meaning(*blueprint.documents),
        "levels": levels_meaning(levels_written(*blueprint.documents)),
        "imports": blueprint.fields.get("_imports") or None,
    }


def branch_meaning(branch: MeantBranch) -> dict[str, Json]:
    """Return the meaning of an SB (see ``StateBranch.meaning``).

    NUM_STATES is left out, because it only checks the number of states. The way in which names are
    split into facts is part of the meaning, whether NUM_FACTS declares it or it was inferred.
    """
    shape = branch.shape
    return {
        "initial": branch.initial,
        "activating": branch.activating,
        "facts": [shape.num_facts, shape.width, shape.opaque],
        "sub_sbs": subs_meaning(branch.header.sub_sbs),
        "states": {name: dict(operations) for name, operations in branch.table.items()},
        "notes": notes_meaning(branch),
    }


def _hazards_written(blueprint: MeantBlueprint) -> Json:
    """Return the hazards of all files, one file after the other."""
    written = [one.values.get("_hazards") for one in blueprint.documents]
    if not any(written[1:]):
        return written[0]
    listed = (item if isinstance(item, list) else [item] for item in written if item)
    return [hazard for items in listed for hazard in items]


def notes_meaning(branch: MeantBranch) -> dict[str, Json]:
    """Return the annotations of an SB's facts, states and operations. Empty if they only have
    defaults.
    """
    if not any(branch.fields.get(key) for key in MEANING_FIELDS):
        return {}
    notes = branch.notes
    said: dict[str, Json] = {
        "_facts": {str(d): _fact(branch, d, note) for d, note in notes.facts.items()},
        "_states": {name: _said(note) for name, note in notes.states.items()},
        "_operations": {key: _operation(notes, key) for key in notes.operations},
    }
    said = {table: {key: one for key, one in said[table].items() if one} for table in said}
    for path in dict.fromkeys(path for path, _ in notes.faults):
        if path[0] in MEANING_FIELDS:
            misfit = branch.fields[path[0]] if len(path) == 1 else branch.fields[path[0]][path[1]]
            said.setdefault(AS_WRITTEN, {})["/".join(path)] = word_for_word(misfit)
    return {table: entries for table, entries in said.items() if entries}


def hazards_meaning(raw: Json) -> list[Json]:
    """Return the hazards in ``_hazards``, sorted, because their written order has no meaning."""
    if not isinstance(raw, list):
        return [word_for_word(raw)] if raw else []
    from smsl_studio.blueprint.annotations import read_hazards

    said = []
    for item in raw:
        notes, faults = read_hazards([item])
        said.append(asdict(notes[0]) if notes and not faults else word_for_word(item))
    return sorted(said, key=word_for_word)


def properties_meaning(*documents: Document) -> list[Json] | None:
    """Return the properties of some files, sorted, because their written order has no meaning.
    None if there are none.
    """
    said: list[Json] = []
    for document in documents:
        raw = document.values.get("_properties")
        for item in raw if isinstance(raw, list) else [raw] if raw else []:
            kept = isinstance(item, dict)
            said.append({**OF_PROPERTY, **item} if kept else word_for_word(item))
    return sorted(said, key=word_for_word) or None


def levels_written(*documents: Document) -> dict[str, Json]:
    """Return the entries of ``_levels`` in some files. Of equal keys the first one counts. A
    ``_levels`` that is no map is returned under this key.
    """
    found: dict[str, Json] = {}
    for document in documents:
        raw = document.values.get("_levels")
        for key, level in (raw if isinstance(raw, dict) else {"_levels": raw}).items():
            if level is not None:
                found.setdefault(key, level)
    return found


def levels_meaning(written: Mapping[str, Json]) -> Json:
    """Return the levels that are not defaults, None if there are none."""
    said = {key: level for key, level in written.items() if DEFAULTS.get(key) != level}
    return {k: v if isinstance(v, str) else word_for_word(v) for k, v in said.items()} or None


def subs_meaning(pairs: Sequence[tuple[str, int]]) -> list[Json]:
    """Return the sub-SBs with their digits. A digit that a double cannot hold exactly becomes a
    text.
    """
    return [[sub, d if abs(d) < _EXACT else str(d)] for sub, d in sorted(pairs)]


def word_for_word(value: Json) -> str:
    """Return a value as one text. The order of keys does not matter."""
    return json.dumps(value, ensure_ascii=False, sort_keys=True, default=dict)


def _fact(branch: MeantBranch, digit: int, note: FactNote) -> dict[str, Json]:
    said = _said(note)
    if note.on is not None and note.on == branch.default_on_value(digit):
        del said["on"]
    return said


def note_meaning(note: FactNote | StateNote | OperationNote) -> dict[str, Json]:
    """Return the fields of one note that differ from their defaults, a cost of 1 among them."""
    said = _said(note)
    if said.get("cost") == _COST:
        del said["cost"]
    return said


def _operation(notes: Notes, key: str) -> dict[str, Json]:
    """Return the note of an operation name. For a single edge, return what its note changes in that
    of the name.
    """
    own = _with_cost(notes.operations[key])
    state, _, name = key.rpartition("/")
    common = notes.operations.get(name) if state else None
    if common is None:
        return note_meaning(own)
    shared = _with_cost(common)
    words = sorted(notes.written[key])
    return {
        word: _plain(getattr(own, word))
        for word in words
        if getattr(own, word) != getattr(shared, word)
    }


def _with_cost(note: OperationNote) -> OperationNote:
    return replace(note, cost=_COST) if note.cost is None else note


def _said(note: Any) -> dict[str, Json]:
    """Return the fields of a note that differ from their defaults."""
    said = {}
    for one in fields(note):
        value = getattr(note, one.name)
        factory = one.default_factory
        default = one.default if factory is MISSING else factory()
        if value != default:
            said[one.name] = _plain(value)
    return said


def _plain(value: Any) -> Json:
    if isinstance(value, tuple):
        return list(value)
    if isinstance(value, dict):
        return {key: _plain(one) for key, one in value.items()}
    if hasattr(value, "goal"):
        return asdict(value)
    if hasattr(value, "arguments"):
        arguments = {key: word_for_word(one) for key, one in value.arguments.items()}
        return {"function": value.function, "arguments": arguments}
    return value
