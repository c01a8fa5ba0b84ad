"""Shows whether the hazards and properties of a blueprint hold."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.hazards import guard_hazards
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.property import Property
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.route.effort import refuse_too_large
from smsl_studio.dispatch.route.planner import Planner
from smsl_studio.errors import RunRefused
from smsl_studio.inspection.proof.claim_cones import WATCHED
from smsl_studio.inspection.proof.claims import Claim, claims_of
from smsl_studio.inspection.proof.contradiction import contradicted
from smsl_studio.inspection.proof.prove import LIMIT, PlannedRoute, Scope
from smsl_studio.inspection.proof.prove import prove as proved
from smsl_studio.inspection.proof.verdict import (
    FAILS,
    HAZARD,
    HOLDS,
    UNKNOWN,
    Counterexample,
    PropertyVerdict,
)
from smsl_studio.inspection.rules.finding import Finding, Remark, Severity
from smsl_studio.inspection.selection import listed
from smsl_studio.stop import EffortBounds

RULES = {HAZARD: "R19", "never": "R19", "way_back": "R20"}


@dataclass(frozen=True)
class Proof:
    """The verdicts about all hazards and properties, and the findings that follow from them."""

    verdicts: tuple[PropertyVerdict, ...]
    findings: tuple[Finding, ...]


def prove(
    blueprint: Blueprint,
    limit: int = LIMIT,
    with_failures: bool = False,
    seconds: float | None = None,
    megabytes: int | None = None,
) -> Proof:
    """Return whether the hazards and properties of a blueprint hold (paper, Inspection).

    The proof is about the blueprint as it is written. It assumes that every operation does what its
    edge says.

    ``limit`` is the largest number of configurations that are stored. ``seconds`` (wall time) and
    ``megabytes`` (MB, memory of this process) limit the work. If a limit is met, a verdict may be
    ``unknown``. With ``with_failures`` a run may also begin in each reachable configuration after
    one SB has changed to one of its failure states.

    >>> prove(read("hanoi-corrected.json")).verdicts
    ()
    """
    bounds = EffortBounds(seconds, megabytes)
    return proof_in(blueprint, Scope(limit, with_failures, bounds=bounds))


def proof_in(blueprint: Blueprint, scope: Scope) -> Proof:
    """Return the same within the limits of ``scope``, which may also hear how far the work is."""
    claims = {(one.path[0], one.name): one for one in claims_of(blueprint)}
    if not claims:
        return Proof((), ())
    bound = _too_large(blueprint)
    if bound:
        verdicts = tuple(
            PropertyVerdict(one.name, one.kind, one.severity, UNKNOWN, None, bound)
            for one in claims.values()
        )
    else:
        verdicts = proved(blueprint, _Routes(blueprint).planned, scope)
    by_claim = [(claims[one.address.path[0], one.name], one) for one in verdicts]
    return Proof(verdicts, tuple(listed(blueprint, _remarks(blueprint, by_claim))))


def _too_large(blueprint: Blueprint) -> str:
    """Return why a blueprint is too large for a proof, or the empty text if it is not."""
    try:
        refuse_too_large(Hierarchy(blueprint))
    except RunRefused as error:
        return error.sentence
    return ""


class _Routes:
    """Plans the routes that properties ask for. All of them begin at the start."""

    def __init__(self, blueprint: Blueprint) -> None:
        self._blueprint = blueprint
        self._found: dict[tuple[Address, ...], PlannedRoute | None] = {}

    def planned(self, goals: Sequence[Address]) -> PlannedRoute | None:
        """Return the cheapest route to the goals, None if there is none."""
        asked = tuple(goals)
        if asked not in self._found:
            self._found[asked] = self._route(asked)
        return self._found[asked]

    def _route(self, goals: Sequence[Address]) -> PlannedRoute | None:
        hierarchy = Hierarchy(self._blueprint)
        here = start_configuration(hierarchy, {})
        terms = Terms(hazards=guard_hazards(self._blueprint))
        legs = Planner(hierarchy, terms).legs(here, goals)
        if legs is None:
            return None
        configurations = [dict(here)]
        for leg in legs:
            for step in leg.steps:
                for action in step.actions:
                    configurations.append({**configurations[-1], **action.moved})
        steps = [step for leg in legs for step in leg.steps]
        return PlannedRoute(
            tuple(step.asked.address for step in steps),
            tuple(edge.address for step in steps for edge in step.edges),
            tuple(configurations),
            sum(leg.cost for leg in legs),
        )


def _remarks(
    blueprint: Blueprint, verdicts: Sequence[tuple[Claim, PropertyVerdict]]
) -> Iterator[Remark]:
    for sentence, verdict in verdicts:
        if sentence.meanings is None:
            continue
        if verdict.verdict == HOLDS:
            yield from _notes(sentence)
            continue
        yield Remark(
            RULES.get(verdict.kind, "R30"),
            Severity(verdict.severity),
            verdict.address,
            _words(verdict, blueprint, sentence.written),
            _advice(verdict),
            spot=(sentence.document, sentence.path),
        )


def _notes(claim: Claim) -> Iterator[Remark]:
    """Note that a hazard or a ``never`` holds only because it contradicts itself."""
    if claim.kind not in WATCHED or claim.meanings is None:
        return
    names = contradicted(claim.meanings[0])
    if not names:
        return
    nowhere = f"no state of {' or '.join(names[:_SHOWN])} fits all that it names"
    words = f"{claim.name} can never be met: {nowhere}"
    advice = "compare what it names with the states"
    if claim.kind == HAZARD:
        advice += "; a run watches for it all the same, because sensors may show anything"
    spot = (claim.document, claim.path)
    address = Address(claim.path[0], claim.name)
    yield Remark(RULES[claim.kind], Severity.NOTE, address, words, advice, spot=spot)


def _words(verdict: PropertyVerdict, blueprint: Blueprint, written: Property | None = None) -> str:
    """Return the sentence of a finding. ``written`` is the property as it was read."""
    if verdict.verdict == UNKNOWN:
        many = verdict.configurations
        seen = "" if many is None else f"; {_configurations(many)} looked at"
        return f"it is unknown whether {verdict.name} holds: {verdict.bound}{seen}"
    assert verdict.verdict == FAILS
    run = verdict.counterexample
    many = len(run.path) if run else 0
    failed = _failed(run, blueprint)
    if failed:
        after = f"{_after(many)} from {failed}" if many else f"as soon as {failed} is entered"
    else:
        after = _after(many) if many else "at the start"
    if verdict.kind == HAZARD:
        return f"the facts of the hazard {verdict.name} hold together {after}"
    if verdict.kind == "reachable":
        return f"{verdict.name} fails: no configuration that can be reached is such"
    if verdict.kind in ("at_most", "cost"):
        return f"{verdict.name} fails: {_route_words(many, written)}"
    return f"{verdict.name} fails {after}"


def _route_words(many: int, written: Property | None) -> str:
    """Return why a route does not do."""
    if not many:
        return "there is no route"
    route = f"the cheapest route has {_counted(many)}"
    if written is None:
        return route
    if written.kind == "cost":
        return f"{route} and costs more than {written.limit:g}"
    times = "once" if written.times == 1 else f"{written.times} times"
    return f"{route} and carries out {written.operation} more than {times}"


def _after(many: int) -> str:
    return f"after {_counted(many)}"


def _counted(many: int) -> str:
    return f"{many} operation{'' if many == 1 else 's'}"


def _configurations(many: int) -> str:
    return "1 configuration was" if many == 1 else f"{many:,} configurations were"


def _failed(run: Counterexample | None, blueprint: Blueprint) -> str:
    """Return the failure state in which a run begins; empty if nothing has failed there.

    A run that begins at INITIAL is not said to begin with a failure, whatever INITIAL holds.
    """
    for name, state in run.start.items() if run else ():
        branch = blueprint[name]
        if state != branch.initial and state in failing_states(branch):
            return str(Address(name, state))
    return ""


def _advice(verdict: PropertyVerdict) -> str:
    run = verdict.counterexample
    if run is None or not run.path:
        return ""
    shown = ", ".join(str(one) for one in run.path[:_SHOWN])
    return f"by {shown}{' and so on' if len(run.path) > _SHOWN else ''}"


_SHOWN = 5
