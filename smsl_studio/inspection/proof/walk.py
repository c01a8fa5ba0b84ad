"""Walks through sets of configurations: of all runs through them the first by its addresses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.graph.joint.goals import FoundRun
from smsl_studio.graph.joint.products import TooLarge
from smsl_studio.graph.joint.reach import JointReach
from smsl_studio.inspection.proof.many_starts import ManyStarts, MarkedSet
from smsl_studio.inspection.proof.space import Space
from smsl_studio.stop import heed


def walked(space: Space, reach: JointReach, ways: Sequence[int], during: bool = False) -> FoundRun:
    """Return the run from the start through some sets of ``reach``, one operation for each after
    the first. ``space`` makes the steps one by one. ``during`` is handed on. TooLarge if a run may
    begin in many configurations, and they are too many.
    """
    if reach.steps.failed:
        if during:
            raise TooLarge("an operation from many starts that passes something")
        return ManyStarts(reach).run([MarkedSet(one, 0) for one in ways])
    here = space.whole(space.start())
    path: list[Address] = []
    for goals in ways[1:]:
        address, step = _first(space, here, reach, goals)
        path.append(address)
        here = {**here, **step.after}
    return FoundRun(path, here, during)


def _first(
    space: Space, here: Mapping[str, str], reach: JointReach, goals: int
) -> tuple[Address, JointStep]:
    """Return the first operation by its address that leads into a set."""
    for address in space.operations(here):
        heed()
        step = space.joint_step(here, address)
        if step is not None and reach.has(goals, {**here, **step.after}):
            return address, step
    raise AssertionError("a way in the diagram is none of the stepper")
