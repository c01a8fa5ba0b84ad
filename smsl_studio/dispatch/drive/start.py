"""The start of a run: all checks that can refuse it before anything moves (clauses 1, 3 and 11)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from smsl_studio.blueprint.address import Address, fact_text
from smsl_studio.blueprint.check import CheckResult
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.hazards import GuardHazard
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.dispatch.execution.hazard_guard import met, met_words
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.senses import SensedEvent
from smsl_studio.dispatch.execution.words import all_words, check_words, truth_word
from smsl_studio.dispatch.route.goals import goals_of
from smsl_studio.errors import RunRefused
from smsl_studio.host.protocol import Host
from smsl_studio.runlog.events import Event, LeftOut, RunStarted, StateChecked


def begin_run(
    blueprint: Blueprint,
    host: Host,
    terms: RunTerms,
    levels: Levels | None = None,
    hazards: Sequence[GuardHazard] = (),
) -> tuple[LiveRun, tuple[Address, ...]]:
    """Open the host in the start configuration of ``terms``. Return the run and its goals in order.

    RunRefused says why a run cannot start. If the blueprint, the start or the goals are the reason,
    nothing is opened.
    """
    hierarchy = Hierarchy(blueprint)
    if not blueprint.branches:
        raise RunRefused("the blueprint has no State Branch", advice="Add one and draw its states.")
    configuration = start_configuration(hierarchy, terms.start)
    _refuse_hazards([one for one in hazards if one.meets(configuration)])
    ordered = goals_of(hierarchy, terms.goals)
    opened = host.open(configuration)
    if opened.hardware and not terms.hardware:
        words = f"{opened.world} is hardware and this blueprint has no inspection record"
        advice = "Run it in a simulated world first."
        raise RunRefused(words, advice=advice, refusals=[("policy_unmet", words)])
    run = LiveRun(hierarchy, host, opened, configuration, levels)
    run.guard_against(hazards)
    run.left_out = tuple(terms.left_out)
    run.approved, run.met, run.robot = terms.approved, tuple(terms.met), terms.robot
    run.unconfirmed = terms.unconfirmed
    return run, ordered


def _refuse_hazards(hazards: Sequence[GuardHazard]) -> None:
    """Raise RunRefused if there are hazards: those that the start meets."""
    if hazards:
        raise RunRefused(
            f"the start meets a hazard: {'; '.join(met_words(hazards))}",
            advice="Start where its facts do not hold together.",
        )


def start_events(
    run: LiveRun, seed: int, goals: Sequence[Address], changes: Sequence[SensedEvent]
) -> tuple[Event, ...]:
    """Return the first events of a run. ``changes`` are the first changes of facts.

    RunRefused if a state check is not true on sensed facts, or if they meet a hazard.
    """
    checks = run.checks(run.configuration)
    failed = [check for check in checks if check.truth is not True]
    if failed:
        said = [check_words(run.blueprint, check) for check in failed[:_TOLD]]
        if len(failed) > _TOLD:
            said.append(f"{len(failed) - _TOLD:,} more state checks are not true")
        advice = _silent(run, checks) or "Put the world where the start has it."
        words = "; ".join(said)
        told = [("start_unconfirmed", words)] if run.approved else []
        raise RunRefused(words, advice=advice, refusals=told)
    _refuse_hazards(met(run))
    started = RunStarted(
        t=run.time,
        world=run.opened.world,
        seed=seed,
        start=dict(run.configuration),
        goals=tuple(map(str, goals)),
        behaviour=run.blueprint.behaviour,
        met=run.met,
        sensed=tuple(fact_text(*key) for key in run.senses.sensed),
        robot=run.robot,
    )
    missing = [LeftOut(t=run.time, address=one, sentence=words) for one, words in run.left_out]
    return (started, *missing, *changes, *_checked(run))


_TOLD = 20
"""The largest number of failed state checks, and of silent sensors, in a refusal."""


def _checked(run: LiveRun) -> Iterator[StateChecked]:
    for check in run.checks(run.configuration):
        yield StateChecked(
            t=run.time,
            address=str(Address(check.branch, check.state)),
            result=truth_word(check.truth),
            misses=all_words(run.blueprint, check.misses),
            unknown=all_words(run.blueprint, check.unknown),
        )


def _silent(run: LiveRun, checks: Sequence[CheckResult]) -> str:
    """Return an advice about remote sensors that have sent nothing. Empty if there are none."""
    elsewhere = run.opened.remote
    wanted = {term.fact for check in checks for term in check.terms if term.truth is None}
    silent = {(*one.fact, one.said.source) for one in run.senses.sources if one.said.value is None}
    missing = [
        f"{fact_text(one.branch, one.digit)} as {one.name}"
        for one in run.opened.sensors
        if one.remote
        and (one.branch, one.digit) in wanted
        and (one.branch, one.digit, one.name) in silent
    ]
    if elsewhere is None or not missing:
        return ""
    view = elsewhere.view()
    if len(missing) > _TOLD:
        missing[_TOLD:] = [f"{len(missing) - _TOLD:,} more"]
    advice = (
        f"Start a node that tells {', '.join(missing)} to the site {view.site!r} and the run "
        f"{view.run!r} at {view.broker}."
    )
    lost = [f"{one.kind} ({one.example})" for one in view.received.refusals]
    return f"{advice} What came counted for nothing: {', '.join(lost)}." if lost else advice
