"""The hazards and properties of a blueprint with their places, ready to be shown."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from smsl_studio.blueprint.address import split_fact
from smsl_studio.blueprint.annotations import read_hazards
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.meaning import (
    Joined,
    Meaning,
    States,
    may_name,
    meaning_of,
    values_of,
)
from smsl_studio.blueprint.properties.property import KEY, KINDS, Property, read_properties
from smsl_studio.errors import AddressError, FormulaError
from smsl_studio.inspection.proof.verdict import HAZARD
from smsl_studio.smsl.document import Document

HAZARDS = "_hazards"


@dataclass(frozen=True)
class Claim:
    """One hazard or property. ``meanings`` are F, or F and G; None says that it cannot be read.

    A hazard is a ``never`` of its facts. ``document`` and ``path`` are its place.
    """

    name: str
    kind: str
    severity: str
    document: Document
    path: tuple[str, ...]
    meanings: tuple[Meaning, ...] | None
    written: Property | None = None


def claims_of(blueprint: Blueprint) -> Iterator[Claim]:
    """Yield all hazards and properties: file by file, hazards first, as they are written."""
    names: set[tuple[str, str]] = set()
    for document in blueprint.documents:
        for one in (*_hazards(blueprint, document), *_properties(blueprint, document)):
            key = one.path[0], one.name
            if not one.name or key in names:
                continue
            names.add(key)
            yield one


def _hazards(blueprint: Blueprint, document: Document) -> Iterator[Claim]:
    raw = document.values.get(HAZARDS)
    for index, entry in enumerate(raw if isinstance(raw, list) else ()):
        path = HAZARDS, str(index)
        found, faults = read_hazards([entry])
        meaning = _facts(blueprint, found[0].facts) if found and not faults else None
        meanings = None if meaning is None else (meaning,)
        yield Claim(_name_of(entry), HAZARD, "E", document, path, meanings)


def _facts(blueprint: Blueprint, facts: dict[str, str]) -> Meaning | None:
    """Return the meaning of facts that hold together, None if one of them cannot be."""
    parts = []
    for text, value in facts.items():
        fact = split_fact(text)
        branch = blueprint.branches.get(fact[0]) if fact else None
        if fact is None or branch is None or fact[1] >= len(branch.alphabet):
            return None
        states = branch.states_with(fact[1], value)
        if not states and value not in values_of(branch, fact[1]):
            return None
        parts.append(States(branch.name, states))
    return Joined(True, tuple(parts))


def _properties(blueprint: Blueprint, document: Document) -> Iterator[Claim]:
    raw = document.values.get(KEY)
    found, _ = read_properties(raw)
    for index, entry in enumerate(raw if isinstance(raw, list) else ()):
        path, one = (KEY, str(index)), found.get(index)
        if one is None:
            keys = entry if isinstance(entry, dict) else {}
            kind = next((key for key in keys if key in KINDS), "")
            yield Claim(_name_of(entry), kind, "E", document, path, None)
            continue
        try:
            meanings = tuple(meaning_of(formula, blueprint) for formula in one.formulas)
            named = not one.operation or may_name(blueprint, one.operation)
            if one.goal:
                goal = blueprint.resolve(one.goal)
                named = bool(goal.state) and not goal.operation
        except (FormulaError, AddressError):
            named = False
        if named:
            yield Claim(one.name, one.kind, one.severity, document, path, meanings, one)
        else:
            yield Claim(one.name, one.kind, one.severity, document, path, None)


def _name_of(entry: Any) -> str:
    name = entry.get("name") if isinstance(entry, dict) else None
    return name if isinstance(name, str) else ""
