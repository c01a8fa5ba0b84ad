"""Explores coupled SBs as one set of configurations, if there are too many to store each."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.graph.joint.joint_steps import JointSteps
from smsl_studio.graph.joint.products import TooLarge
from smsl_studio.graph.joint.reach import JointReach
from smsl_studio.inspection.explorer.part import Path, configuration_of
from smsl_studio.inspection.proof.space import Space
from smsl_studio.inspection.proof.walk import walked


class CountedSet(NamedTuple):
    """How many configurations and traps there are, and the shortest runs to the nearest traps."""

    configurations: int
    traps: int
    nearest: tuple[tuple[dict[str, str], Path], ...]


def counted(hierarchy: Hierarchy, most: int) -> CountedSet:
    """Count the configurations that the coupled SBs can reach. List at most ``most`` traps.

    TooLarge if that needs too much work, or if a base and its sub-SB can disagree. RunRefused if
    there is no start.
    """
    try:
        reach = JointReach(JointSteps(hierarchy))
        _refuse_disagreement(hierarchy, reach)
        diagram, top = reach.diagram, reach.diagram.height - 1
        numbers, blueprint = reach.steps.numbers, hierarchy.blueprint
        ends = {
            numbers.at[root]: {numbers.number[numbers.at[root]].get(blueprint[root].activating, -1)}
            for root in hierarchy.roots
        }
        goal = diagram.both(diagram.box(ends), reach.whole, top)
        traps = diagram.without(reach.whole, reach.paths.leading_to(goal, None), top)
        return CountedSet(
            reach.count, diagram.count(traps), tuple(_nearest(hierarchy, reach, traps, most))
        )
    except RecursionError as error:
        raise TooLarge("the depth of a diagram") from error


def _refuse_disagreement(hierarchy: Hierarchy, reach: JointReach) -> None:
    """Raise TooLarge if a base and its sub-SB can disagree.

    They disagree if the digit is on but the sub-SB is not in ACTIVATING, or the other way round.
    """
    numbers, blueprint = reach.steps.numbers, hierarchy.blueprint
    for base in hierarchy.order:
        for digit, sub in hierarchy.subs[base]:
            above, below = numbers.at[base], numbers.at[sub]
            states = blueprint[base].table
            on = {numbers.number[above][one] for one in states if blueprint[base].is_on(one, digit)}
            off = set(range(len(states))) - on
            active = {numbers.number[below].get(blueprint[sub].activating, -1)}
            others = set(range(len(numbers.states[below]))) - active
            for one, other in ((on, others), (off, active)):
                if reach.can_meet(reach.diagram.box({above: one, below: other})):
                    raise TooLarge("a list of states that disagree")


def _nearest(
    hierarchy: Hierarchy, reach: JointReach, traps: int, most: int
) -> Iterator[tuple[dict[str, str], Path]]:
    """Yield at most ``most`` traps with a shortest run to each, the nearest first."""
    if not traps:
        return
    diagram, numbers, left = reach.diagram, reach.steps.numbers, most
    space = Space(hierarchy.blueprint)
    names = [hierarchy.order[at] for at in range(len(hierarchy.order))]
    for ways, found in reach.paths.approaches(traps):
        for codes in diagram.members(found, left):
            key = tuple(numbers.states[at][code] for at, code in enumerate(codes))
            run = walked(space, reach, ways(diagram.point(codes)))
            yield dict(configuration_of(hierarchy.blueprint, names, key)), tuple(run.path)
            left -= 1
        if not left:
            return
