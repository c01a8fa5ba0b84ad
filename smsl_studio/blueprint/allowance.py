"""How much work a plan may take: counted, never timed, over all levels of sub-SBs together.

Work is counted in edges that a search looks at, each times the size of a joint configuration. The
outcome of a part is kept, and others use it later; whoever uses it is charged for its work all the
same. So what is refused depends on the question alone, and not on what was asked before.
"""

from __future__ import annotations

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.errors import PlanningError

MOST_WORK = 6_000_000
"""The most work that a plan may take, besides ``PER_EDGE`` times the size for every edge."""

PER_EDGE = 8

MOST_CARRIED = 5_000
"""One joint step has at most so many operations."""

LESS = "Name a nearer goal, or use fewer levels of sub-SBs, or fewer requires."


class Part:
    """Work that is done once: the search for one way of a sub-SB."""

    def __init__(self) -> None:
        self.own = 0
        self.used: set[Part] = set()


class Allowance:
    """What is left for one question; PlanningError where it does not suffice."""

    def __init__(self, hierarchy: Hierarchy) -> None:
        self.size = 16 + len(hierarchy.order)
        self.most = MOST_WORK + PER_EDGE * self.size * hierarchy.blueprint.operation_count
        self.spent = 0
        self._charged: set[Part] = set()

    def spend(self, edges: int, part: Part | None = None) -> None:
        """Count so many edges as looked at, for a part or for the question itself."""
        work = (1 + edges) * self.size
        self._take(work)
        if part is not None:
            part.own += work

    def use(self, part: Part, by: Part | None) -> None:
        """Count a part that another part, or the question itself, uses."""
        if by is not None:
            by.used.add(part)
        waiting = [part]
        while waiting:
            one = waiting.pop()
            if one not in self._charged:
                self._take(one.own)
                self._charged.add(one)
                waiting += one.used

    def _take(self, work: int) -> None:
        if self.spent + work > self.most:
            raise PlanningError(
                "planning was given up: the sub-SBs can stand together in too many ways",
                advice=LESS,
            )
        self.spent += work


def refuse_too_many_carried(asked: object, count: int) -> None:
    """PlanningError for a joint step with too many operations."""
    if count > MOST_CARRIED:
        raise PlanningError(
            f"{asked} would take more than {MOST_CARRIED:,} operations with those of the sub-SBs",
            advice=LESS,
        )
