"""Turns the run that a search has found into a counterexample, with all SBs in file order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.properties.meaning import Meaning
from smsl_studio.graph.joint.goals import FoundRun
from smsl_studio.inspection.proof.space import Space
from smsl_studio.inspection.proof.verdict import Counterexample
from smsl_studio.stop import heed

MOST_CARRIED = 1_000
"""A run of at most so many operations is checked step by step before it is shown."""


def at_start(space: Space) -> Counterexample:
    """Return the run that has no operation: it ends where it starts."""
    start = space.in_order(space.whole(space.start()))
    return Counterexample(start, (), start)


def told(space: Space, run: FoundRun, meaning: Meaning | None = None) -> Counterexample:
    """Return a run with all SBs at its start and at its end.

    ``space`` computes the steps. ``run`` has only the SBs that were searched. If ``run.during`` is
    True, one operation is added at the end: the first one by its address that passes through a
    configuration that meets ``meaning``.
    """
    start = {**space.whole(space.start()), **(run.start or {})}
    here = {**start, **run.end}
    if len(run.path) <= MOST_CARRIED:
        _carry_out(space, start, run.path, here)
    if not run.during:
        return Counterexample(space.in_order(start), tuple(run.path), space.in_order(here))
    assert meaning is not None
    test = space.test(meaning)
    for address in space.operations(here):
        step = space.joint_step(here, address)
        if step is None:
            continue
        now = dict(here)
        for action, following in zip(step.actions, step.actions[1:], strict=False):
            now.update(action.moved)
            if test(space.key(now)):
                end, during = space.in_order(now), following.edge.address
                return Counterexample(space.in_order(start), (*run.path, address), end, during)
    raise AssertionError("what passes in the search does not with the stepper")


def _carry_out(
    space: Space, start: Mapping[str, str], path: Sequence[Address], end: Mapping[str, str]
) -> None:
    """Check that the run is possible, step by step. If it is not, this program has a fault."""
    here = dict(start)
    for address in path:
        heed()
        step = space.joint_step(here, address)
        assert step is not None, f"{address} is no step"
        here.update(step.after)
    assert here == end, "the run leads elsewhere"
