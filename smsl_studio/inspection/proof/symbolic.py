"""Answers from all configurations at once: what can be reached is one set (a decision diagram)."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.properties.meaning import Joined, Meaning, States, branches_in
from smsl_studio.graph.joint.diagram import MOST_WORK
from smsl_studio.graph.joint.goals import FoundRun, SearchGoals
from smsl_studio.graph.joint.joint_steps import JointSteps
from smsl_studio.graph.joint.products import JointBox, TooLarge
from smsl_studio.graph.joint.reach import JointPaths, JointReach
from smsl_studio.inspection.proof.armed import ArmedSearch
from smsl_studio.inspection.proof.kinds import Answer
from smsl_studio.inspection.proof.space import Space
from smsl_studio.inspection.proof.told import at_start, told
from smsl_studio.inspection.proof.verdict import FAILS, HOLDS
from smsl_studio.inspection.proof.walk import walked

SOON, SHARE = 100_000, 10
"""A shortest run is first searched with diagrams, and then in arrays. The diagrams may take
``SOON`` looks at nodes, and one more for each ``SHARE`` configurations."""

STEPS, A_STEP = 80, 20_000
"""The diagrams may also take ``STEPS`` steps, or one step for each ``A_STEP`` configurations if
that is more. For long runs arrays are quicker."""

MOST_BOXES = 512
"""The largest number of boxes for the goals of a search in arrays."""


class SymbolicSpace:
    """Answers whether a property holds, with the set of all reachable configurations.

    ``steps`` has the steps of the blueprint, or of a part of it that does not depend on the rest.
    ``space`` computes single steps. With ``soon`` the diagram is given up early if arrays can
    answer. TooLarge if an answer needs too much work.
    """

    engine, bound = "diagram", ""

    def __init__(self, space: Callable[[], Space], steps: JointSteps, soon: bool) -> None:
        self._space = space
        try:
            self._reach = JointReach(steps, soon)
        except RecursionError as error:
            raise TooLarge("the depth of a diagram") from error

    @property
    def count(self) -> int:
        """The number of configurations that can be reached."""
        return self._reach.count

    def reachable(self, meaning: Meaning) -> Answer:
        """Answer ``reachable F``."""
        self._reach.diagram.renew()
        if self._reach.can_meet(self._reach.meant(meaning)):
            return Answer(HOLDS)
        return Answer(FAILS, at_start(self._space()))

    def never(self, meaning: Meaning, shown: bool = True) -> Answer:
        """Answer ``never F``. Without ``shown`` no run is looked for, here and below."""
        reach = self._reach
        reach.diagram.renew()
        wanted = reach.meant(meaning)
        passing = reach.passing(wanted, set(branches_in(meaning)))
        if not passing and not reach.can_meet(wanted):
            return Answer(HOLDS)
        if not shown:
            return Answer(FAILS)
        run = self._shortest(reach.paths, wanted, passing)
        return Answer(FAILS, told(self._space(), run, meaning))

    def before(self, first: Meaning, second: Meaning, shown: bool = True) -> Answer:
        """Answer ``before [F, G]``."""
        reach = self._reach
        reach.diagram.renew()
        top = reach.diagram.height - 1
        may = reach.steps.boxes(first, False)
        paths = reach.avoiding(may)
        hits = reach.diagram.without(reach.meant(second), reach.meant(first), top)
        if not reach.diagram.both(paths.reached(), hits, top):
            return Answer(HOLDS)
        if not shown:
            return Answer(FAILS)
        return Answer(FAILS, told(self._space(), self._shortest(paths, hits, may=may)))

    def after(self, first: Meaning, second: Meaning, shown: bool = True) -> Answer:
        """Answer ``after [F, G]``. The engine must have only the steps that a route may take."""
        reach, diagram = self._reach, self._reach.diagram
        diagram.renew()
        top = diagram.height - 1
        disarming = reach.meant(second)
        arming = diagram.without(reach.meant(first), disarming, top)
        begun = diagram.both(arming, reach.whole, top)
        paths = reach.avoiding(reach.steps.boxes(second, False))
        goal = diagram.without(reach.meant(goal_of(reach.steps.numbers.hierarchy)), disarming, top)
        if not diagram.both(paths.reached_from(begun), goal, top):
            return Answer(HOLDS)
        if not shown:
            return Answer(FAILS)
        run = ArmedSearch(reach, arming, disarming, goal).run(self._space())
        return Answer(FAILS, told(self._space(), run))

    def way_back(
        self, first: Meaning, second: Meaning, within: int | None, shown: bool = True
    ) -> Answer:
        """Answer ``way_back``. The engine must have only the steps that a route may take."""
        reach = self._reach
        reach.diagram.renew()
        top = reach.diagram.height - 1
        good = reach.diagram.both(reach.meant(second), reach.whole, top)
        back = reach.paths.leading_to(good, within)
        some = reach.diagram.both(reach.meant(first), reach.whole, top)
        lost = reach.diagram.without(some, back, top)
        if not lost:
            return Answer(HOLDS)
        if not shown:
            return Answer(FAILS)
        return Answer(FAILS, told(self._space(), self._shortest(reach.paths, lost)))

    def _shortest(
        self, paths: JointPaths, hits: int, passing: int = 0, may: list[JointBox] | None = None
    ) -> FoundRun:
        """Return the shortest run to a configuration of ``hits`` or ``passing``.

        If ``may`` is given, only configurations of ``may`` are left by a step. Diagrams are tried
        first, because they are fast for short runs.
        """
        diagram, count = self._reach.diagram, self._reach.count
        diagram.allow(min(SOON + count // SHARE, 4 * MOST_WORK))
        steps = max(STEPS, count // A_STEP)
        with suppress(TooLarge):
            return walked(self._space(), self._reach, *paths.nearest(hits, passing, steps))
        diagram.allow()
        with suppress(TooLarge):
            if self._reach.steps.failed:
                raise TooLarge("arrays with many starts")
            wanted, passed = (diagram.boxes(one, MOST_BOXES) for one in (hits, passing))
            found = self._reach.in_arrays(SearchGoals(wanted, passed, may))
            if found is not None:
                return found
        diagram.allow()
        return walked(self._space(), self._reach, *paths.nearest(hits, passing))


def goal_of(hierarchy: Hierarchy) -> Meaning:
    """Return the condition that every SB without a base is in ACTIVATING."""
    blueprint = hierarchy.blueprint
    ends = [(root, blueprint[root].activating) for root in hierarchy.roots]
    return Joined(
        True,
        tuple(
            States(root, frozenset({state} if state in blueprint[root].table else ()))
            for root, state in ends
        ),
    )
