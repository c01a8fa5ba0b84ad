"""The dispatcher's sentences about facts and state checks."""

from __future__ import annotations

from collections.abc import Iterable

from smsl_studio.blueprint.check import CheckResult, Term
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.model import Blueprint


def fact_words(blueprint: Blueprint, term: Term) -> str:
    """Return a term in words, such as ``Fact 2 of SB1 reads b, not a``."""
    return f"{_name(blueprint, term)} {_verdict(term)}"


def critical_words(blueprint: Blueprint, term: Term) -> str:
    """Return the words for a critical fact that does not hold."""
    return f"{_name(blueprint, term)}, a critical fact, {_verdict(term)}"


def required_words(blueprint: Blueprint, edge: Edge, term: Term) -> str:
    """Return the words for a fact that an edge requires and that does not hold."""
    branch, digit = term.fact
    what = fact_words(blueprint, term)
    return f"{edge} requires {branch}/{digit} to be {term.wanted}: {what}"


def _name(blueprint: Blueprint, term: Term) -> str:
    branch, digit = term.fact
    return f"{blueprint[branch].fact_name(digit)} of {branch}"


def _verdict(term: Term) -> str:
    if term.truth is None:
        return f"is unknown, {term.reason}"
    return f"reads {term.reading}" + ("" if term.truth else f", not {term.wanted}")


def all_words(blueprint: Blueprint, terms: Iterable[Term]) -> tuple[str, ...]:
    """Return the words of every term."""
    return tuple(fact_words(blueprint, term) for term in terms)


def check_words(blueprint: Blueprint, check: CheckResult) -> str:
    """Return why a state check is not true."""
    facts = "; ".join(all_words(blueprint, (*check.misses, *check.unknown)))
    return f"{check.branch}/{check.state} does not check true: {facts}"


def truth_word(truth: bool | None) -> str:
    """Return ``true``, ``false`` or ``unknown``."""
    return "true" if truth else "unknown" if truth is None else "false"
