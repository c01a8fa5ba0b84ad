"""Guards: all checks before anything moves, for every edge of a joint step (clause 4).

The stepper has checked what does not depend on sensors: permission, exclusions, bindings and routes
of sub-SBs. Here are the checks of the scene. The supervisor is asked last (``review``).
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
    """Return why a joint step may not begin now, as sentences. Empty if it may."""
    reasons = _sources(run, step)
    if run.guarded:
        reasons.extend(lost_critical(run))
        reasons.extend(_required(run, step))
    return tuple(dict.fromkeys(reasons)) if reasons else ()


def asked(run: LiveRun, course: Course, address: Address) -> JointStep | Unavailable:
    """Return the joint step of an operation that a person asks for, or all reasons why there is
    none.

    The scene, the supervisor and people are asked after this.
    """
    if not address.operation:
        return Unavailable(f"{address} is no operation")
    try:
        edge = course.edge(run.blueprint.resolve(address))
    except AddressError as error:
        return Unavailable(error.sentence)
    if edge is None:
        return Unavailable(f"{address} leads to no state")
    active = run.configuration[edge.branch]
    if active != edge.source:
        return Unavailable(f"{edge.branch} is in {active}, not in {edge.source}")
    return course.asked(run.configuration, edge)


def _sources(run: LiveRun, step: JointStep) -> list[str]:
    """Return the failed state checks of the active states that edges of a step leave. Later states
    are checked when the run gets there.
    """
    found: list[str] = []
    configuration = run.configuration
    for branch, source in step.leaves:
        if source == configuration[branch]:
            check = run.check(branch, source)
            if check.truth is not True:
                found.append(check_words(run.blueprint, check))
    return found


def doubt(run: LiveRun, edge: Edge) -> str:
    """Return why an edge of a step that has begun may not run its function now, or the empty text.
    The reason is the state check of the state it leaves. ``Safeguards`` checks what the edge
    requires.
    """
    check = run.check(edge.branch, run.believed[edge.branch], run.transit)
    return "" if check.truth is True else check_words(run.blueprint, check)


def needs(run: LiveRun, edge: Edge) -> Iterator[Term]:
    """Yield the facts of other SBs that an edge requires, with their readings."""
    for branch, digit, value in edge.requires:
        if digit < 0:
            yield Term((branch, digit), value, None, None, "there is no such fact")
            continue
        term = run.check(branch, run.configuration[branch]).terms[digit]
        truth = None if term.reading is None else term.reading == value
        yield Term(term.fact, value, term.reading, truth, term.reason)


def _required(run: LiveRun, step: JointStep) -> Iterator[str]:
    """Yield the required facts that are not sensed as required, for SBs that the step has not moved
    before.
    """
    moved: set[str] = set()
    for edge in step.edges:
        if edge.requires:
            yield from _unmet(run, edge, moved)
        moved |= moved_by(run, edge)


def _unmet(run: LiveRun, edge: Edge, moved: Collection[str]) -> Iterator[str]:
    """Yield the facts that an edge requires and that are not sensed as required, without the moved
    SBs.
    """
    for term in needs(run, edge):
        branch, digit = term.fact
        if digit >= 0 and branch not in moved and term.truth is not True:
            yield required_words(run.blueprint, edge, term)
