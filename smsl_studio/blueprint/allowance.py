"""The work that a plan may take, over all levels of sub-SBs together. It is counted and never
timed.

The unit is an edge that a search looks at, times the size of a joint configuration. The result of a
part is kept and used again, and each user is charged for its work. So a refusal depends only on the
question, and not on earlier questions.
"""

from __future__ import annotations

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.errors import PlanningError

MOST_WORK = 6_000_000
"""The work that a plan may take, besides ``PER_EDGE`` times the size for every edge."""

PER_EDGE = 8

MOST_CARRIED = 5_000
"""The largest number of operations in one joint step."""

LESS = "Name a nearer goal, or use fewer levels of sub-SBs, or fewer requires."


class Part:
    """Work that is done once: the search for one route of a sub-SB."""

    def __init__(self) -> None:
        self.own = 0
        self.used: set[Part] = set()


class Allowance:
    """The work that is left for one question. PlanningError if it is used up."""

    def __init__(self, hierarchy: Hierarchy) -> None:
        self.size = 16 + len(hierarchy.order)
        self.most = MOST_WORK + PER_EDGE * self.size * hierarchy.blueprint.operation_count
        self.spent = 0
        self._charged: set[Part] = set()

    def spend(self, edges: int, part: Part | None = None) -> None:
        """Add edges to the count of a part, or to that of the whole question."""
        work = (1 + edges) * self.size
        self._take(work)
        if part is not None:
            part.own += work

    def use(self, part: Part, by: Part | None) -> None:
        """Count the use of a part by another part, or by the question itself."""
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
    """Raise PlanningError if a joint step has too many operations."""
    if count > MOST_CARRIED:
        raise PlanningError(
            f"{asked} would take more than {MOST_CARRIED:,} operations with those of the sub-SBs",
            advice=LESS,
        )
