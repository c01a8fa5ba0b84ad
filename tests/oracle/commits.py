"""Which states are committed together, and when: clauses 1, 6, 7 and 13, and the start of a run
(3)."""

from __future__ import annotations

from tests.oracle.carriage import put_below
from tests.oracle.hazards import Facts, planned_in
from tests.oracle.situation import HAIR, Json, Situation, Step
from tests.oracle.standing import contradict, split_digits, start_of


def may_start(now: Situation) -> str:
    """Why a run must be refused at its start; empty where it must not (clauses 1, 3, 11)."""
    place = start_of(now.drawing, now.asked.get("start", {}))
    if isinstance(place, str):
        return place
    if now.asked.get("goals") and contradict(now.drawing, now.goals):
        return "the goals cannot hold together"
    for name, state in place.items():
        if now.scene.check(name, state, place) is not True:
            return f"{name}/{state} does not check true"
    if planned_in(now.drawing, place) or any(
        Facts(now.drawing, now.scene, place, (), {}).met().values()
    ):
        return "a hazard is met"
    return ""


def run_started(now: Situation, event: Json) -> None:
    """The start: bases first, every state check true."""
    place = start_of(now.drawing, now.asked.get("start", {}))
    if not isinstance(place, str) and event["start"] != place:
        now.broken(3, f"it starts in {event['start']} and not in {place}")
    now.configuration = dict(event["start"])
    why = may_start(now)
    if why:
        clause = 11 if "goals" in why else 16 if "hazard" in why else 3
        now.broken(clause, f"it starts although {why}")
    _is_whole(now)
    if list(event["goals"]) != now.goals:
        now.broken(11, f"its goals are {event['goals']} and not {now.goals}")
    now.happened()


def _is_whole(now: Situation) -> None:
    """Clause 1 holds in every configuration that is committed."""
    split = split_digits(now.drawing, now.configuration)
    if split:
        now.broken(1, f"{', '.join(split)} and the sub-SB do not agree in {now.configuration}")


def committed(now: Situation, event: Json) -> None:
    """Edges became true together."""
    group = frozenset(event["operations"])
    step = now.step
    now.happened()
    if step is None:
        now.broken(6, f"{', '.join(sorted(group))} are committed, and no step is under way")
        now.configuration.update(event["configuration"])
        _is_whole(now)
        return
    _is_due(now, step, group)
    for edge in sorted(group):
        if edge not in step.started:
            now.broken(5, f"{edge} is committed and was never told to begin")
    before = dict(now.configuration)
    _has_ended(now, step, group)
    now.configuration.update(event["configuration"])
    for name in event["configuration"]:
        step.pending.pop(name, None)
    _leads_there(now, step, group, before)
    _is_whole(now)
    _checks(now, group)
    step.commits.append(group)
    now.vetoed = set()
    if step.endangered:
        now.broken(16, f"{', '.join(sorted(group))} are committed: {step.endangered} is met")
    if step.broken:
        now.broken(9, f"{', '.join(sorted(group))} are committed although {step.broken}")
    if step.complete:
        now.step = None
        now.agreed = []


def _is_due(now: Situation, step: Step, group: frozenset[str]) -> None:
    """Clause 6: which edges become true together, and in which order."""
    if step.plan is None:
        return
    due = step.plan.all_commits
    number = len(step.commits)
    wanted = due[number] if number < len(due) else frozenset()
    if group != wanted:
        now.broken(
            6, f"{sorted(group)} are committed where {sorted(wanted)} are due in {step.edge}"
        )
        step.plans = []


def _has_ended(now: Situation, step: Step, group: frozenset[str]) -> None:
    """Clause 7: every function returned, and the world has settled since the last one."""
    for edge in sorted(group):
        if step.running == edge:
            now.broken(7, f"{edge} is committed while its function runs")
        if edge in step.ended and step.ended[edge][0] != "returned":
            now.broken(7, f"{edge} is committed, but its function {step.ended[edge][0]}")
        owes = now.terms.own_function(edge) and edge not in step.ended
        if owes:
            now.broken(5, f"{edge} is committed, and its function never ran")
        people = now.drawing.level(edge) == "human" and now.terms.own_function(edge)
        if people and ("operation", edge, "done") not in now.agreed:
            now.broken(7, f"{edge} is committed, and nobody said that it was done")
    ends = [at for edge, (_, at) in step.ended.items() if edge in group]
    if ends and now.now < max(ends) + now.settle - HAIR:
        now.broken(7, f"{sorted(group)} are committed before the world has settled")


def _leads_there(now: Situation, step: Step, group: frozenset[str], before: dict[str, str]) -> None:
    """The configuration after a commit is where its edges lead, each SB by its own edges."""
    there = dict(before)
    for edge in [*step.started]:
        if edge in group:
            name = edge.split("/", 1)[0]
            there[name] = now.drawing.edges[edge][1]
            if now.drawing.kind(edge) == "load":
                put_below(now.drawing, edge, there)
    if there != now.configuration:
        wrong = {n: s for n, s in now.configuration.items() if there[n] != s}
        now.broken(6, f"{sorted(group)} lead elsewhere than to {wrong}")


def _checks(now: Situation, group: frozenset[str]) -> None:
    """Clause 7 and 13: the state check of every target is true on sensed facts."""
    for name in sorted({edge.split("/", 1)[0] for edge in group}):
        state = now.configuration[name]
        result = now.scene.check(name, state, now.configuration)
        if result is not True:
            word = {False: "false", None: "unknown"}[result]
            clause = 7 if result is False else 13
            now.broken(clause, f"{sorted(group)} are committed, and {name}/{state} checks {word}")
    if now.read[0] < now.moment:
        now.broken(7, f"{sorted(group)} are committed without a reading in that tick")
