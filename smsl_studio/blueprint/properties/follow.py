"""Rewrites names in formulas and properties after an edit. The rest of the text stays."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.properties.formula import (
    AllOf,
    AnyOf,
    FactTerm,
    Formula,
    Negation,
    Span,
    StateTerm,
    Term,
)
from smsl_studio.blueprint.properties.formula_text import read_formula, written_name, written_plain
from smsl_studio.errors import FormulaError
from smsl_studio.stop import heed

Json = Any


def terms_of(formula: Formula) -> Iterator[Term]:
    """Yield the comparisons of a formula in the order of the text."""
    if isinstance(formula, Negation):
        yield from terms_of(formula.part)
    elif isinstance(formula, AllOf | AnyOf):
        for part in formula.parts:
            heed()
            yield from terms_of(part)
    else:
        yield formula


def followed(text: str, change: Callable[[Term], Term]) -> str:
    """Return the text of a formula in which each comparison is changed.

    ``change`` returns the comparison with other names, or the same one. A name that is left out
    stays so. A text that cannot be read is returned as it is.
    """
    try:
        formula = read_formula(text)
    except FormulaError:
        return text
    pieces: list[tuple[Span, str]] = []
    for term in terms_of(formula):
        after = change(term)
        if after != term:
            pieces.extend(_pieces(term, after))
    found, at = [], 0
    for (start, end), name in pieces:
        found += [text[at:start], name]
        at = end
    return "".join((*found, text[at:]))


def property_followed(
    entry: Json,
    term: Callable[[Term], Term] | None = None,
    goal: Callable[[Address], Address] | None = None,
    operation: Callable[[str], str] | None = None,
) -> Json:
    """Return an entry of ``_properties`` with new names.

    ``term`` returns a comparison with its new names, ``goal`` the new address of a goal, and
    ``operation`` the new pattern of an operation. Text that cannot be read stays as it is.
    """
    if not isinstance(entry, dict):
        return entry
    after = dict(entry)
    for kind in ("never", "reachable", "before", "after", "way_back"):
        if kind in entry and term is not None:
            after[kind] = _conditions(entry[kind], term)
    for kind, key, change in (
        ("cost", "goal", goal and _addressed(goal)),
        ("at_most", "operation", operation),
    ):
        inside = entry.get(kind)
        if change and isinstance(inside, dict) and isinstance(inside.get(key), str):
            after[kind] = {**inside, key: change(inside[key])}
    return after


def _conditions(value: Json, term: Callable[[Term], Term]) -> Json:
    if isinstance(value, str):
        return followed(value, term)
    if isinstance(value, list):
        return [_conditions(one, term) for one in value]
    if isinstance(value, dict):
        return {
            key: _conditions(one, term) if key in ("from", "to") else one
            for key, one in value.items()
        }
    return value


def _addressed(change: Callable[[Address], Address]) -> Callable[[str], str]:
    """Return a function that changes a written address. An address without an SB still has none."""

    def changed(text: str) -> str:
        """Return the text of the address after the edit."""
        names = Address.split(text)
        if len(names) != 2 or not all(names):
            return text
        before = Address(*names)
        after = change(before)
        return text if after == before else str(after)

    return changed


def _pieces(before: Term, after: Term) -> Iterator[tuple[Span, str]]:
    """Yield the spans of the names that differ, and their new text."""
    if before.branch != after.branch and any(before.spans[0]):
        # Digits without quotes would be the digit of a fact.
        quotes = after.branch.isdecimal()
        yield before.spans[0], f"'{after.branch}'" if quotes else written_name(after.branch)
    if isinstance(before, StateTerm) and isinstance(after, StateTerm):
        if before.state != after.state:
            yield before.spans[1], written_name(after.state)
    elif isinstance(before, FactTerm) and isinstance(after, FactTerm):
        _, fact, value = before.spans
        if before.digit != after.digit and any(fact):
            yield fact, str(after.digit)
        elif before.name != after.name:
            yield fact, written_plain(after.name)
        if before.value != after.value:
            yield value, written_name(after.value)
