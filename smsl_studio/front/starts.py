"""Start configurations in which an SB is in a given state, so that one of its edges can be
tried."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from itertools import islice, product

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from smsl_studio.errors import PlanningError, RunRefused

TRIES = 2000
"""The largest number of attempts. Shared sub-SBs can make a start hard to find."""


def starts_for(
    hierarchy: Hierarchy, branch: str, state: str, also: Collection[str] = ()
) -> Iterator[dict[str, str]]:
    """Yield configurations in which ``branch`` is in ``state``, with INITIAL states of roots first.

    Its sub-SBs are in the states of clause 3, its bases in every state that agrees. Roots that
    share a sub-SB with it, or that are above an SB in ``also``, are tried in every state. All other
    roots stay in INITIAL.
    """
    tree = set(hierarchy.tree(branch)) | set(also)
    for above in islice(_above(hierarchy, branch, state), TRIES):
        others = [
            root
            for root in hierarchy.roots
            if root not in above and tree & set(hierarchy.tree(root))
        ]
        for states in islice(product(*(_states(hierarchy, root) for root in others)), TRIES):
            given = {**above, **dict(zip(others, states, strict=True))}
            try:
                yield start_configuration(hierarchy, given)
            except RunRefused:
                continue


def start_for_edge(hierarchy: Hierarchy, edge: Address) -> Mapping[str, str] | None:
    """Return a configuration from which an edge can be tried, else one in its source, else None.

    An operation of a sub-SB may enter or leave ACTIVATING. Then each base needs an edge with a rise
    or fall of its fact (clause 10). An operation may require facts; then these must hold. If the
    search takes too much work, the result is the configuration at which the search was given up.
    """
    stepper = Stepper(hierarchy, Terms(failing=None))
    known = stepper.edges.get(edge)
    required = {name for name, _, _ in known.requires} if known else set()
    first = None
    starts = starts_for(hierarchy, edge.branch, edge.state, required)
    for configuration in islice(starts, TRIES):
        first = first or configuration
        try:
            # All starts together may take as much work as one plan.
            if known is None or isinstance(stepper.written(configuration, known), JointStep):
                return configuration
        except PlanningError:
            return configuration
    return first


def _above(hierarchy: Hierarchy, branch: str, state: str) -> Iterator[dict[str, str]]:
    """Yield the SB in its state, with every SB above it in states that agree."""
    bases = hierarchy.bases[branch]
    if not bases:
        yield {branch: state}
        return
    on = state == hierarchy.blueprint[branch].activating
    ways = []
    for base, digit in bases:
        own = hierarchy.blueprint[base]
        states = [s for s in _states(hierarchy, base) if own.is_on(s, digit) == on]
        ways.append([found for s in states for found in islice(_above(hierarchy, base, s), TRIES)])
    for combination in product(*ways):
        merged: dict[str, str] = {branch: state}
        if all(_merge(merged, found) for found in combination):
            yield merged


def _merge(into: dict[str, str], found: Mapping[str, str]) -> bool:
    return all(into.setdefault(name, state) == state for name, state in found.items())


def _states(hierarchy: Hierarchy, branch: str) -> list[str]:
    """Return every state of an SB, INITIAL first."""
    own = hierarchy.blueprint[branch]
    return sorted(own.table, key=lambda state: state != own.initial)
