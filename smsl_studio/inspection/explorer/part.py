"""A part of a blueprint that moves by itself: some SBs that nothing outside them can stop or move.

Configurations of the whole are all combinations of configurations of its parts.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.edges import Edges
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.inspection.proof.exploration import Exploration
from smsl_studio.inspection.proof.space import Key, Space
from smsl_studio.inspection.proof.way import way_to
from smsl_studio.stop import heed

Path = tuple[Address, ...]


@dataclass(frozen=True)
class SpacePart:
    """The configurations that some SBs reach, the nearest first.

    ``names`` are the SBs in the order of each configuration in ``keys``. ``depths`` are numbers of
    steps from the start. ``good`` says of each configuration whether one can be reached from it in
    which every root of the part is in ACTIVATING. ``came`` is the configuration before each one
    and the operation that led there, None at the start. ``bound`` says in words why some are
    missing; it is empty if there are all.
    """

    names: tuple[str, ...]
    keys: Sequence[Key]
    depths: Sequence[int]
    good: Sequence[bool]
    came: Sequence[tuple[int, Address] | None]
    bound: str = ""

    def path(self, node: int) -> Path:
        """Return the shortest way from the start to a configuration."""
        return way_to(node, self.came.__getitem__)[1]


def independent(hierarchy: Hierarchy) -> tuple[tuple[str, ...], ...]:
    """Return the SBs in groups that do not touch each other, in file order.

    SBs touch if one expands a fact of the other, or if an operation of one requires a fact of the
    other.
    """
    edges = Edges(hierarchy)
    near: dict[str, set[str]] = {name: set() for name in hierarchy.blueprint.branches}
    for name, touched in near.items():
        heed()
        for other in {sub for _, sub in hierarchy.subs[name]} | edges.required_by(name):
            touched.add(other)
            near[other].add(name)
    groups, seen = [], set[str]()
    for name in near:
        if name in seen:
            continue
        group, waiting = {name}, [name]
        while waiting:
            fresh = near[waiting.pop()] - group
            group |= fresh
            waiting.extend(fresh)
        seen |= group
        groups.append(tuple(one for one in near if one in group))
    return tuple(groups)


FEW = 1_000
"""Counting the configurations of a group ends at this number."""


def has_more_than(blueprint: Blueprint, most: int) -> bool:
    """Return whether it is certain that more than ``most`` configurations can be reached.

    Groups of SBs that do not depend on each other are counted separately, each up to ``FEW``. So
    the answer is quick. If all SBs are in one group, the answer is False, because nothing is known.
    RunRefused if there is no start.
    """
    groups = independent(Hierarchy(blueprint))
    count = 1
    for names in groups if len(groups) > 1 else ():
        count *= len(Exploration(Space(restricted(blueprint, names)), FEW))
        if count > most:
            return True
    return False


def restricted(blueprint: Blueprint, names: Iterable[str]) -> Blueprint:
    """Return a blueprint with some of its SBs alone."""
    return replace(blueprint, branches=MappingProxyType({name: blueprint[name] for name in names}))


def touching(blueprint: Blueprint, branch: str) -> Blueprint:
    """Return a blueprint with one SB and all that touch it, directly or by others."""
    groups = independent(Hierarchy(blueprint))
    return restricted(blueprint, next(names for names in groups if branch in names))


def explored_part(blueprint: Blueprint, names: tuple[str, ...], limit: int) -> Exploration:
    """Explore some SBs together, with everything that couples them (docs/running.md).

    At most ``limit`` configurations are stored. RunRefused if there is no start.
    """
    return Exploration(Space(restricted(blueprint, names)), limit)


def coupled_part(found: Exploration) -> SpacePart:
    """Return the result of an exploration as a part of the space."""
    return SpacePart(
        found.space.order,
        found.keys,
        [found.depth(node) for node in range(len(found))],
        _good(found),
        [found.origin(node) for node in range(len(found))],
        found.bound,
    )


def free_part(branch: StateBranch, root: bool) -> SpacePart:
    """Explore one SB that moves by its own edges from INITIAL. Nothing else is asked.

    If it is no ``root``, each of its configurations is good.
    """
    number = {branch.initial: 0}
    keys: list[Key] = [(branch.initial,)]
    depths, came = [0], list[tuple[int, Address] | None]([None])
    into: list[list[int]] = [[]]
    for node, (state,) in enumerate(keys):
        heed()
        for operation, target in sorted(branch.table.get(state, {}).items()):
            if target not in branch.table:
                continue
            at = number.get(target)
            if at is None:
                at = number[target] = len(keys)
                keys.append((target,))
                depths.append(depths[node] + 1)
                came.append((node, Address(branch.name, state, operation)))
                into.append([])
            into[at].append(node)
    goals = [number[branch.activating]] if branch.activating in number else []
    good = _leading(into, goals) if root else [True] * len(keys)
    return SpacePart((branch.name,), keys, depths, good, came)


def _good(found: Exploration) -> list[bool]:
    """Return from which configurations a goal can be reached."""
    into: list[list[int]] = [[] for _ in range(len(found))]
    for node in range(found.expanded):
        for target in found.onward(node):
            into[target].append(node)
    at_goal = found.space.at_goal
    return _leading(into, [node for node, key in enumerate(found.keys) if at_goal(key)])


def _leading(into: Sequence[Sequence[int]], goals: Sequence[int]) -> list[bool]:
    """Return which nodes lead to a goal. ``into`` has for each node those before it."""
    found = [False] * len(into)
    for node in goals:
        found[node] = True
    waiting = deque(goals)
    while waiting:
        heed()
        for before in into[waiting.popleft()]:
            if not found[before]:
                found[before] = True
                waiting.append(before)
    return found


def configuration_of(blueprint: Blueprint, names: Sequence[str], key: Key) -> Mapping[str, str]:
    """Return a configuration with the names of its SBs, in the order of the file."""
    here = dict(zip(names, key, strict=True))
    return {name: here[name] for name in blueprint.branches if name in here}
