"""Explores the coupled SBs as one set, where their configurations are too many to be stored."""

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
    """The numbers of configurations and of traps, and the nearest traps with shortest ways."""

    configurations: int
    traps: int
    nearest: tuple[tuple[dict[str, str], Path], ...]


def counted(hierarchy: Hierarchy, most: int) -> CountedSet:
    """Count what the SBs reach together, with at most ``most`` traps.

    TooLarge if that takes too much, or if a base and a sub-SB disagree. RunRefused if there is no
    start.
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
    """Raise TooLarge if a digit is on and its sub-SB not in ACTIVATING, or the reverse."""
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
    """Yield the nearest configurations of a set with their ways, layer by layer."""
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
