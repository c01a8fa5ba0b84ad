"""The entry of a sensed fact with one thing changed: a source, its unit, its range, a predicate.

Each function returns the keys of the entry that change, with their new values; None takes a key
away. Nothing is written here.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from smsl_studio.blueprint.annotations import FactNote
from smsl_studio.blueprint.predicates.predicate import check_units, names_of, thresholds_of
from smsl_studio.blueprint.predicates.predicate_text import read_predicate, written_source
from smsl_studio.blueprint.predicates.units import read_unit
from smsl_studio.errors import FormulaError

Json = Any
Changed = Mapping[str, Json]
_NAME = re.compile(r"'(?:[^']|'')*'|[^\W\d][\w.]*")


def with_unit(note: FactNote, name: str, unit: str) -> Changed:
    """Give a source another unit. A source that is not there is added."""
    return {"sources": {**note.sources, name: unit}}


def with_range(note: FactNote, name: str, pair: tuple[float, float] | None) -> Changed:
    """Give a source a range, or with None take its range away."""
    ranges = {one: list(both) for one, both in note.range.items() if one != name}
    if pair is not None:
        ranges = {one: list(both) for one, both in note.range.items()}
        ranges[name] = [_number(pair[0]), _number(pair[1])]
    return {"range": ranges or None}


def with_predicate(note: FactNote, value: str, text: str) -> Changed:
    """Write the condition for a value; an empty text takes it away."""
    said = dict(note.predicate) if isinstance(note.predicate, dict) else {}
    if text:
        said[value] = text
    else:
        said.pop(value, None)
    return {"predicate": said or None}


def without_source(note: FactNote, name: str) -> Changed:
    """Take a source away, with its range. Predicates that name it stay, and are told as wrong."""
    sources = {one: unit for one, unit in note.sources.items() if one != name}
    return {"sources": sources or None, **with_range(note, name, None)}


def without_predicates() -> Changed:
    """Take away all that decides a fact from measures."""
    return {"sources": None, "predicate": None, "range": None, "log_rate": None}


def renamed_source(note: FactNote, old: str, new: str) -> Changed:
    """Give a source another name. Its range and the predicates that can be read follow."""
    sources = {new if one == old else one: unit for one, unit in note.sources.items()}
    changed: dict[str, Json] = {"sources": sources}
    if note.range:
        pairs = note.range.items()
        changed["range"] = {new if one == old else one: list(pair) for one, pair in pairs}
    if isinstance(note.predicate, dict):
        said = note.predicate.items()
        changed["predicate"] = {value: _renamed(text, old, new) for value, text in said}
    return changed


def predicate_fault(text: str, sources: Mapping[str, str]) -> FormulaError | None:
    """Return why a text is no predicate on these sources; None if it is one."""
    unread = unit_faults(sources).keys()
    try:
        clause = read_predicate(text)
        used = {one.name for th in thresholds_of(clause) for one in names_of(th.part)}
        if used.isdisjoint(unread):  # The unit is told at its source.
            check_units(clause, {
                name: read_unit(unit) for name, unit in sources.items() if name not in unread
            })  # fmt: skip
    except FormulaError as error:
        return error
    return None


def unit_faults(sources: Mapping[str, str]) -> dict[str, FormulaError]:
    """Return why the units of sources cannot be read, by the names of these sources."""
    found: dict[str, FormulaError] = {}
    for name, unit in sources.items():
        try:
            read_unit(unit)
        except FormulaError as error:
            found[name] = error
    return found


def _renamed(text: str, old: str, new: str) -> str:
    try:
        clause = read_predicate(text)
    except FormulaError:
        return text
    places = {
        one.at for th in thresholds_of(clause) for one in names_of(th.part) if one.name == old
    }
    for at in sorted(places, reverse=True):
        match = _NAME.match(text, at)
        if match is not None:
            text = text[:at] + written_source(new) + text[match.end() :]
    return text


def _number(value: float) -> float | int:
    return int(value) if value.is_integer() and abs(value) < 1e15 else value
