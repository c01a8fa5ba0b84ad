"""Why each edge out of the active states does not help, for a run without a route."""

from __future__ import annotations

from .course import Course
from .elements import Edge
from .errors import Unavailable
from .guards import refusals
from .hazards import objection
from .live import LiveRun
from .needed import of_step

MOST = 200
"""The largest number of edges that are told."""


def details(run: LiveRun, course: Course) -> list[str]:
    """Return a sentence for each edge out of the active states, bases first."""
    edges = course.planner.stepper.edges
    every = [e for n in run.hierarchy.order for e in edges.out(n, run.configuration[n])]
    told = [f"{edge}: {_hindrance(run, course, edge)}" for edge in every[:MOST]]
    more = len(every) - len(told)
    return [*told, f"and {more:,} more operations"] if more else told


def _hindrance(run: LiveRun, course: Course, edge: Edge) -> str:
    step = course.asked(run.configuration, edge)
    if isinstance(step, Unavailable):
        return "; ".join(step.reasons)
    found = objection(run, step.asked, step.actions)
    reasons = refusals(run, step) or ([found.sentence] if found is not None else [])
    if reasons and not of_step(run, step):
        return "; ".join(reasons)
    if edge.address in course.closed:
        return f"it is {course.closed[edge.address]}"
    if edge.fails:
        return f"no route uses it, it leads into a failure: {edge.fails}"
    roots = {root for branch, _ in course.goals for root in run.hierarchy.roots_of(branch)}
    if not any(edge.branch in run.hierarchy.tree(root) for root in roots):
        return f"possible, but no goal moves {edge.branch}"
    return f"possible, but no way leads on from {edge.target}"
