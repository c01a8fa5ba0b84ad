"""What the dispatcher says about facts and checks: sentences that name the fact."""

from __future__ import annotations

from collections.abc import Iterable

from smsl_studio.blueprint.check import CheckResult, Term
from smsl_studio.blueprint.model import Blueprint


def fact_words(blueprint: Blueprint, term: Term) -> str:
    """One term: ``Fact 2 of SB1 reads b, not a``, ``Clamp fixed of SB1 is unknown, no reading``."""
    branch, digit = term.fact
    name = f"{blueprint[branch].fact_name(digit)} of {branch}"
    if term.truth is None:
        return f"{name} is unknown, {term.reason}"
    return f"{name} reads {term.reading}" + ("" if term.truth else f", not {term.wanted}")


def all_words(blueprint: Blueprint, terms: Iterable[Term]) -> tuple[str, ...]:
    """Every term as a sentence."""
    return tuple(fact_words(blueprint, term) for term in terms)


def check_words(blueprint: Blueprint, check: CheckResult) -> str:
    """Why a state check is not true."""
    facts = "; ".join(all_words(blueprint, (*check.misses, *check.unknown)))
    return f"{check.branch}/{check.state} does not check true: {facts}"


def truth_word(truth: bool | None) -> str:
    """``true``, ``false`` or ``unknown``."""
    return "true" if truth else "unknown" if truth is None else "false"
