"""The facts for which people must be asked: they are needed now, unknown, and people may tell
them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from smsl_studio.blueprint.check import IN_TRANSIT, CheckResult, FactKey, Term, sub_below
from smsl_studio.blueprint.continuum import AUTOMATIC
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.levels import sensed_facts
from smsl_studio.dispatch.execution.guards import needs
from smsl_studio.dispatch.execution.hazard_guard import doubts
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.people.board import Question
from smsl_studio.dispatch.people.questions import fact_task


def in_checks(run: LiveRun, checks: Iterable[CheckResult]) -> tuple[Question, ...]:
    """Return questions for the facts that make state checks unknown.

    A check that is false stays false whatever people tell, so nobody is asked because of it.
    """
    if not run.people_say:
        return ()
    terms = (term for check in checks if check.truth is None for term in check.unknown)
    return _questions(run, terms)


def of_step(run: LiveRun, step: JointStep) -> tuple[Question, ...]:
    """Return questions for the unknown facts that the guards of a step need."""
    if not run.people_say:
        return ()
    standing = ((name, state) for name, state in step.leaves if state == run.configuration[name])
    checks = [run.check(name, state) for name, state in standing]
    if any(check.truth is False for check in checks):
        return ()
    required = [term for edge in step.edges for term in needs(run, edge)]
    if any(term.truth is False for term in required):
        return ()
    endangers = doubts(run, step) if run.hazards else ()
    terms = (*(term for check in checks for term in check.unknown), *required, *endangers)
    return _questions(run, (term for term in terms if term.truth is None))


def everywhere(run: LiveRun) -> tuple[Question, ...]:
    """Return questions for all unknown facts that people may tell, in any state of the run."""
    if not run.people_say:
        return ()
    found = []
    for name, digit in sensed_facts(run.blueprint):
        reading = run.senses.scene.get(name, digit)
        if (
            reading is not None
            and reading.value is None
            and run.levels.fact(name, digit) != AUTOMATIC
        ):
            found.append(fact_task(run.blueprint, (name, digit), reading.reason))
    return tuple(found)


def all_theirs(run: LiveRun, terms: Iterable[Term]) -> bool:
    """Return whether all these terms are unknown, and people may tell facts that they depend on."""
    return run.people_say and all(
        term.truth is None and bool(_questions(run, [term])) for term in terms
    )


def _questions(run: LiveRun, terms: Iterable[Term]) -> tuple[Question, ...]:
    found: dict[FactKey, str] = {}
    met: set[FactKey] = set()
    for term in terms:
        found.update(_theirs(run, term, met))
    return tuple(fact_task(run.blueprint, key, reason) for key, reason in found.items())


def _theirs(run: LiveRun, term: Term, met: set[FactKey]) -> Iterator[tuple[FactKey, str]]:
    """Yield the unknown facts that a term depends on and people may tell, each with the reason.

    ``met`` has the facts that were followed already, because several bases may share a sub-SB.
    """
    name, digit = term.fact
    if digit < 0 or term.reason == IN_TRANSIT or term.fact in met:
        return
    met.add(term.fact)
    branch = run.blueprint[name]
    sub = sub_below(run.blueprint, branch, digit)
    if sub is not None:
        for inner in run.check(sub.name, sub.activating).unknown:
            yield from _theirs(run, inner, met)
    elif run.levels.fact(name, digit) != AUTOMATIC:
        reading = run.senses.scene.get(name, digit)
        if reading is not None and reading.value is None:
            yield term.fact, reading.reason
