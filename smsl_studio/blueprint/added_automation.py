"""What levels that are set before a run take away from people."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from smsl_studio.blueprint.address import Address, fact_text
from smsl_studio.blueprint.continuum import DEFAULTS, FORECAST, GENERATION, LEVELS
from smsl_studio.blueprint.levels import Levels, digit_of
from smsl_studio.blueprint.model import Blueprint

Own = str | tuple[str, int] | Address
"""An element of the whole by its key, a fact, or an edge."""


class AddedAutomation(NamedTuple):
    """An element with its level in the blueprint, and the more automatic one of a run."""

    element: str
    declared: str
    asked: str


def added_automation(blueprint: Blueprint, before: Mapping[str, str]) -> Iterator[AddedAutomation]:
    """Yield each element that is more automatic with ``before`` than the blueprint declares.

    A level that gives people more to do is not told. Levels of forecasts are not either: of these
    the most careful one counts. UsageError if ``before`` has an unknown key or level.
    """
    declared, asked = Levels(blueprint), Levels(blueprint, before)
    elements = dict(one for key in before for one in _elements(blueprint, key))
    for text, own in elements.items():
        was, now = _level(declared, own), _level(asked, own)
        if LEVELS.index(now) > LEVELS.index(was):
            yield AddedAutomation(text, was, now)


def _elements(blueprint: Blueprint, key: str) -> Iterator[tuple[str, Own]]:
    """Yield the elements of a key of ``Levels``. Each operation of a name is one."""
    if key == FORECAST:
        return
    if key in DEFAULTS or key == GENERATION:
        yield key, key
        return
    name, *parts = Address.split(key)
    branch = blueprint[name]
    if len(parts) == 2:
        yield key, Address(name, *parts)
        return
    digit = digit_of(branch, parts[0])
    if digit is not None:
        yield fact_text(name, digit), (name, digit)
        return
    yield from (
        (str(edge.address), edge.address) for edge in branch.edges() if edge.name == parts[0]
    )


def _level(levels: Levels, own: Own) -> str:
    if isinstance(own, Address):
        return levels.operation(own)
    if isinstance(own, tuple):
        return levels.fact(*own)
    return str(getattr(levels, own))
