"""The cone of influence of a question: the SBs that can change its answer.

All other SBs are left out of the search. What is left out is one of two kinds:

- SBs that share no base, no sub-SB and no ``requires`` with the question. They stand still.
- *Quiet* sub-SBs: one base, no ``requires`` in it, below it or about it, and a way to ACTIVATING
  from every state and back to INITIAL. Whatever such a sub-SB does, its base can do each of its
  own steps, and a crossing of the sub-SB does to the others what the base's own edge does. So it is
  enough to know whether its digit is on.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.stop import heed


@dataclass(frozen=True)
class Cone:
    """The SBs that a question looks at (``kept``) and the quiet sub-SBs beside them."""

    kept: frozenset[str]
    quiet: frozenset[str] = frozenset()


def cone_of(stepper: Stepper, wanted: Collection[str], routed: bool) -> Cone:
    """Return the cone of a question about the SBs ``wanted``.

    With ``routed`` the steps are those that a route may take, and SBs with failure states are never
    quiet: a ``load`` edge depends on them.
    """
    near = _near(stepper, wanted)
    hierarchy, blueprint = stepper.hierarchy, stepper.hierarchy.blueprint
    asked = {
        required for name in near for required in stepper.edges.required_by(name)
    }  # whose facts matter
    quiet: set[str] = set()
    for name in reversed(hierarchy.order):
        heed()
        branch = blueprint[name]
        if (
            name in near
            and name not in wanted
            and name not in asked
            and len(hierarchy.bases[name]) == 1
            and all(sub in quiet for _, sub in hierarchy.subs[name])
            and not any(note.requires for note in branch.notes.operations.values())
            and not (routed and failing_states(branch))
            and _can_always(stepper, name)
        ):
            quiet.add(name)
    return Cone(frozenset(near - quiet), frozenset(quiet))


def _near(stepper: Stepper, wanted: Collection[str]) -> set[str]:
    """Return the SBs that are joined with the question by bases, sub-SBs and required facts."""
    hierarchy = stepper.hierarchy
    found, waiting = set(wanted), list(wanted)
    while waiting:
        heed()
        name = waiting.pop()
        bases = (base for base, _ in hierarchy.bases[name])
        subs = (sub for _, sub in hierarchy.subs[name])
        for other in (*bases, *subs, *stepper.edges.required_by(name)):
            if other not in found:
                found.add(other)
                waiting.append(other)
    return found


def _can_always(stepper: Stepper, name: str) -> bool:
    """Whether an SB whose sub-SBs are quiet gets to ACTIVATING from all its states, and back."""
    branch = stepper.hierarchy.blueprint[name]
    start, end = branch.initial, branch.activating
    if start == end or start not in branch.table or end not in branch.table:
        return False
    up, down = stepper.downhill(name, end).far, stepper.downhill(name, start).far
    return len(up) == len(branch.table) and end in down
