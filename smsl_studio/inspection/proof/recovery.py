"""The way out of each failure state: the nearest configuration in which nothing has failed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.meaning import Joined, Meaning, States, branches_in
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.errors import RunRefused
from smsl_studio.inspection.proof.claims import claims_of
from smsl_studio.inspection.proof.cone import cone_of
from smsl_studio.inspection.proof.exploration import Exploration
from smsl_studio.inspection.proof.kinds import steps_to
from smsl_studio.inspection.proof.space import Key, Space
from smsl_studio.inspection.proof.verdict import HAZARD
from smsl_studio.stop import BoundMet, heed


@dataclass(frozen=True)
class WayOut:
    """The operations from a failure state to where nothing has failed, and where they begin.

    ``path`` is None if there is no way, or if it was not found within ``bound``. ``start`` is None
    if no run can start in the state.
    """

    state: Address
    start: dict[str, str] | None
    path: tuple[Address, ...] | None
    bound: str = ""


def ways_out(blueprint: Blueprint, limit: int) -> tuple[WayOut, ...]:
    """Return a way with the fewest operations out of each state that holds a failure value.

    It ends where each SB is in a state without failure, or in one that is declared safe. It goes
    only where a route may go. The other SBs stand as at a start in that state. At most ``limit``
    configurations are stored. If a bound of ``stop.bounded`` is met, ``WayOut.bound`` names it.
    RunRefused if the SBs go round in a circle.
    """
    failing = [
        Address(branch.name, state) for branch in blueprint for state in failing_states(branch)
    ]
    if not failing:
        return ()
    try:
        return _ways_out(blueprint, failing, limit)
    except BoundMet as error:
        return tuple(WayOut(one, None, None, str(error)) for one in failing)


def _ways_out(blueprint: Blueprint, failing: Sequence[Address], limit: int) -> tuple[WayOut, ...]:
    hierarchy = Hierarchy(blueprint)
    starts: dict[Address, dict[str, str]] = {}
    for one in failing:
        try:
            starts[one] = start_configuration(hierarchy, {one.branch: one.state})
        except RunRefused:
            continue
    if not starts:
        return tuple(WayOut(one, None, None) for one in failing)
    hazards = (one.meanings for one in claims_of(blueprint) if one.kind == HAZARD)
    shut = [meanings[0] for meanings in hazards if meanings]
    hits = _without_failure(blueprint)
    wanted = {name for one in (*shut, hits) for name in branches_in(one)}
    cone = cone_of(Stepper(hierarchy), wanted, True)
    space = Space(blueprint, True, shut, cone, next(iter(starts.values())))
    keys = {one: space.key(start) for one, start in starts.items()}
    found = Exploration(space, limit, starts=tuple(dict.fromkeys(keys.values())))
    bound = found.bound
    paths: dict[Address, tuple[Address, ...] | None] = {}
    try:
        far = steps_to(found, hits)
        for one, key in keys.items():
            paths[one] = _path(found, far, key)
    except BoundMet as error:
        bound = bound or str(error)
    return tuple(WayOut(one, starts.get(one), paths.get(one), bound) for one in failing)


def _without_failure(blueprint: Blueprint) -> Meaning:
    """Return the condition that nothing has failed, except where a state is declared safe."""
    parts = []
    for branch in blueprint:
        failing = failing_states(branch)
        good = frozenset(
            state
            for state in branch.table
            if state not in failing or ((note := branch.state_note(state)) and note.safe)
        )
        if len(good) < len(branch.table):
            parts.append(States(branch.name, good))
    return Joined(True, tuple(parts))


def _path(found: Exploration, far: dict[int, int], key: Key) -> tuple[Address, ...] | None:
    """Return the shortest way from a start; of equally short ones the first by its addresses."""
    node = found.number(key)
    if node not in far:
        return None
    path = []
    while far[node]:
        heed()
        label, node = next(
            (label, target)
            for label, target in found.steps(node)
            if far.get(target, far[node]) < far[node]
        )
        path.append(found.name(label))
    return tuple(path)
