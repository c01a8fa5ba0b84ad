"""The risk of a proposed step, with its parts and its reasons in words."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.risk import DECLARED, combined, weights_of
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.library.prediction import DIFFERS, Prediction
from smsl_studio.library.supervisor_view import RiskEstimate, SeenFact

RISKS = ("", "low", "medium", "high")


def declared_risk(run: LiveRun, step: JointStep) -> str:
    """Return the highest declared risk of the edges of a step. Empty if none is declared."""
    return max((_risk(run, edge.address) for edge in step.edges), key=RISKS.index)


def estimate(
    run: LiveRun,
    step: JointStep,
    facts: Mapping[str, SeenFact],
    declared: str,
    forecast: Prediction | None = None,
) -> RiskEstimate:
    """Return the estimate for a step. ``facts`` are those that the run senses, by ``SB/digit``."""
    parts: dict[str, float] = {"declared": DECLARED[declared]}
    reasons = [f"its risk is {declared}" if declared else "no risk is declared for it"]
    tried = [outcome for edge, outcome in run.history if edge == step.asked.text]
    failed = tried.count("failed")
    if failed:
        parts["failures"] = failed / len(tried)
        reasons.append(f"it failed {failed} of {len(tried)} times in this run")
    if forecast is not None and forecast.verdict == DIFFERS:
        parts["forecast"] = 1.0
        reasons.append(f"its forecast differs: {forecast.reason}")
    away, name = _hazard(run, step)
    if name:
        parts["hazard"] = 0.5**away
        words = "1 fact" if away == 1 else f"{away} facts"
        reasons.append(f"the hazard {name} is {words} away")
    oldest = max((one.age / one.limit for one in facts.values() if one.limit > 0), default=0.0)
    if oldest > 0:
        parts["age"] = min(round(oldest, 4), 1.0)
        reasons.append(f"the oldest fact has {min(oldest, 1.0):.0%} of its largest age")
    return RiskEstimate(combined(parts, weights_of(run.blueprint)), parts, tuple(reasons))


def seen_facts(run: LiveRun) -> dict[str, SeenFact]:
    """Return each sensed fact with the age of its oldest source, by ``SB/digit``."""
    ages: dict[FactKey, tuple[float, float]] = {}
    for source in run.senses.sources:
        limit = float("inf") if source.limit is None else source.limit
        age, before = source.said.age, ages.get(source.fact, (0.0, 0.0))
        if source.fact not in ages or age / limit > before[0] / before[1]:
            ages[source.fact] = age, limit
    readings = run.senses.scene.readings
    return {
        f"{Address(key[0])}/{key[1]}": SeenFact(readings[key].value, *ages.get(key, (0.0, 0.0)))
        for key in run.senses.sensed
    }


def _hazard(run: LiveRun, step: JointStep) -> tuple[int, str]:
    """Return how many facts of the nearest hazard do not hold where the step leads, and its name.

    It needs at least so many operations, because one operation changes one fact or several.
    """
    found: list[tuple[int, str]] = []
    there = {**run.configuration, **{edge.branch: edge.target for edge in step.edges}}
    for hazard in run.hazards:
        open_ones = sum(not _holds(run, there, key, value) for key, value in hazard.facts)
        found.append((max(open_ones, 1), hazard.name))
    return min(found, default=(0, ""))


def _holds(run: LiveRun, there: Mapping[str, str], fact: FactKey, value: str) -> bool:
    branch, digit = fact
    return run.blueprint[branch].facts(there[branch])[digit] == value


def _risk(run: LiveRun, address: Address) -> str:
    branch = run.blueprint[address.branch]
    return branch.operation_note(address.state, address.operation).risk or ""
