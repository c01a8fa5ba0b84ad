"""Finds the steps of a run that is given by labels of operations."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.views.claim_run import RunStep
from smsl_studio.inspection.equivalence.transitions import label_of
from smsl_studio.inspection.explorer.onward import ConfigurationWalk


def labelled_run(
    blueprint: Blueprint,
    labels: Sequence[str],
    label: Callable[[Address], str] | None = None,
) -> tuple[RunStep, ...]:
    """Return the start, and one step for each label.

    Each step takes the first permitted operation with the label. If there is none, the result ends
    there. ``label`` gives the label of an operation; None means its name, with its SB if there are
    several SBs. RunRefused if there is no start.
    """
    several = len(blueprint.branches) > 1
    named = label or (lambda address: label_of(address, several))
    walk = ConfigurationWalk(blueprint)
    here = walk.start()
    found = [RunStep(None, here)]
    for wanted in labels:
        steps = (one for one in walk.steps(here) if one.permitted)
        step = next((one for one in steps if named(one.address) == wanted), None)
        if step is None:
            break
        after = {**here, **step.after}
        moved = frozenset(name for name in after if after[name] != here[name])
        found.append(RunStep(step.address, after, moved, step.edges))
        here = after
    return tuple(found)
