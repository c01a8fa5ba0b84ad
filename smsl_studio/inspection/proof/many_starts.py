"""Finds one run through sets of configurations, if a run may begin in many configurations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.graph.joint.diagram import Relation
from smsl_studio.graph.joint.goals import FoundRun
from smsl_studio.graph.joint.products import JointMoves, TooLarge
from smsl_studio.graph.joint.reach import JointReach
from smsl_studio.inspection.proof.armed_sets import ArmedSets, MarkedSet
from smsl_studio.stop import heed

MOST_OPERATIONS = 5_000
"""The largest number of operations that are tried for each step."""


class _Try(NamedTuple):
    """An operation with its steps, as relations forward and backward."""

    address: Address
    forth: list[Relation]
    back: list[Relation]


class ManyStarts:
    """Finds the first run by its addresses, from any configuration in which a run may begin.

    Configurations of ``arming`` arm a run, and those of ``disarming`` disarm it (see ``armed``).
    Without these sets no run is armed.
    """

    def __init__(self, reach: JointReach, arming: int = 0, disarming: int = 0) -> None:
        self._reach, self._diagram = reach, reach.diagram
        self._top = reach.diagram.height - 1
        self._arming, self._disarming = arming, disarming
        self._sets = ArmedSets(self._diagram, arming, disarming)
        self._tries = self._all_tries()

    def _all_tries(self) -> list[_Try]:
        steps = self._reach.steps
        numbers, levels = steps.numbers, steps.levels
        found: dict[str, tuple[Address, list[JointMoves]]] = {}
        for asked in steps.asked:
            for edge in asked.edges:
                heed()
                at = numbers.at[edge.branch]
                own = numbers.number[at][edge.source], numbers.number[at][edge.target]
                if own in asked.moves[at]:
                    moves = {**asked.moves, at: frozenset({own})}
                    found.setdefault(edge.text, (edge.address, []))[1].append(moves)
                if len(found) > MOST_OPERATIONS:
                    raise TooLarge(f"{MOST_OPERATIONS:,} operations")
        return [
            _Try(
                address,
                [Relation(one, levels) for one in products],
                [Relation(one, levels, True) for one in products],
            )
            for _, (address, products) in sorted(found.items())
        ]

    def run(self, ways: Sequence[MarkedSet]) -> FoundRun:
        """Return the first run by its addresses that goes through the sets, one set for each step.

        TooLarge if there are more than ``MOST_OPERATIONS`` operations.
        """
        here, taken, passed = ways[0], list[_Try](), [ways[0]]
        for goals in ways[1:]:
            for one in self._tries:
                heed()
                there = self._after(here, one.forth, goals)
                if any(there):
                    break
            else:
                raise AssertionError("a way in the diagram is none of its steps")
            taken.append(one)
            passed.append(there)
            here = there
        is_armed = not here.plain
        code = self._first(here.armed if is_armed else here.plain)
        end = code
        for one, before in zip(reversed(taken), reversed(passed[:-1]), strict=True):
            code, is_armed = self._before(code, is_armed, one.back, before)
        path = [one.address for one in taken]
        return FoundRun(path, self._named(end), False, self._named(code))

    def _after(self, here: MarkedSet, forth: Sequence[Relation], goals: MarkedSet) -> MarkedSet:
        diagram, top = self._diagram, self._top
        to_plain, to_armed = self._sets.after(*(self._images(one, forth) for one in here))
        return MarkedSet(
            diagram.both(to_plain, goals.plain, top), diagram.both(to_armed, goals.armed, top)
        )

    def _before(
        self, code: tuple[int, ...], is_armed: bool, back: Sequence[Relation], before: MarkedSet
    ) -> tuple[tuple[int, ...], bool]:
        diagram = self._diagram
        sources = self._images(diagram.point(code), back)
        arms, disarms = (diagram.has(one, code) for one in (self._arming, self._disarming))
        plain = diagram.both(sources, before.plain, self._top) if arms == is_armed else 0
        if plain:
            return self._first(plain), False
        assert disarms != is_armed
        return self._first(diagram.both(sources, before.armed, self._top)), True

    def _images(self, found: int, relations: Sequence[Relation]) -> int:
        images = 0
        for one in relations if found else ():
            images = self._diagram.union(images, self._diagram.image(found, one), self._top)
        return images

    def _first(self, found: int) -> tuple[int, ...]:
        return next(iter(self._diagram.members(found, 1)))

    def _named(self, code: Sequence[int]) -> Mapping[str, str]:
        numbers = self._reach.steps.numbers
        return {name: numbers.states[at][code[at]] for name, at in numbers.at.items()}
