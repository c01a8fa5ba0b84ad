"""Hazards and properties in plain words: ``Never: drill running while not registered``."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

from smsl_studio.blueprint.address import split_fact
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.properties.formula import (
    AllOf,
    AnyOf,
    FactTerm,
    Formula,
    Negation,
    StateTerm,
)
from smsl_studio.blueprint.properties.meaning import fact_of, values_of
from smsl_studio.blueprint.properties.property import Property
from smsl_studio.stop import heed

LONGEST = 400
"""The largest number of characters of a sentence."""
BINARY = frozenset(("0", "1"))


def property_words(one: Property, blueprint: Blueprint) -> str:
    """Return a property as a sentence. Names that do not exist stand in it as they are written."""
    words = _Phrases(blueprint)
    said = [words.of(formula, top=one.kind == "never") for formula in one.formulas]
    if one.kind == "never":
        sentence = f"Never: {said[0]}"
    elif one.kind == "before":
        sentence = f"First {said[0]}, only then {said[1]}"
    elif one.kind == "after":
        sentence = f"After {said[0]}: every way to the goal passes {said[1]}"
    elif one.kind == "way_back":
        steps = "" if one.within is None else f", in at most {_counted(one.within, 'step')}"
        sentence = f"From {said[0]}: there is always a way to {said[1]}{steps}"
    elif one.kind == "reachable":
        sentence = f"Possible: {said[0]}"
    elif one.kind == "at_most":
        times = {0: "never", 1: "at most once", 2: "at most twice"}
        often = times.get(one.times, f"at most {one.times:,} times")
        sentence = f"The cheapest route carries out {one.operation} {often}"
    else:
        sentence = f"The cheapest route to {one.goal} costs at most {one.limit:g}"
    return _cut(sentence)


def hazard_words(facts: Mapping[str, str], blueprint: Blueprint) -> str:
    """Return the facts of a hazard (``"SB/digit": value``) as a sentence."""
    words, said = _Phrases(blueprint), []
    for text, value in facts.items():
        fact = split_fact(text)
        branch = blueprint.branches.get(fact[0]) if fact else None
        fits = fact is not None and branch is not None and fact[1] < len(branch.alphabet)
        said.append(words.fact(branch, fact[1], value, True) if fits and branch and fact
                    else f"{text} is {value}")  # fmt: skip
    return _cut(f"Never: {_while(said)}")


class _Phrases:
    """The words for the parts of formulas about one blueprint."""

    def __init__(self, blueprint: Blueprint) -> None:
        self._blueprint = blueprint
        self._names: Counter[str] | None = None

    def of(self, formula: Formula, top: bool = False) -> str:
        """Return a formula in words. The first ``and`` of a ``top`` one is ``while``."""
        heed()
        if isinstance(formula, Negation):
            part = formula.part
            if isinstance(part, FactTerm):
                return self._fact_term(part, not part.equal)
            if isinstance(part, StateTerm):
                return self._state(part, False)
            return f"not ({self.of(part)})"
        if isinstance(formula, FactTerm):
            return self._fact_term(formula, formula.equal)
        if isinstance(formula, StateTerm):
            return self._state(formula, True)
        parts = [
            f"({self.of(one)})" if isinstance(one, AllOf | AnyOf) else self.of(one)
            for one in formula.parts
        ]
        if isinstance(formula, AnyOf):
            return " or ".join(parts)
        return _while(parts) if top else " and ".join(parts)

    def fact(self, branch: StateBranch, digit: int, value: str, equal: bool) -> str:
        """Return a fact with a value in words, such as ``not registered``."""
        note = branch.fact_note(digit)
        name = self._name(branch, digit)
        known = {value, *values_of(branch, digit)}
        if note is not None and note.name and known <= BINARY:
            return name if (value == "1") == equal else f"not {name}"
        meaning = note.values.get(value, "") if note is not None else ""
        return f"{name} is {'' if equal else 'not '}{meaning or value}"

    def _name(self, branch: StateBranch, digit: int) -> str:
        """Return the plain name of a fact, with the SB if another one has the same name."""
        note = branch.fact_note(digit)
        if note is None or not note.name:
            return branch.name if len(branch.alphabet) == 1 else f"{branch.name}/{digit}"
        if self._names is None:
            self._names = Counter(
                one.name for every in self._blueprint for one in every.notes.facts.values()
            )
        return note.name if self._names[note.name] == 1 else f"{note.name} of {branch.name}"

    def _fact_term(self, term: FactTerm, equal: bool) -> str:
        fact = fact_of(term, self._blueprint)
        if fact is not None:
            return self.fact(self._blueprint[fact[0]], fact[1], term.value, equal)
        name = term.name or ("" if term.digit is None else str(term.digit))
        path = "/".join(filter(None, (term.branch, name)))
        return f"{path} is {'' if equal else 'not '}{term.value}"

    def _state(self, term: StateTerm, equal: bool) -> str:
        return f"{term.branch} is {'' if equal else 'not '}in {term.state}"


def _while(parts: list[str]) -> str:
    """Join what holds together: ``a while b and c``."""
    first, *others = parts or [""]
    return f"{first} while {' and '.join(others)}" if others else first


def _counted(number: int, noun: str) -> str:
    return f"{number:,} {noun}{'' if number == 1 else 's'}"


def _cut(sentence: str) -> str:
    return sentence if len(sentence) <= LONGEST else f"{sentence[: LONGEST - 1]}…"
