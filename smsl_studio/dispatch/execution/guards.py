"""Guards: all that is asked before anything moves, for every edge of a joint step (clause 4).

What does not depend on sensing (permitted, not shut out, bound, sub-SB routes) is answered by the
stepper; here are the questions to the scene. The supervisor is asked last (``review``).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.along import Unavailable
from smsl_studio.blueprint.check import Term
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.dispatch.execution.effects import moved_by
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.safeguards import lost_critical
from smsl_studio.dispatch.execution.words import check_words, required_words
from smsl_studio.dispatch.route.course import Course
from smsl_studio.errors import AddressError


def refusals(run: LiveRun, step: JointStep) -> tuple[str, ...]:
    """Why a joint step may not begin now, as sentences; empty where it may."""
    reasons = [*_sources(run, step), *lost_critical(run)]
    for edge in step.edges:
        if edge.requires:
            reasons.extend(_required(run, step))
            break
    return tuple(dict.fromkeys(reasons)) if reasons else ()


def asked(run: LiveRun, course: Course, address: Address) -> JointStep | tuple[str, ...]:
    """The joint step of an operation that a person asks for, or every reason why there is none.

    What the scene, the supervisor and people say to it is asked next.
    """
    if not address.operation:
        return (f"{address} is no operation",)
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
    return step.reasons if isinstance(step, Unavailable) else step


def _sources(run: LiveRun, step: JointStep) -> list[str]:
    """Every edge that starts in an active state needs that state's check true on sensed facts;
    later ones are checked when the run gets there."""
    found: list[str] = []
    met: set[str] = set()
    for edge in step.edges:
        branch, source = edge.branch, edge.source
        if branch not in met and source == run.configuration[branch]:
            check = run.check(branch, source)
            if check.truth is not True:
                found.append(check_words(run.blueprint, check))
        met.add(branch)
    return found


def doubt(run: LiveRun, edge: Edge) -> str:
    """Why an edge of a step that is under way may not run its function now: what it starts from
    does not check true. Empty where it may. What it requires is asked of ``Safeguards``."""
    check = run.check(edge.branch, run.believed[edge.branch], run.transit)
    return "" if check.truth is True else check_words(run.blueprint, check)


def needs(run: LiveRun, edge: Edge) -> Iterator[Term]:
    """The facts of other SBs that an edge requires, as they stand now."""
    for branch, digit, value in edge.requires:
        if digit < 0:
            yield Term((branch, digit), value, None, None, "there is no such fact")
            continue
        term = run.check(branch, run.configuration[branch]).terms[digit]
        truth = None if term.reading is None else term.reading == value
        yield Term(term.fact, value, term.reading, truth, term.reason)


def _required(run: LiveRun, step: JointStep) -> Iterator[str]:
    """Required facts of SBs that the step has not moved by then must be sensed so."""
    moved: set[str] = set()
    for edge in step.edges:
        if edge.requires:
            yield from _unmet(run, edge, moved)
        moved |= moved_by(run, edge)


def _unmet(run: LiveRun, edge: Edge, moved: Collection[str]) -> Iterator[str]:
    """What an edge requires of SBs that are not moved, and is not sensed so."""
    for term in needs(run, edge):
        branch, digit = term.fact
        if digit >= 0 and branch not in moved and term.truth is not True:
            yield required_words(run.blueprint, edge, term)
