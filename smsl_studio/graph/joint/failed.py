"""Failures as products of steps: one SB changes from its state to a failure state."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.configuration import Hierarchy, standing
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.graph.joint.products import JointMoves, Pairs, StateNumbers
from smsl_studio.stop import heed


def failed_moves(hierarchy: Hierarchy, numbers: StateNumbers) -> Iterator[JointMoves]:
    """Yield products of steps that lead from a configuration to those in which one SB has failed.

    The sub-SBs of the failed SB go to the states that they have at a start. A base of a changed SB
    keeps its state. If that state does not agree with its sub-SBs, the failure is left out.
    """
    blueprint = hierarchy.blueprint
    for name in hierarchy.order:
        for state in failing_states(blueprint[name]):
            heed()
            moved = standing(hierarchy, name, state)
            if not all(to in blueprint[sub].table for sub, to in moved.items()):
                continue
            moves: dict[int, Pairs] = {}
            agrees = True
            for sub, to in moved.items():
                at = numbers.at[sub]
                end = numbers.number[at][to]
                moves[at] = frozenset((one, end) for one in range(len(numbers.states[at])))
                for base, digit in hierarchy.bases[sub]:
                    branch, active = blueprint[base], to == blueprint[sub].activating
                    if base in moved:
                        agrees &= branch.is_on(moved[base], digit) == active
                        continue
                    place = numbers.at[base]
                    fit = frozenset(
                        (number, number)
                        for number, one in enumerate(numbers.states[place])
                        if branch.is_on(one, digit) == active
                    )
                    moves[place] = moves.get(place, fit) & fit
            if agrees and all(moves.values()):
                yield moves
