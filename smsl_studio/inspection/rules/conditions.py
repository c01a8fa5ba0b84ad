"""Hazards and properties that cannot be read (part of R29).

They are errors: what nobody can read would be shown neither to hold nor to fail.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from smsl_studio.blueprint.address import Address, split_fact
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties import meaning_of
from smsl_studio.blueprint.properties.meaning import may_name, values_of
from smsl_studio.blueprint.properties.property import KEY, Property, read_properties, texts_of
from smsl_studio.errors import AddressError, FormulaError, did_you_mean
from smsl_studio.inspection.rules.finding import Remark, Severity
from smsl_studio.smsl.document import Document
from smsl_studio.stop import heed

HAZARDS = "_hazards"


def odd_hazards(blueprint: Blueprint) -> Iterator[Remark]:
    """Report hazards that do not fit their kind, or that name something that does not exist."""
    names: set[str] = set()
    for document in blueprint.documents:
        if HAZARDS not in document.values:
            continue
        from smsl_studio.blueprint.annotations import read_hazards

        raw = document.values[HAZARDS]
        for index, entry in enumerate(raw if isinstance(raw, list) else [raw]):
            heed()
            path = (HAZARDS, str(index)) if isinstance(raw, list) else (HAZARDS,)
            found, faults = read_hazards([entry] if isinstance(raw, list) else raw)
            for _, reason in faults:
                words = f"a hazard is not understood: {reason}"
                yield _remark(document, path, _name_of(entry), words, "")
            for hazard in found:
                if hazard.name in names:
                    words = f"the name {hazard.name} is used twice"
                    yield _remark(document, path, hazard.name, words, "give it another name")
                names.add(hazard.name)
                for below, words, advice in _odd_facts(blueprint, hazard.facts):
                    yield _remark(document, (*path, "facts", below), hazard.name, words, advice)


def _odd_facts(blueprint: Blueprint, facts: Mapping[str, str]) -> Iterator[tuple[str, str, str]]:
    """Yield the key, the sentence and the advice of each fact of a hazard that cannot be."""
    for text, value in facts.items():
        fact = split_fact(text)
        branch = blueprint.branches.get(fact[0]) if fact else None
        if fact is None or branch is None or fact[1] >= len(branch.alphabet):
            yield text, f"it names {text}, which is no fact", "a fact is SB/DIGIT, from 0"
        elif branch.states_with(fact[1], value):
            continue
        elif value not in (known := values_of(branch, fact[1])):
            words = f"{text} never has the value {value}"
            yield text, words, f"its values are {', '.join(known[:_SHOWN])}" if known else ""


def odd_properties(blueprint: Blueprint) -> Iterator[Remark]:
    """Report properties that cannot be read, or that name something that does not exist."""
    names: set[str] = set()
    for document in blueprint.documents:
        if KEY not in document.values:
            continue
        found, faults = read_properties(document.values[KEY])
        for fault in faults:
            words = f"a property is not understood: {fault.sentence}"
            yield _remark(document, fault.path, fault.name, words, _low(fault.advice))
        for index, one in found.items():
            heed()
            path = (KEY, str(index))
            if one.name in names:
                words = f"the name {one.name} is used twice"
                yield _remark(document, (*path, "name"), one.name, words, "give it another name")
            names.add(one.name)
            for below, words, advice in _odd_names(blueprint, one):
                said = f"a property is not understood: {words}"
                yield _remark(document, (*path, *below), one.name, said, _low(advice))


def _odd_names(blueprint: Blueprint, one: Property) -> Iterator[tuple[tuple[str, ...], str, str]]:
    """Yield the keys, the sentence and the advice of each name that does not exist."""
    for formula, keys in texts_of(one):
        try:
            meaning_of(formula, blueprint)
        except FormulaError as error:
            yield keys, error.sentence, error.advice
    if one.kind == "cost":
        try:
            goal = blueprint.resolve(one.goal)
        except AddressError as error:
            yield ("cost", "goal"), error.sentence, error.advice
        else:
            if not goal.state or goal.operation:
                yield ("cost", "goal"), f"the goal {one.goal} is no state", "write SB/State"
    if one.kind == "at_most" and not may_name(blueprint, one.operation):
        known = dict.fromkeys(name for branch in blueprint for name in branch.operation_names)
        words = f"no operation is called {one.operation}"
        yield ("at_most", "operation"), words, did_you_mean(one.operation, known)


_SHOWN = 12


def _name_of(entry: Any) -> str:
    name = entry.get("name") if isinstance(entry, dict) else None
    return name if isinstance(name, str) else ""


def _low(advice: str) -> str:
    """Return an advice as the words after a semicolon."""
    return advice[:1].lower() + advice[1:].rstrip(".")


def _remark(home: Document, path: tuple[str, ...], name: str, message: str, advice: str) -> Remark:
    address = Address(path[0], name) if name else Address(path[0])
    advice = advice or "it is kept in the file, and left out of the meaning"
    return Remark("R29", Severity.ERROR, address, message, advice, spot=(home, path))
