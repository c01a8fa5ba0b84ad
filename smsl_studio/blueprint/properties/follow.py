"""Lets the text of a formula follow an edit: other names, and every other character as it was."""

from __future__ import annotations

from collections.abc import Callable, Iterator

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
from smsl_studio.blueprint.properties.reading import read_formula, written_name, written_plain
from smsl_studio.errors import FormulaError


def terms_of(formula: Formula) -> Iterator[Term]:
    """Yield the comparisons of a formula in the order of the text."""
    if isinstance(formula, Negation):
        yield from terms_of(formula.part)
    elif isinstance(formula, AllOf | AnyOf):
        for part in formula.parts:
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
