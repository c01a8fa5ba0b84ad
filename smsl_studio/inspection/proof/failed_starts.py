"""Further starts: configurations in which one SB has failed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from smsl_studio.blueprint.configuration import standing
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.inspection.proof.space import Key, Space
from smsl_studio.stop import heed


def failed_starts(space: Space, keys: Iterable[Key]) -> Iterator[Key]:
    """Yield each of the configurations with the active state of one SB replaced by a failure state.

    The sub-SBs of that SB stand as at a start. A base stays if it agrees, else that start is left
    out.
    """
    hierarchy, blueprint = space.hierarchy, space.blueprint
    failing = {name: tuple(failing_states(blueprint[name])) for name in space.order}
    for key in keys:
        heed()
        here = space.whole(key)
        for name, states in failing.items():
            for state in states:
                moved = standing(hierarchy, name, state)
                there = {**here, **moved}
                if all(there[sub] in blueprint[sub].table for sub in moved) and all(
                    blueprint[base].is_on(there[base], digit)
                    == (there[sub] == blueprint[sub].activating)
                    for sub in moved
                    for base, digit in hierarchy.bases[sub]
                ):
                    yield space.key(there)
