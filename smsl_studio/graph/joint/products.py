"""Product steps: many steps of the configurations of a blueprint, written as one.

A product has for each SB that takes part a set of pairs (from, to) of states. All combinations of
them are steps, and all other SBs stand still. A guard is a set of pairs with equal ends.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.edges import Edge
from smsl_studio.stop import heed

Pairs = frozenset[tuple[int, int]]
"""States of one SB before and after, by their numbers."""

JointMoves = Mapping[int, Pairs]
"""A product: the pairs of each SB that takes part, by its number."""


class TooLarge(Exception):  # noqa: N818 -- an answer, not an error of ours
    """Something takes more than its bound, which the text names."""


class StateNumbers:
    """The SBs of a blueprint and their states, as numbers. SBs are in the order of the
    hierarchy."""

    def __init__(self, hierarchy: Hierarchy) -> None:
        self.hierarchy = hierarchy
        blueprint = hierarchy.blueprint
        self.at = {name: index for index, name in enumerate(hierarchy.order)}
        self.states = [tuple(blueprint[name].table) for name in hierarchy.order]
        self.number = [{one: n for n, one in enumerate(states)} for states in self.states]

    @property
    def sizes(self) -> list[int]:
        """The number of states of each SB."""
        return [len(states) for states in self.states]

    def coded(self, configuration: Mapping[str, str]) -> tuple[int, ...]:
        """Return a configuration as the numbers of its states."""
        return tuple(
            self.number[at][configuration[name]] for at, name in enumerate(self.hierarchy.order)
        )


class AskedMoves(NamedTuple):
    """The steps that follow if one of ``edges``, operations of one SB, is asked for.

    ``moves`` is their product. ``passed`` leads to the configurations through which these steps
    pass. ``rough`` leads to further ones, which are not certain: a step may pass through them, or
    may not.
    """

    edges: Sequence[Edge]
    moves: JointMoves
    passed: Sequence[JointMoves] = ()
    rough: Sequence[JointMoves] = ()


@dataclass
class JointProducts:
    """All steps of a blueprint, and the configurations that they pass through.

    ``asked`` has the same steps, sorted by the operation that is asked for. ``passed`` is certain.
    ``rough`` is not certain: a step may pass through these configurations, or may not.
    """

    steps: list[JointMoves] = field(default_factory=list)
    asked: list[AskedMoves] = field(default_factory=list)
    passed: list[JointMoves] = field(default_factory=list)
    rough: list[JointMoves] = field(default_factory=list)


def joined(products: Iterable[JointMoves]) -> list[JointMoves]:
    """Join products that differ in one SB only. Each step of the result is one of theirs."""
    by_members: dict[frozenset[int], dict[frozenset[tuple[int, Pairs]], JointMoves]] = {}
    for one in products:
        heed()
        by_members.setdefault(frozenset(one), {})[frozenset(one.items())] = one
    found: list[JointMoves] = []
    for members, of_them in by_members.items():
        left = list(of_them.values())
        before = 0
        while before != len(left):
            before = len(left)
            for member in sorted(members):
                heed()
                left = _joined_in(left, member)
        found += left
    return found


def _joined_in(products: list[JointMoves], member: int) -> list[JointMoves]:
    """Join products that differ only in the pairs of one SB."""
    alike: dict[frozenset[tuple[int, Pairs]], list[JointMoves]] = {}
    for one in products:
        heed()
        rest = frozenset(item for item in one.items() if item[0] != member)
        alike.setdefault(rest, []).append(one)
    return [
        {**same[0], member: frozenset().union(*(one[member] for one in same))}
        if len(same) > 1
        else same[0]
        for same in alike.values()
    ]


JointBox = Mapping[int, frozenset[int]]
"""All configurations with these states of some SBs."""


def guarded(products: Sequence[JointMoves], boxes: Iterable[JointBox]) -> list[JointMoves]:
    """Return products that begin in one of some boxes."""
    found: list[JointMoves] = []
    for box in boxes:
        for moves in products:
            heed()
            one = dict(moves)
            for at, states in box.items():
                pairs = one.get(at)
                if pairs is None:
                    one[at] = frozenset((state, state) for state in states)
                else:
                    one[at] = frozenset(pair for pair in pairs if pair[0] in states)
            if all(one.values()):
                found.append(one)
    return found
