"""A hazard or a property while it is written: texts, their faults, and what is written in the
file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import count
from typing import Any, NamedTuple

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import fact_text, split_fact
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.formula import AllOf, FactTerm, Formula
from smsl_studio.blueprint.properties.formula_text import read_formula, written_name, written_plain
from smsl_studio.blueprint.properties.meaning import fact_of, meaning_of
from smsl_studio.blueprint.properties.property import read_properties
from smsl_studio.blueprint.properties.words import hazard_words, property_words
from smsl_studio.errors import EditRefused, FormulaError, StudioError
from smsl_studio.inspection.proof.verdict import HAZARD

Json = Any
HAZARDS, PROPERTIES = "_hazards", "_properties"


class KindFields(NamedTuple):
    """The labels of the fields of a kind; an empty one is not shown. ``formulas`` says whether
    ``first`` and ``second`` are conditions."""

    first: str
    second: str = ""
    number: str = ""
    formulas: bool = True


FIELDS: Mapping[str, KindFields] = {
    HAZARD: KindFields("Never together"),
    "never": KindFields("Never"),
    "before": KindFields("First", "Only then"),
    "after": KindFields("After", "Passes"),
    "way_back": KindFields("From", "Way to", "Steps"),
    "reachable": KindFields("Possible"),
    "at_most": KindFields("Operation", "", "Times", formulas=False),
    "cost": KindFields("Goal", "", "Limit", formulas=False),
}
"""The fields of each kind."""


class EntryFault(NamedTuple):
    """Why an entry cannot be written: the field, a sentence, and the offset in the text (-1 for the
    whole field)."""

    field: str
    sentence: str
    at: int = -1


@dataclass(frozen=True)
class ClaimEntry:
    """What stands in the fields of the form."""

    kind: str = HAZARD
    name: str = ""
    severity: str = "E"
    why: str = ""
    first: str = ""
    second: str = ""
    number: str = ""

    @property
    def key(self) -> str:
        """The list of the file to which it belongs."""
        return HAZARDS if self.kind == HAZARD else PROPERTIES

    def fault(self, blueprint: Blueprint) -> EntryFault | None:
        """Return the first fault; None if it can be written."""
        return next(self._faults(blueprint), None)

    def sentence(self, blueprint: Blueprint) -> str:
        """Return it in plain words; empty if it cannot be read."""
        try:
            written = self.written(blueprint, "a")
        except (StudioError, ValueError):
            return ""
        if self.kind == HAZARD:
            return hazard_words(written["facts"], blueprint)
        found, _ = read_properties([written])
        return property_words(found[0], blueprint) if found else ""

    def written(self, blueprint: Blueprint, name: str = "") -> dict[str, Json]:
        """Return the entry of the file. FormulaError or ValueError if it cannot be read."""
        named: dict[str, Json] = {"name": name or self.name.strip()}
        if self.kind == HAZARD:
            return {**named, "facts": _facts(read_formula(self.first), blueprint)}
        if self.severity != "E":
            named["severity"] = self.severity
        if self.why.strip():
            named["why"] = self.why.strip()
        return {**named, self.kind: self._value()}

    def _value(self) -> Json:
        if self.kind in ("never", "reachable"):
            return self.first
        if self.kind in ("before", "after"):
            return [self.first, self.second]
        if self.kind == "at_most":
            return {"operation": self.first.strip(), "times": int(self.number)}
        if self.kind == "cost":
            limit = float(self.number.replace(",", "."))
            return {"goal": self.first.strip(), "limit": int(limit) if limit % 1 == 0 else limit}
        within = {"within": int(self.number)} if self.number.strip() else {}
        return {"from": self.first, "to": self.second, **within}

    def _faults(self, blueprint: Blueprint) -> Iterator[EntryFault]:
        fields = FIELDS[self.kind]
        for field, label in (("first", fields.first), ("second", fields.second)):
            text = getattr(self, field)
            if not label:
                continue
            if not text.strip():
                yield EntryFault(field, f"“{label}” is empty.")
            elif fields.formulas:
                yield from self._formula_faults(field, text, blueprint)
            elif self.kind == "cost":
                try:
                    blueprint.resolve(text.strip())
                except StudioError as error:
                    yield EntryFault(field, _said(error))
        if fields.number and (self.number.strip() or self.kind != "way_back"):
            try:
                number = (int if self.kind != "cost" else float)(self.number.replace(",", "."))
                if not 0 <= number < 1e12:
                    raise ValueError
            except ValueError:
                kind = "number" if self.kind == "cost" else "whole number"
                yield EntryFault("number", f"“{fields.number}” must be a {kind} from 0 up.")
        if not self.name.strip():
            yield EntryFault("name", "It has no name yet.")

    def _formula_faults(self, field: str, text: str, blueprint: Blueprint) -> Iterator[EntryFault]:
        try:
            formula = read_formula(text)
            meaning_of(formula, blueprint)
            if self.kind == HAZARD:
                _facts(formula, blueprint)
        except FormulaError as error:
            yield EntryFault(field, _said(error), error.at)


def entry_of(kind: str, written: Json, blueprint: Blueprint) -> ClaimEntry:
    """Return the fields for an entry of the file. What does not fit is left empty."""
    entry = written if isinstance(written, dict) else {}
    kind = kind if kind in FIELDS else "never"
    name, why = _text(entry.get("name")), _text(entry.get("why"))
    severity = entry.get("severity", "E")
    begun = ClaimEntry(kind, name, severity if severity in ("E", "W") else "E", why)
    value = entry.get("facts" if kind == HAZARD else kind)
    first, second, number = _texts(kind, value, blueprint)
    return ClaimEntry(begun.kind, begun.name, begun.severity, begun.why, first, second, number)


class ClaimPlace(NamedTuple):
    """Where an entry is written: the list, its number there, and the file."""

    key: str
    at: int
    file: str


def written_at(blueprint: Blueprint, place: ClaimPlace) -> Json:
    """Return what is written at a place; None if nothing is."""
    found = _list(blueprint, place.key, place.file)
    return found[place.at] if 0 <= place.at < len(found) else None


def put_entry(
    blueprint: Blueprint, entry: ClaimEntry, place: ClaimPlace | None, file: str
) -> Blueprint:
    """Return the blueprint with an entry: in the place of another one, or at the end of its list in
    ``file``. EditRefused if it does not fit."""
    written = entry.written(blueprint)
    file = place.file if place is not None else file
    old = written_at(blueprint, place) if place is not None else None
    if isinstance(old, dict):
        written |= {key: value for key, value in old.items() if key.startswith("_")}
    lists = {key: _list(blueprint, key, file) for key in (HAZARDS, PROPERTIES)}
    if place is not None and place.key == entry.key:
        lists[place.key][place.at] = written
    else:
        lists[entry.key].append(written)
        if place is not None:
            del lists[place.key][place.at]
    _must_be_free(lists[entry.key], entry.name.strip())
    return _with_lists(blueprint, lists, file)


def without_entry(blueprint: Blueprint, place: ClaimPlace) -> Blueprint:
    """Return the blueprint without an entry."""
    found = _list(blueprint, place.key, place.file)
    del found[place.at]
    return _with_lists(blueprint, {place.key: found}, place.file)


def free_claim_name(blueprint: Blueprint, key: str, name: str, file: str) -> str:
    """Return a name that no other entry of the list has: the name with a number."""
    taken = {_text(one.get("name")) for one in _list(blueprint, key, file) if isinstance(one, dict)}
    return next(free for at in count(2) if (free := f"{name} {at}") not in taken)


def _list(blueprint: Blueprint, key: str, file: str) -> list[Json]:
    document = next(one for one in blueprint.documents if one.file == file)
    found = document.values.get(key, [])
    return list(found) if isinstance(found, list) else []


def _with_lists(blueprint: Blueprint, lists: Mapping[str, list[Json]], file: str) -> Blueprint:
    for key, found in lists.items():
        if found != _list(blueprint, key, file):
            put = editing.set_hazards if key == HAZARDS else editing.set_properties
            blueprint = put(blueprint, found, file)
    return blueprint


def _must_be_free(entries: list[Json], name: str) -> None:
    names = [_text(one.get("name")) for one in entries if isinstance(one, dict)]
    if names.count(name) > 1:
        raise EditRefused(f"there is one of the name “{name}” already", advice="Choose another.")


def _texts(kind: str, value: Json, blueprint: Blueprint) -> tuple[str, str, str]:
    if kind == HAZARD and isinstance(value, dict):
        return " and ".join(_written_facts(value, blueprint)), "", ""
    if isinstance(value, str):
        return value, "", ""
    if isinstance(value, list):
        both = [*map(_text, value), "", ""]
        return both[0], both[1], ""
    if not isinstance(value, dict):
        return "", "", ""
    first = next((_text(value[key]) for key in ("from", "operation", "goal") if key in value), "")
    number = next((value[key] for key in ("within", "times", "limit") if key in value), "")
    return first, _text(value.get("to")), str(number)


def _written_facts(facts: Mapping[str, Json], blueprint: Blueprint) -> Iterator[str]:
    for text, value in facts.items():
        fact = split_fact(text)
        name, digit = fact if fact else (text, 0)
        branch = blueprint.branches.get(name)
        note = branch.fact_note(digit) if branch is not None else None
        said = written_plain(note.name) if note and note.name else str(digit)
        yield f"{written_name(name)}/{said} = {written_name(str(value))}"


def _facts(formula: Formula, blueprint: Blueprint) -> dict[str, str]:
    """Return the facts of a hazard. FormulaError if the condition says more than facts that hold
    together."""
    parts = formula.parts if isinstance(formula, AllOf) else (formula,)
    found: dict[str, str] = {}
    for part in parts:
        fact = fact_of(part, blueprint) if isinstance(part, FactTerm) and part.equal else None
        if fact is None or not isinstance(part, FactTerm):
            at = part.at if isinstance(part, FactTerm) else 0
            words = "a hazard joins facts, FACT = VALUE, with 'and'"
            raise FormulaError(words, at, "Choose the kind never for any other condition.")
        text = fact_text(*fact)
        if text in found:
            words = f"{text} stands twice in a hazard"
            raise FormulaError(words, part.at, "Choose the kind never for such a condition.")
        found[text] = part.value
    return found


def _text(value: Json) -> str:
    return value if isinstance(value, str) else ""


def _said(error: StudioError) -> str:
    words = f"{error.sentence[:1].upper()}{error.sentence[1:]}"
    return " ".join(filter(None, (words if words.endswith(".") else f"{words}.", error.advice)))
