"""Runs that a search has found, as counterexamples: with all SBs, in the order of the file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.properties.meaning import Meaning
from smsl_studio.graph.joint.goals import FoundRun
from smsl_studio.inspection.proof.space import Space
from smsl_studio.inspection.proof.verdict import Counterexample
from smsl_studio.stop import heed

MOST_CARRIED = 1_000
"""A run of up to so many operations is carried out by the steps of a run before it is shown."""


def at_start(space: Space) -> Counterexample:
    """Return the run without an operation."""
    start = space.in_order(space.whole(space.start()))
    return Counterexample(start, (), start)


def told(space: Space, run: FoundRun, meaning: Meaning | None = None) -> Counterexample:
    """Return a run with its start and its end.

    ``space`` makes the steps. ``run`` tells of the SBs that move alone. If something passed is
    meant, the first operation by its address that passes ``meaning`` is the last of the run.
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
    """Refuse to show a run that the steps of a run do not lead along: that is a fault of ours."""
    here = dict(start)
    for address in path:
        heed()
        step = space.joint_step(here, address)
        assert step is not None, f"{address} is no step"
        here.update(step.after)
    assert here == end, "the run leads elsewhere"
