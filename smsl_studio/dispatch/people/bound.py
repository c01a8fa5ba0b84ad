"""The function or person that carries out each edge: the functions of a world, and people
instead.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.continuum import HUMAN
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.host.protocol import Bound
from smsl_studio.library.table import TIMEOUT

BY_HAND = Bound("", exact=False, stop="hold", timeout=TIMEOUT)
"""A person carries out the edge, so no function runs, and the task has its own time. The time limit
is for writing down the result in a table world (see ``Carrier``).
"""


def with_people(
    bound: Mapping[Address, Bound], blueprint: Blueprint, levels: Levels
) -> Mapping[Address, Bound]:
    """Return what carries out each edge according to the levels. If people do nothing, it is
    ``bound``.
    """
    branches = [branch.name for branch in blueprint if levels.people_do(branch.name)]
    return _WithPeople(bound, blueprint, levels, branches) if branches else bound


class _WithPeople(Mapping[Address, Bound]):
    """The functions, with people instead of some. It is computed for each edge when it is asked
    for, because files have up to 177,144 edges.
    """

    def __init__(
        self,
        bound: Mapping[Address, Bound],
        blueprint: Blueprint,
        levels: Levels,
        branches: list[str],
    ) -> None:
        self._bound, self._blueprint, self._levels = bound, blueprint, levels
        self._branches = branches

    def __getitem__(self, edge: Address) -> Bound:
        if not self._human(edge):
            return self._bound[edge]
        found = self._bound.get(edge)
        note = self._blueprint[edge.branch].operation_note(edge.state, edge.operation)
        one = BY_HAND if note.stop is None else replace(BY_HAND, stop=note.stop)
        if found is None:
            return one
        return replace(one, exact=found.exact, touches=found.touches, timeout=found.timeout)

    def __contains__(self, edge: object) -> bool:
        return edge in self._bound or (isinstance(edge, Address) and self._human(edge))

    def __iter__(self) -> Iterator[Address]:
        yield from self._bound
        for name in self._branches:
            for edge in self._blueprint[name].edges():
                if edge.address not in self._bound and self._human(edge.address):
                    yield edge.address

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def _human(self, edge: Address) -> bool:
        return edge.branch in self._branches and self._levels.operation(edge) == HUMAN
