"""Guards: all that is asked before anything moves, for every edge of a joint step (clause 4).

What does not depend on sensing (permitted, not shut out, bound, sub-SB routes) is answered by the
stepper; here are the questions to the scene and to the supervisor.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.along import Unavailable
from smsl_studio.blueprint.check import CheckResult
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.dispatch.course import Course
from smsl_studio.dispatch.run import Run
from smsl_studio.dispatch.words import check_words, fact_words
from smsl_studio.errors import AddressError

Supervisor = Callable[[JointStep], str]
"""Asked last, before motion: the empty text agrees, anything else is the objection."""


def refusals(run: Run, step: JointStep, supervisor: Supervisor | None = None) -> tuple[str, ...]:
    """Why a joint step may not begin now, as sentences; empty where it may."""
    reasons = [*_sources(run, step), *_required(run, step)]
    if not reasons and supervisor is not None:
        objection = supervisor(step)
        reasons += [objection] if objection else []
    return tuple(dict.fromkeys(reasons))


def asked(
    run: Run, course: Course, address: Address, supervisor: Supervisor | None = None
) -> JointStep | tuple[str, ...]:
    """The joint step of an operation that a person asks for, or every reason against it."""
    try:
        edge = course.edge(run.blueprint.resolve(address))
    except AddressError as error:
        return (error.sentence,)
    if edge is None:
        return (f"{address} leads to no state",)
    active = run.configuration[edge.branch]
    if active != edge.source:
        return (f"{edge.branch} is in {active}, not in {edge.source}",)
    step = course.asked(run.configuration, edge)
    if isinstance(step, Unavailable):
        return step.reasons
    return refusals(run, step, supervisor) or step


def _sources(run: Run, step: JointStep) -> Iterator[str]:
    """Every edge that starts in an active state needs that state's check true on sensed facts;
    later ones are checked when the run gets there."""
    for branch in dict.fromkeys(edge.branch for edge in step.edges):
        source = next(edge.source for edge in step.edges if edge.branch == branch)
        if source == run.configuration[branch]:
            check = run.check(branch, source)
            if check.truth is not True:
                yield check_words(run.blueprint, check)


def _required(run: Run, step: JointStep) -> Iterator[str]:
    """Required facts of SBs that the step has not moved by then must be sensed so."""
    moved: set[str] = set()
    for edge in step.edges:
        for branch, digit, value in edge.requires:
            if digit < 0 or branch in moved:
                continue
            check: CheckResult = run.check(branch, run.configuration[branch])
            term = check.terms[digit]
            if term.reading != value:
                what = fact_words(run.blueprint, term)
                yield f"{edge} requires {branch}/{digit} to be {value}: {what}"
        moved.add(edge.branch)
