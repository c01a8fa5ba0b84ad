"""The facts that an operation changes, or may have changed if it was interrupted. Values are not
known.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.joint import JointAction
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.dispatch.execution.run import LiveRun


def touched(
    run: LiveRun, begun: Iterable[JointAction], open_edges: Collection[Address]
) -> set[FactKey]:
    """Return the facts that some actions may have changed and that are not committed.

    ``open_edges`` are the edges of these actions that are not committed.
    """
    found: set[FactKey] = set()
    for action in begun:
        for edge in action.begins:
            if edge.address not in open_edges:
                continue
            branch = run.blueprint[edge.branch]
            changed = _differing(branch, edge.source, edge.target)
            found |= {fact for fact in changed if fact[1] not in branch.subs}
            bound = run.bound.get(edge.address)
            found |= set(bound.touches) if bound and edge.function else set()
        if action.edge.load and action.edge.address in open_edges:
            found |= _loaded(run, action)
    return found


def changed_by(run: LiveRun, action: JointAction) -> set[FactKey]:
    """Return the facts that an action should change, or declares that it may change."""
    found = set(run.bound[action.edge.address].touches)
    for name, state in {**action.moved, **action.committed}.items():
        found |= _differing(run.blueprint[name], run.believed[name], state)
    return found


def moved_by(run: LiveRun, edge: Edge) -> frozenset[str]:
    """Return the SBs that one edge moves: its own, and with ``load`` the sub-SBs that it sets."""
    if not edge.load:
        return frozenset((edge.branch,))
    subs = dict(run.hierarchy.subs[edge.branch])
    below = (run.hierarchy.tree(subs[digit]) for digit in (*edge.falls, *edge.rises))
    return frozenset((edge.branch,)).union(*below)


def _loaded(run: LiveRun, action: JointAction) -> set[FactKey]:
    """Return the facts of sub-SBs that the function of a ``load`` edge changes itself."""
    found: set[FactKey] = set()
    for name, state in {**action.moved, **action.committed}.items():
        branch = run.blueprint[name]
        changed = _differing(branch, run.configuration[name], state)
        found |= {fact for fact in changed if fact[1] not in branch.subs}
    return found


def _differing(branch: StateBranch, source: str, target: str) -> set[FactKey]:
    """Return the facts in which two states of an SB differ."""
    pairs = zip(branch.facts(source), branch.facts(target), strict=False)
    return {(branch.name, digit) for digit, (old, new) in enumerate(pairs) if old != new}
