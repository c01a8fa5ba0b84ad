"""Routes, goals and ends of runs: clauses 9 (the end), 11 and 12."""

from __future__ import annotations

from tests.oracle import danger
from tests.oracle.route import as_own_steps, cost_of, edges_of, route_to
from tests.oracle.search import Carriage
from tests.oracle.situation import HAIR, Json, Situation
from tests.oracle.standing import Configuration


def planned(now: Situation, event: Json) -> None:
    """A route to a goal: it costs what the cheapest costs, and ties are broken as they should."""
    goal = event["goal"]
    if goal not in now.goals or now.drawing.can_fail or now.has_vetoes:
        return
    cost, edges = event["cost"], list(event["operations"])
    ways = _routes(now, goal)
    fitting = [way for way in ways if abs(cost_of(way) - cost) < HAIR]
    if not fitting:
        costs = sorted({cost_of(way) for way in ways})
        clause = 16 if now.drawing.hazards else 12
        now.broken(clause, f"the route to {goal} costs {cost:g}, the cheapest {costs}: {edges}")
        return
    name = goal.split("/", 1)[0]
    counts = [len(_of(name, edges_of(way))) for way in fitting]
    if len(_of(name, edges)) not in counts:
        now.broken(12, f"the route to {goal} has not the fewest edges of {name}: {edges}")
        return
    _first_by_name(now, goal, edges)


def _of(name: str, edges: list[str]) -> list[str]:
    return [edge for edge in edges if edge.startswith(f"{name}/")]


def _first_by_name(now: Situation, goal: str, edges: list[str]) -> None:
    """Of routes that ask for edges of the routed SB alone, the first by their addresses is taken.

    Where subs are asked directly as well, docs/running.md does not say what is compared.
    """
    name = goal.split("/", 1)[0]
    own = as_own_steps(now.terms, now.configuration, name, edges)
    before = _before(now, goal)
    best = route_to(now.terms, now.configuration, [*before, goal], [goal], name)
    if own is None or best is None:
        return
    cheapest = route_to(now.terms, now.configuration, [*before, goal], [goal])
    first = [step.edge for step in best]
    same = cheapest is not None and cost_of(best) == cost_of(cheapest)
    if same and len(first) == len(own) and first != own:
        now.broken(12, f"the route to {goal} is {own}; of equal cost {first} comes first")


def _before(now: Situation, goal: str) -> list[str]:
    """The goals before this one that hold: its leg keeps them."""
    return [one for one in now.goals[: now.goals.index(goal)] if holds(now.configuration, one)]


def _routes(now: Situation, goal: str) -> list[tuple[Carriage, ...]]:
    """The legs that may be planned now for a goal: keeping what holds before it, or all at once."""
    here = now.configuration
    found = [
        route_to(now.terms, here, [*_before(now, goal), goal], [goal]),
        route_to(now.terms, here, now.goals, now.goals),
    ]
    return [way for way in found if way is not None]


def holds(configuration: Configuration, goal: str) -> bool:
    """Whether the active state of an SB is a goal."""
    name, state = goal.split("/", 1)
    return configuration[name] == state


def goal_reached(now: Situation, goals: list[str], word: str) -> None:
    """Clause 9, the end: a fresh check of every goal is true, on readings later than the last
    thing that happened; nothing holds the run meanwhile."""
    for goal in goals:
        name, state = goal.split("/", 1)
        if not holds(now.configuration, goal):
            now.broken(9, f"{word} is told, and {name} is believed in {now.configuration[name]}")
        result = now.scene.check(name, state, now.configuration)
        if result is not True:
            known = {False: "false", None: "unknown"}[result]
            now.broken(9, f"{word} is told, and {goal} checks {known}")
    if any(danger.met(now).values()):
        now.broken(16, f"{word} is told while a hazard is met")
    if now.read <= now.last_thing or now.read_at <= now.last_thing_at:
        now.broken(9, f"{word} is told without a reading since the last thing that happened")
    if now.latched in ("held", "stopped", "taken over"):
        now.broken(9, f"{word} is told while the run is {now.latched}")
    if now.step is not None:
        now.broken(9, f"{word} is told while {now.step.edge} is under way")


def finished(now: Situation, event: Json) -> None:
    """The last event, and whether its reason is so."""
    reason = event["reason"]
    if not now.configuration:
        return
    if event["configuration"] != now.configuration:
        now.broken(6, f"it ends in {event['configuration']}, committed is {now.configuration}")
    if reason == "goal_reached":
        goal_reached(now, now.goals, "the end goal_reached")
    elif reason == "refused":
        now.broken(3, "it is refused after it has started")
    elif reason == "failed":
        now.broken(7, f"it failed: {event['sentence']}")
    elif not now.disturbed and not now.drawing.peopled:
        _undisturbed(now, reason)
    now.ended = event


def _undisturbed(now: Situation, reason: str) -> None:
    """Nothing was said, disturbed or broken: where a way leads on, it is gone to its end."""
    if now.drawing.can_fail:
        return
    if all(holds(now.configuration, goal) for goal in now.goals):
        now.broken(11, f"all goals hold, and it ends {reason}")
    elif route_to(now.terms, now.configuration, now.goals, now.goals) is not None:
        now.broken(11, f"there is a way to {now.goals}, and it ends {reason}")
