"""Finds one run through sets of configurations: the first one by its addresses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.graph.joint.goals import FoundRun
from smsl_studio.graph.joint.products import TooLarge
from smsl_studio.graph.joint.reach import JointReach
from smsl_studio.inspection.proof.armed_sets import MarkedSet
from smsl_studio.inspection.proof.many_starts import ManyStarts
from smsl_studio.inspection.proof.space import Space
from smsl_studio.stop import heed


def walked(space: Space, reach: JointReach, ways: Sequence[int], during: bool = False) -> FoundRun:
    """Return the first run by its addresses that goes through the sets ``ways``, one for each step.

    The sets belong to the diagram of ``reach``. ``space`` computes the steps. ``during`` is copied
    into the result. TooLarge if a run may begin in too many configurations.
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
    """Return the first operation by its address that leads into the set ``goals``, and its step."""
    for address in space.operations(here):
        heed()
        step = space.joint_step(here, address)
        if step is not None and reach.has(goals, {**here, **step.after}):
            return address, step
    raise AssertionError("a way in the diagram is none of the stepper")
