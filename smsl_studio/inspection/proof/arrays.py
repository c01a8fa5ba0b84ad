"""Answers questions from arrays of all configurations.

It is for spaces that are too irregular for a diagram.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import TYPE_CHECKING

from smsl_studio.blueprint.properties.meaning import Meaning, branches_in
from smsl_studio.graph.joint.goals import FoundRun, SearchGoals
from smsl_studio.graph.joint.joint_steps import MOST_BOXES, JointSteps
from smsl_studio.graph.joint.products import JointBox, TooLarge
from smsl_studio.inspection.proof.kinds import Answer
from smsl_studio.inspection.proof.space import Space
from smsl_studio.inspection.proof.told import at_start, told
from smsl_studio.inspection.proof.verdict import FAILS, HOLDS, UNKNOWN

if TYPE_CHECKING:
    from smsl_studio.graph.joint.array_runs import ArrayReach

MOST_PASSED = 512
"""The largest number of boxes for the configurations that steps pass through."""


class ArraySpace:
    """Answers whether a property holds. All questions share the arrays; the first question makes
    them.

    ``steps`` has the steps of the blueprint, or of a part of it that does not depend on the rest.
    ``space`` computes single steps. Every answer raises TooLarge if it needs too much memory or
    work.
    """

    engine = "arrays"

    def __init__(self, space: Callable[[], Space], steps: JointSteps) -> None:
        self._space, self._steps = space, steps

    @cached_property
    def _reach(self) -> ArrayReach | None:
        # Only this needs numpy, so it is loaded here.
        from smsl_studio.graph.joint.array_runs import ArrayReach

        try:
            return ArrayReach(self._steps)
        except TooLarge:
            return None

    def forget(self) -> None:
        """Free the memory of the arrays. The next question makes them again."""
        self.__dict__.pop("_reach", None)

    @property
    def count(self) -> int:
        """The number of configurations in the arrays."""
        return self._reach.count if self._reach else 0

    @property
    def bound(self) -> str:
        """The bound that ended the search. It is empty if the arrays have all configurations."""
        return self._reach.bound if self._reach else ""

    def reachable(self, meaning: Meaning) -> Answer:
        """Answer ``reachable F``."""
        if self._nearest(SearchGoals(self._steps.boxes(meaning, True))) is not None:
            return Answer(HOLDS)
        return Answer(UNKNOWN) if self.bound else Answer(FAILS, at_start(self._space()))

    def never(self, meaning: Meaning) -> Answer:
        """Answer ``never F``."""
        goals = SearchGoals(self._steps.boxes(meaning, True), self._passing(meaning))
        return self._answer(self._nearest(goals), meaning)

    def before(self, first: Meaning, second: Meaning) -> Answer:
        """Answer ``before [F, G]``."""
        from smsl_studio.graph.joint.array_runs import shortest_run

        may = self._steps.boxes(first, False)
        diagram = self._steps.diagram()
        wanted, not_yet = (self._steps.meant(diagram, one) for one in (second, first))
        hits = diagram.without(wanted, not_yet, diagram.height - 1)
        run = shortest_run(self._steps, SearchGoals(diagram.boxes(hits, MOST_BOXES), (), may))
        return Answer(HOLDS) if run is None else Answer(FAILS, told(self._space(), run))

    def _nearest(self, goals: SearchGoals) -> FoundRun | None:
        if self._reach is None:
            raise TooLarge("arrays")
        return self._reach.nearest(goals)

    def _answer(self, run: FoundRun | None, meaning: Meaning) -> Answer:
        if run is not None:
            return Answer(FAILS, told(self._space(), run, meaning))
        return Answer(UNKNOWN if self.bound else HOLDS)

    def _passing(self, meaning: Meaning) -> list[JointBox]:
        """Return the configurations from which one step passes through one that meets the
        condition.
        """
        diagram = self._steps.diagram()
        wanted = self._steps.meant(diagram, meaning)
        everything = diagram.box({})
        found = self._steps.passing(diagram, wanted, set(branches_in(meaning)), everything)
        return diagram.boxes(found, MOST_PASSED)
