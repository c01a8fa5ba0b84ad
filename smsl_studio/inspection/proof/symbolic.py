"""Answers from all configurations at once: what can be reached is one set (a decision diagram)."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.properties.meaning import Meaning, branches_in
from smsl_studio.graph.joint.products import TooLarge
from smsl_studio.graph.joint.reach import JointReach
from smsl_studio.inspection.proof.kinds import Answer
from smsl_studio.inspection.proof.space import Space, Test
from smsl_studio.inspection.proof.verdict import FAILS, HOLDS, Counterexample
from smsl_studio.stop import heed


class SymbolicSpace:
    """Answers what can happen. TooLarge if that takes too much, RunRefused if there is
    no start.
    """

    def __init__(self, hierarchy: Hierarchy) -> None:
        self._hierarchy = hierarchy
        try:
            self._reach = JointReach(hierarchy)
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
        space = Space(self._hierarchy.blueprint)
        start = space.in_order(space.whole(space.start()))
        return Answer(FAILS, Counterexample(start, (), start))

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
        ways, during = reach.paths.nearest(wanted, passing)
        space, start, path, here = self._walk(ways)
        if not during:
            return Answer(FAILS, _run(space, start, path, here))
        return Answer(FAILS, _passing(space, start, path, here, space.test(meaning)))

    def before(self, first: Meaning, second: Meaning, shown: bool = True) -> Answer:
        """Answer ``before [F, G]``."""
        reach = self._reach
        reach.diagram.renew()
        top = reach.diagram.height - 1
        paths = reach.avoiding(reach.boxes(first, False))
        hits = reach.diagram.without(reach.meant(second), reach.meant(first), top)
        if not reach.diagram.both(paths.reached(), hits, top):
            return Answer(HOLDS)
        if not shown:
            return Answer(FAILS)
        return Answer(FAILS, _run(*self._walk(paths.nearest(hits, 0)[0])))

    def way_back(
        self, first: Meaning, second: Meaning, within: int | None, shown: bool = True
    ) -> Answer:
        """Answer ``way_back`` where routes may go everywhere: nothing fails, and there is no
        hazard."""
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
        return Answer(FAILS, _run(*self._walk(reach.paths.nearest(lost, 0)[0])))

    def _walk(self, ways: list[int]) -> tuple[Space, dict[str, str], list[Address], dict[str, str]]:
        """Return the first run by its addresses through some sets, with its start and its end."""
        space = Space(self._hierarchy.blueprint)
        here = start = space.whole(space.start())
        path: list[Address] = []
        for goals in ways[1:]:
            address, step = self._first(space, here, goals)
            path.append(address)
            here = {**here, **step.after}
        return space, start, path, here

    def _first(
        self, space: Space, here: Mapping[str, str], goals: int
    ) -> tuple[Address, JointStep]:
        """Return the first operation by its address that leads into a set."""
        for address in space.operations(here):
            heed()
            step = space.joint_step(here, address)
            if step is not None and self._reach.has(goals, {**here, **step.after}):
                return address, step
        raise AssertionError("a way in the diagram is none of the stepper")


def _run(
    space: Space,
    start: Mapping[str, str],
    path: list[Address],
    end: Mapping[str, str],
    during: Address | None = None,
) -> Counterexample:
    return Counterexample(space.in_order(start), tuple(path), space.in_order(end), during)


def _passing(
    space: Space, start: Mapping[str, str], path: list[Address], here: Mapping[str, str], test: Test
) -> Counterexample:
    """Return the run that ends with the first operation that passes a condition."""
    for address in space.operations(here):
        step = space.joint_step(here, address)
        if step is None:
            continue
        now = dict(here)
        for action, following in zip(step.actions, step.actions[1:], strict=False):
            now.update(action.moved)
            if test(space.key(now)):
                return _run(space, start, [*path, address], now, following.edge.address)
    raise AssertionError("what passes in the diagram does not with the stepper")
