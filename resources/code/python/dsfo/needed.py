"""The facts for which people must be asked: needed now, unknown, and theirs to tell."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from .checks import IN_TRANSIT, Check, Term
from .elements import AUTOMATIC, FactKey
from .guards import needs
from .hazards import doubtful
from .joint import JointStep
from .live import LiveRun
from .people import Question, fact_task


def in_checks(run: LiveRun, checks: Iterable[Check]) -> list[Question]:
    """Return questions for the facts that make state checks unknown. A check that is false stays
    false whatever people tell.
    """
    return _questions(run, [t for check in checks if check.truth is None for t in check.unknown])


def of_step(run: LiveRun, step: JointStep) -> list[Question]:
    """Return questions for the unknown facts that the guards of a step need."""
    standing = [(b, s) for b, s in step.leaves.items() if s == run.configuration[b]]
    checks = [run.check(branch, state) for branch, state in standing]
    required = [term for edge in step.edges for term in needs(run, edge)]
    if any(check.truth is False for check in checks) or any(t.truth is False for t in required):
        return []
    dangers = [Term(key, "", None, None) for key in doubtful(run, step)]
    terms = [*(term for check in checks for term in check.unknown), *required, *dangers]
    return _questions(run, [term for term in terms if term.truth is None])


def everywhere(run: LiveRun) -> list[Question]:
    """Return questions for all unknown facts that people may tell."""
    return [
        fact_task(run.blueprint, key)
        for key, reading in run.senses.scene.items()
        if reading.value is None and run.levels.fact(key) != AUTOMATIC
    ]


def all_theirs(run: LiveRun, terms: Iterable[Term]) -> bool:
    """Return whether all these terms are unknown, and people may tell what they depend on."""
    return all(term.truth is None and _questions(run, [term]) for term in terms)


def _questions(run: LiveRun, terms: Iterable[Term]) -> list[Question]:
    met: set[FactKey] = set()
    keys = dict.fromkeys(key for term in terms for key in _theirs(run, term, met))
    return [fact_task(run.blueprint, key) for key in keys]


def _theirs(run: LiveRun, term: Term, met: set[FactKey]) -> Iterator[FactKey]:
    """Yield the unknown facts that a term depends on and people may tell."""
    key = term.fact
    if term.reason == IN_TRANSIT or key in met:
        return
    met.add(key)
    sub = run.blueprint.flag(key).sub
    if sub:
        for inner in run.check(sub, run.blueprint[sub].activating).unknown:
            yield from _theirs(run, inner, met)
    elif run.levels.fact(key) != AUTOMATIC:
        reading = run.senses.scene.get(key)
        if reading is not None and reading.value is None:
            yield key
