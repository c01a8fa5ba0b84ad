"""Finds shortest runs with arrays, and returns them with the names of states and operations."""

from __future__ import annotations

import numpy as np

from smsl_studio.blueprint.address import Address
from smsl_studio.graph.joint.array_search import (
    AT_ONCE,
    ArrayBound,
    ArraySearch,
    ConditionBits,
    FoundWay,
    Numbering,
    first_set,
)
from smsl_studio.graph.joint.codes import CodeLayout, PlainNumbers
from smsl_studio.graph.joint.diagram import Diagram
from smsl_studio.graph.joint.goals import FoundRun, SearchGoals
from smsl_studio.graph.joint.hashed import HashNumbers
from smsl_studio.graph.joint.joint_steps import JointSteps
from smsl_studio.graph.joint.operation_bits import BitTables, one_by_one
from smsl_studio.graph.joint.products import StateNumbers, TooLarge
from smsl_studio.graph.joint.ranks import ranked
from smsl_studio.stop import heed

PLAIN_BITS = 26
"""Codes of at most so many bits are their own numbers. One byte is kept for each number (64 MB)."""

MOST_RANKS = 1 << PLAIN_BITS
"""The largest number of configurations that get numbers by rank (see ``ranks``)."""


def shortest_run(
    steps: JointSteps, goals: SearchGoals, reached: tuple[Diagram, int] | None = None
) -> FoundRun | None:
    """Return the shortest run from the start to a goal, or None if there is none.

    Of several shortest runs it is the first one by its addresses. ``reached`` may have a diagram
    and in it the set of all configurations that can be reached; it saves memory. TooLarge if a
    limit is met.
    """
    most = ArrayBound().configurations
    if reached is not None and reached[0].count(reached[1]) > most:
        raise TooLarge(f"{most:,} configurations in arrays")
    layout, numbering = _numbered(steps, reached)
    tables = BitTables(layout, one_by_one(steps), goals.boxes)
    search = ArraySearch(tables, numbering, layout.code(steps.start))
    way = search.nearest(_ends(tables, goals))
    return None if way is None else _in_names(steps.numbers, layout, way)


class ArrayReach:
    """All configurations that can be reached, stored in arrays, to answer several questions.

    ``count`` is their number. ``bound`` says which limit ended the search; it is empty if the
    search is complete. TooLarge if the tables would be too large.
    """

    def __init__(self, steps: JointSteps, bound: ArrayBound | None = None) -> None:
        self._steps = steps
        self._layout, numbering = _numbered(steps, None)
        tables = BitTables(self._layout, one_by_one(steps), ())
        self._search = ArraySearch(tables, numbering, self._layout.code(steps.start), bound)
        self.bound = self._search.everything()
        self.count = sum(map(len, self._search.layers))

    def nearest(self, goals: SearchGoals) -> FoundRun | None:
        """Return the shortest run to a goal among the stored configurations, or None.

        Of several shortest runs it is the first one by its addresses. TooLarge if the conditions
        need too much memory.
        """
        tables = BitTables(self._layout, (), goals.boxes)
        ends = _ends(tables, goals)
        met = -1
        for number, layer in enumerate(self._search.layers):
            passing = -1
            for begin in range(0, len(layer), AT_ONCE):
                heed()
                bits = tables.bits(layer[begin : begin + AT_ONCE])
                hit = first_set(bits, ends.hits)
                if hit >= 0:
                    return self._told(number, begin + hit, False)
                if passing < 0 and ends.passing is not None:
                    found = first_set(bits, ends.passing)
                    passing = begin + found if found >= 0 else -1
            if met >= 0:
                return self._told(number - 1, met, True)
            met = passing
        return None if met < 0 else self._told(len(self._search.layers) - 1, met, True)

    def _told(self, layer: int, at: int, during: bool) -> FoundRun:
        return _in_names(self._steps.numbers, self._layout, self._search.way(layer, at, during))


def _ends(tables: BitTables, goals: SearchGoals) -> ConditionBits:
    first, second = len(goals.hits), len(goals.hits) + len(goals.passing)
    return ConditionBits(
        tables.mask(range(first)),
        tables.mask(range(first, second)) if goals.passing else None,
        tables.mask(range(second, len(goals.boxes))) if goals.may is not None else None,
    )


def _numbered(
    steps: JointSteps, reached: tuple[Diagram, int] | None
) -> tuple[CodeLayout, Numbering]:
    """Return the layout of the codes, and how to number them."""
    layout = CodeLayout(steps.numbers.sizes, steps.levels)
    if layout.bits <= PLAIN_BITS:
        return layout, PlainNumbers(layout)
    if reached is not None and reached[0].count(reached[1]) <= MOST_RANKS:
        try:
            return ranked(*reached)
        except TooLarge:
            pass  # it is numbered by itself then
    return layout, HashNumbers()


def _in_names(numbers: StateNumbers, layout: CodeLayout, way: FoundWay) -> FoundRun:
    """Return a found way with the names of its states and operations."""
    codes = np.array(way.codes, layout.kind)
    of = {one: layout.states(codes, numbers.at[one]) for one in {o.branch for o in way.operations}}
    path = []
    for place, one in enumerate(way.operations):
        state = numbers.states[numbers.at[one.branch]][int(of[one.branch][place])]
        path.append(Address(one.branch, state, one.name))
    end = {
        name: numbers.states[at][int(layout.states(codes[-1:], at)[0])]
        for name, at in numbers.at.items()
    }
    return FoundRun(path, end, way.during)
