"""Explores all SBs of a blueprint together, in two modes.

In *ours* the SBs are coupled, as a run couples them. In *free* every SB moves by itself. What the
coupling prevents is seen by comparing the two.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice
from math import prod
from typing import Any

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.graph.joint.products import TooLarge
from smsl_studio.inspection.explorer.as_set import counted
from smsl_studio.inspection.explorer.combinations import joined, nearest
from smsl_studio.inspection.explorer.part import (
    Path,
    SpacePart,
    configuration_of,
    coupled_part,
    explored_part,
    free_part,
    independent,
)
from smsl_studio.stop import UNBOUNDED, BoundMet, EffortBounds, bounded, heed

Json = Any
MOST = 100
"""The largest number of disagreements, and of traps, that are listed."""

FEW = 50_000
"""If the product of the state counts of a part is at most this, its configurations are explored one
by one."""


@dataclass(frozen=True)
class FoundPlace:
    """A configuration, or a part of one, with a shortest way to it."""

    configuration: Mapping[str, str]
    path: Path

    def as_json(self) -> dict[str, Json]:
        """Return it as ``explore`` writes it."""
        return {
            "configuration": dict(self.configuration),
            "path": [str(one) for one in self.path],
        }


@dataclass(frozen=True)
class ExploredMode:
    """What was found in one mode.

    ``configurations`` is the number of those that can be reached. A disagreement has the states of
    a base and a sub-SB that are reached together although they disagree. From a trap no
    configuration with every root in ACTIVATING can be reached. Both lists have at most ``MOST``
    places, the nearest first; the numbers beside them count all. ``bound`` says in words which
    limit was met. Then traps are not known.
    """

    configurations: int
    disagreements: tuple[FoundPlace, ...]
    disagreement_count: int
    traps: tuple[FoundPlace, ...]
    trap_count: int
    bound: str = ""

    @property
    def clean(self) -> bool:
        """Whether there is no disagreement, no trap and no limit that was met."""
        return not (self.disagreement_count or self.trap_count or self.bound)

    def as_json(self) -> dict[str, Json]:
        """Return it as ``explore`` writes it."""
        more = self.disagreement_count - len(self.disagreements)
        more += self.trap_count - len(self.traps)
        found: dict[str, Json] = {
            "configurations": self.configurations,
            "disagreements": [one.as_json() for one in self.disagreements],
            "traps": [one.as_json() for one in self.traps],
        }
        if more:
            found["more"] = more
        if self.bound:
            found["bound"] = self.bound
        return found


def explored_coupled(
    blueprint: Blueprint, limit: int, few: int = FEW, bounds: EffortBounds = UNBOUNDED
) -> ExploredMode:
    """Explore the SBs together, as a run couples them.

    At most ``limit`` configurations are stored. ``bounds`` limit time and memory. If the product of
    the state counts of a part is more than ``few``, all its configurations are one set if that is
    possible. Then none of them is stored by itself. RunRefused if there is no start, or if the SBs
    refer to each other in a circle.
    """
    bounds = bounds.begun()
    hierarchy = Hierarchy(blueprint)
    groups = independent(hierarchy)
    if any(prod(len(blueprint[name].table) or 1 for name in names) > few for names in groups):
        with suppress(TooLarge, BoundMet), bounded(bounds):
            return _as_set(hierarchy)
    parts, stored = [], 0
    for names in groups:
        with bounded(bounds):
            found = explored_part(blueprint, names, max(limit - stored, 1))
        parts.append(coupled_part(found))
        stored += len(parts[-1].keys)
    pairs = [pair for part in parts for pair in _pairs_in(hierarchy, part)]
    return _mode(blueprint, parts, len(pairs), iter(pairs))


def _as_set(hierarchy: Hierarchy) -> ExploredMode:
    found = counted(hierarchy, MOST)
    traps = tuple(FoundPlace(configuration, path) for configuration, path in found.nearest)
    return ExploredMode(found.configurations, (), 0, traps, found.traps)


def explored_free(blueprint: Blueprint) -> ExploredMode:
    """Explore the SBs as if nothing coupled them. RunRefused if they go round in a circle."""
    hierarchy = Hierarchy(blueprint)
    roots = set(hierarchy.roots)
    parts = [free_part(branch, branch.name in roots) for branch in blueprint]
    by_name = {part.names[0]: part for part in parts}
    count, ways = 0, []
    for base, digit, sub in _links(hierarchy):
        above, below = by_name[base], by_name[sub]
        branch = blueprint[base]
        on, off = _split(above, {state for state in branch.table if branch.is_on(state, digit)})
        there, elsewhere = _split(below, {blueprint[sub].activating})
        for one, other in ((on, elsewhere), (off, there)):
            count += len(one) * len(other)
            ways.append(_places(blueprint, (above, below), (one, other)))
    shown = sorted((one for way in ways for one in islice(way, MOST)), key=lambda o: len(o.path))
    return _mode(blueprint, parts, count, iter(shown))


def _mode(
    blueprint: Blueprint, parts: Sequence[SpacePart], count: int, pairs: Iterator[FoundPlace]
) -> ExploredMode:
    total = prod(len(part.keys) for part in parts)
    bound = next((part.bound for part in parts if part.bound), "")
    good = prod(sum(part.good) for part in parts)
    traps = 0 if bound else total - good
    shown = tuple(islice(_trapped(blueprint, parts), MOST)) if traps else ()
    return ExploredMode(total, tuple(islice(pairs, MOST)), count, shown, traps, bound)


def _trapped(blueprint: Blueprint, parts: Sequence[SpacePart]) -> Iterator[FoundPlace]:
    """Yield at least the nearest traps. In each of them one part is the first that is trapped."""
    found: list[FoundPlace] = []
    for at, part in enumerate(parts):
        _, trapped = _sorted_out(part.good)
        before = [_sorted_out(other.good)[0] for other in parts[:at]]
        after = [range(len(other.keys)) for other in parts[at + 1 :]]
        found += islice(_places(blueprint, parts, [*before, trapped, *after]), MOST)
    yield from sorted(found, key=lambda one: len(one.path))


def _places(
    blueprint: Blueprint, parts: Sequence[SpacePart], lists: Sequence[Sequence[int]]
) -> Iterator[FoundPlace]:
    names = [name for part in parts for name in part.names]
    for choice in nearest(parts, lists):
        pairs = list(zip(parts, choice, strict=True))
        key = tuple(state for part, node in pairs for state in part.keys[node])
        path = joined([part.path(node) for part, node in pairs])
        yield FoundPlace(configuration_of(blueprint, names, key), path)


def _pairs_in(hierarchy: Hierarchy, part: SpacePart) -> Iterator[FoundPlace]:
    """Yield the pairs of states of bases and sub-SBs that disagree in a coupled part."""
    blueprint = hierarchy.blueprint
    at = {name: index for index, name in enumerate(part.names)}
    links = [link for link in _links(hierarchy) if link[0] in at]
    known = set()
    for node, key in enumerate(part.keys):
        heed()
        for base, digit, sub in links:
            above, below = key[at[base]], key[at[sub]]
            pair = base, digit, above, below
            on = blueprint[base].is_on(above, digit)
            if on != (below == blueprint[sub].activating) and pair not in known:
                known.add(pair)
                yield FoundPlace({base: above, sub: below}, part.path(node))


def _links(hierarchy: Hierarchy) -> Iterator[tuple[str, int, str]]:
    for base in hierarchy.blueprint.branches:
        for digit, sub in hierarchy.subs[base]:
            yield base, digit, sub


def _split(part: SpacePart, states: Collection[str]) -> tuple[list[int], list[int]]:
    """Return the configurations of a single SB that are among some states, and the others."""
    return _sorted_out([state in states for (state,) in part.keys])


def _sorted_out(flags: Iterable[bool]) -> tuple[list[int], list[int]]:
    """Return the numbers of the true flags, and of the others."""
    found: tuple[list[int], list[int]] = ([], [])
    for number, flag in enumerate(flags):
        found[0 if flag else 1].append(number)
    return found
