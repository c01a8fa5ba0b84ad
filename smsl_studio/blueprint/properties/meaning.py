"""The meaning of a formula in a blueprint: sets of states of single SBs, joined by not, and, or."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from smsl_studio.blueprint.known_values import values_of
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.properties.formula import (
    AllOf,
    AnyOf,
    FactTerm,
    Formula,
    Negation,
    StateTerm,
)
from smsl_studio.errors import FormulaError, did_you_mean
from smsl_studio.stop import heed

__all__ = [
    "Joined",
    "Meaning",
    "States",
    "branches_in",
    "fact_of",
    "holds",
    "meaning_of",
    "values_of",
]


@dataclass(frozen=True, slots=True)
class States:
    """True while an SB is in one of these states."""

    branch: str
    states: frozenset[str]


@dataclass(frozen=True, slots=True)
class Joined:
    """True if all of its parts are true (``every``), or at least one of them."""

    every: bool
    parts: tuple[Meaning, ...]


Meaning = States | Joined
"""Negations are worked out: an SB is always in exactly one of its states."""


def holds(meaning: Meaning, configuration: Mapping[str, str]) -> bool:
    """Return whether a formula is true in a configuration."""
    if isinstance(meaning, States):
        return configuration[meaning.branch] in meaning.states
    found = (holds(part, configuration) for part in meaning.parts)
    return all(found) if meaning.every else any(found)


def branches_in(meaning: Meaning) -> Iterator[str]:
    """Yield the SBs that a formula speaks of; one may come several times."""
    if isinstance(meaning, States):
        yield meaning.branch
    else:
        for part in meaning.parts:
            heed()
            yield from branches_in(part)


def meaning_of(formula: Formula, blueprint: Blueprint) -> Meaning:
    """Return the meaning of a formula. FormulaError for a name or value that does not exist."""
    return _Look(blueprint).up(formula, True)


def fact_of(term: FactTerm, blueprint: Blueprint) -> tuple[str, int] | None:
    """Return the SB and the digit that a comparison speaks of, None if there is no such fact."""
    look = _Look(blueprint)
    try:
        branch = look.branch(term)
        return branch.name, look.digit(term, branch)
    except FormulaError:
        return None


def may_name(blueprint: Blueprint, pattern: str) -> bool:
    """Return whether a pattern fits an operation's name, or ``SB/operation``. A pattern with ``*``
    or ``?`` need not."""
    if "*" in pattern or "?" in pattern:
        return True
    return any(
        pattern in (name, f"{branch.name}/{name}")
        for branch in blueprint
        for name in branch.operation_names
    )


class _Look:
    """Looks the names of a formula up in a blueprint."""

    def __init__(self, blueprint: Blueprint) -> None:
        self._blueprint = blueprint

    def up(self, formula: Formula, wanted: bool) -> Meaning:
        """Return the meaning of a formula, or of its negation if ``wanted`` is false."""
        heed()
        if isinstance(formula, Negation):
            return self.up(formula.part, not wanted)
        if isinstance(formula, AllOf | AnyOf):
            parts = tuple(self.up(part, wanted) for part in formula.parts)
            return Joined(isinstance(formula, AllOf) == wanted, parts)
        branch = self.branch(formula)
        if isinstance(formula, StateTerm):
            if formula.state not in branch.table:
                advice = did_you_mean(formula.state, branch.table)
                raise FormulaError(
                    f"{branch.name} has no state {formula.state}", formula.at, advice
                )
            found = frozenset((formula.state,))
        else:
            digit = self.digit(formula, branch)
            found = branch.states_with(digit, formula.value)
            known = () if found else values_of(branch, digit)
            if not found and formula.value not in known:
                advice = f"It has {', '.join(known[:_SHOWN])}." if known else ""
                name = branch.fact_name(digit)
                words = f"{name} of {branch.name} never has the value {formula.value}"
                raise FormulaError(words, formula.at, advice)
            wanted = wanted == formula.equal
        return States(branch.name, found if wanted else frozenset(branch.table) - found)

    def branch(self, term: FactTerm | StateTerm) -> StateBranch:
        """Return the SB that a term speaks of."""
        branches = self._blueprint.branches
        if not term.branch:
            if len(branches) != 1:
                words = "the SB of the fact is missing, and the file has several"
                raise FormulaError(words, term.at, "Write SB/DIGIT, such as SB1/0.")
            return next(iter(branches.values()))
        if term.branch not in branches:
            advice = did_you_mean(term.branch, branches)
            raise FormulaError(f"there is no SB {term.branch}", term.at, advice)
        return branches[term.branch]

    def digit(self, term: FactTerm, branch: StateBranch) -> int:
        """Return the digit that a term speaks of."""
        count = len(branch.alphabet)
        if term.name:
            named = [digit for digit in range(count) if _plain_name(branch, digit) == term.name]
            if len(named) == 1:
                return named[0]
            known = filter(None, (_plain_name(branch, digit) for digit in range(count)))
            number = "no fact" if not named else f"{len(named)} facts"
            advice = did_you_mean(term.name, known) or "Name it by its digit, counted from 0."
            raise FormulaError(f'{branch.name} has {number} named "{term.name}"', term.at, advice)
        if term.digit is None and count != 1:
            words = f"{branch.name} has {count} facts, so a digit is missing"
            raise FormulaError(words, term.at, f"Write {branch.name}/0 for the first one.")
        digit = term.digit or 0
        if digit >= count:
            words = f"{branch.name} has {count} facts, so {digit} is none of its digits"
            raise FormulaError(words, term.at, "Digits count from 0.")
        return digit


_SHOWN = 12


def _plain_name(branch: StateBranch, digit: int) -> str:
    note = branch.fact_note(digit)
    return note.name if note else ""
