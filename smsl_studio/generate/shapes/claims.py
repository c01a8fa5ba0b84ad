"""What the properties of a blueprint name besides facts: states, goals and operations."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties import StateTerm
from smsl_studio.blueprint.properties.follow import terms_of
from smsl_studio.blueprint.properties.property import properties_of


class NamedPlace(NamedTuple):
    """A state that a property names, or all operations of an SB. Then ``state`` is empty."""

    claim: str
    branch: str
    state: str


def named_places(blueprint: Blueprint) -> Iterator[NamedPlace]:
    """Yield the states and the operations that properties name."""
    first = next(iter(blueprint.branches))
    for one in properties_of(blueprint):
        for term in (term for formula in one.formulas for term in terms_of(formula)):
            if isinstance(term, StateTerm):
                yield NamedPlace(one.name, term.branch or first, term.state)
        goal = Address.split(one.goal) if one.goal else ()
        if len(goal) == 2:
            yield NamedPlace(one.name, goal[0], goal[1])
        elif len(goal) == 1:
            yield NamedPlace(one.name, first, goal[0])
        if one.operation:
            names = Address.split(one.operation)
            yield NamedPlace(one.name, names[0] if len(names) > 1 else first, "")
