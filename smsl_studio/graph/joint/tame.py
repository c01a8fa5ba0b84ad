"""Tame sub-SBs: those whose moves need no look at single configurations.

A tame sub-SB has one base and requires nothing. It has no sub-SBs, or: its sub-SBs are tame and can
always move, all their digits are on in ACTIVATING, and it loads nothing. Then everything below it
is in ACTIVATING after a rise, and where a fall leaves it does not depend on the route.
"""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.graph.joint.products import JointMoves, Pairs, StateNumbers
from smsl_studio.stop import heed


class TameSubs:
    """The tame sub-SBs of a blueprint, and what rises and falls do with them."""

    def __init__(self, stepper: Stepper, numbers: StateNumbers) -> None:
        self._stepper, self._numbers = stepper, numbers
        self._hierarchy = stepper.hierarchy
        self._blueprint = stepper.hierarchy.blueprint
        self._tame: set[str] = set()
        self._always: set[str] = set()
        for name in reversed(self._hierarchy.order):
            heed()
            if self._is_tame(name):
                self._tame.add(name)
                branch = self._blueprint[name]
                up = stepper.downhill(name, branch.activating).far
                down = stepper.downhill(name, branch.initial).far
                if len(up) == len(branch.table) and branch.activating in down:
                    self._always.add(name)

    def __contains__(self, name: str) -> bool:
        return name in self._tame

    def is_flat(self, name: str) -> bool:
        """Return whether nothing is below an SB."""
        return not self._hierarchy.subs[name]

    def _is_tame(self, name: str) -> bool:
        branch, subs = self._blueprint[name], self._hierarchy.subs[name]
        if len(self._hierarchy.bases[name]) != 1 or branch.initial == branch.activating:
            return False
        if branch.initial not in branch.table or branch.activating not in branch.table:
            return False
        if any(note.requires for note in branch.notes.operations.values()):
            return False
        if not all(
            sub in self._always and branch.is_on(branch.activating, digit) for digit, sub in subs
        ):
            return False
        edges = self._stepper.edges
        if not subs:
            return True
        for state in branch.table:
            heed()
            if any(edge.load for edge in edges.out(name, state)):
                return False
        return True

    def moves(self, name: str, rise: bool) -> dict[int, Pairs]:
        """Return what a rise, or a fall, of an SB does with it and with everything below it."""
        at, branch = self._numbers.at[name], self._blueprint[name]
        number = self._numbers.number[at]
        goal = branch.activating if rise else branch.initial
        far = self._stepper.downhill(name, goal).far
        found: dict[int, Pairs] = {}
        if rise:
            end = number[goal]
            found[at] = frozenset((number[one], end) for one in far if one != goal)
            for below in self._hierarchy.tree(name)[1:]:
                place = self._numbers.at[below]
                states = self._numbers.number[place]
                active = states[self._blueprint[below].activating]
                found[place] = frozenset((one, active) for one in states.values())
            return found
        active = number[branch.activating]
        found[at] = frozenset({(active, number[goal])} if branch.activating in far else ())
        for digit, sub in self._hierarchy.subs[name]:
            if branch.is_on(goal, digit):
                found.update(self._standing(sub))
            else:
                found.update(self.moves(sub, False))
        return found

    def _standing(self, name: str) -> Iterator[tuple[int, Pairs]]:
        """Yield that an SB and everything below it are in ACTIVATING before and afterwards."""
        for below in self._hierarchy.tree(name):
            at = self._numbers.at[below]
            active = self._numbers.number[at][self._blueprint[below].activating]
            yield at, frozenset({(active, active)})

    def inside(self, name: str, rise: bool) -> JointMoves:
        """Return where an SB is between the operations of its rise or fall. For one with sub-SBs
        these are all states, so some may never be passed.
        """
        if not self.is_flat(name):
            found = {}
            for below in self._hierarchy.tree(name):
                at = self._numbers.at[below]
                states = range(len(self._numbers.states[at]))
                found[at] = frozenset((one, other) for one in states for other in states)
            return found
        at, branch = self._numbers.at[name], self._blueprint[name]
        number = self._numbers.number[at]
        goal = branch.activating if rise else branch.initial
        hill = self._stepper.downhill(name, goal)
        pairs = set()
        for state in hill.far if rise else (branch.activating,):
            heed()
            for edge in (hill.route(state) or ())[:-1]:
                pairs.add((number[state], number[edge.target]))
        return {at: frozenset(pairs)}
