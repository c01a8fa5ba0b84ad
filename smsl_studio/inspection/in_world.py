"""The inspection of a blueprint in a chosen world (R24 to R26)."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from types import MappingProxyType

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.inspect import in_order
from smsl_studio.inspection.rules.finding import Finding, Remark
from smsl_studio.inspection.rules.world import (
    Equipment,
    Unreached,
    r24_no_function,
    r25_not_sensed,
    r26_not_confirmed,
)
from smsl_studio.inspection.selection import listed
from smsl_studio.library.bound import Bindings
from smsl_studio.stop import heed

_RULES = MappingProxyType[str, Callable[[Equipment], Iterator[Remark]]](
    {"R24": r24_no_function, "R25": r25_not_sensed, "R26": r26_not_confirmed}
)


def inspect_in_world(
    blueprint: Blueprint,
    world: str,
    bindings: Bindings,
    rules: Collection[str] | None = None,
    unreached: Unreached | None = None,
) -> tuple[Finding, ...]:
    """Return the findings about a blueprint with its bindings in a world, in the order of the text.

    ``rules`` are the numbers of the rules to check, None means all. ``unreached`` is what the
    chosen robot does not reach.
    """
    equipment = Equipment(blueprint, world, bindings, unreached)
    found: list[Finding] = []
    for rule, check in _RULES.items():
        if rules is None or rule in rules:
            heed()
            found.extend(listed(blueprint, check(equipment)))
    return in_order(blueprint, found)
