"""The hierarchy of base SBs and sub-SBs in a blueprint."""

from __future__ import annotations

from collections import deque

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.graph.shape import strong


def levels(blueprint: Blueprint) -> dict[str, int]:
    """Return the level of each SB: 0 for a root, else one more than that of its deepest base.

    An SB on a cycle (rule R08), or below one, has no deepest base. It gets the least level that one
    of its bases gives it. If no base gives one, a cycle begins with 0.
    """
    subs = _subs(blueprint)
    waiting = dict.fromkeys(subs, 0)
    for below in subs.values():
        for sub in below:
            waiting[sub] += 1
    found = {name: 0 for name, count in waiting.items() if count == 0}
    queue = deque(found)
    ordered: set[str] = set()
    while queue:
        name = queue.popleft()
        ordered.add(name)
        for sub in subs[name]:
            found[sub] = max(found.get(sub, 0), found[name] + 1)
            waiting[sub] -= 1
            if waiting[sub] == 0:
                queue.append(sub)
    hanging = sorted((found[name], name) for name in found if name not in ordered)
    for name in (*(name for _, name in hanging), *subs):
        if name not in ordered:
            found.setdefault(name, 0)
            _spread(name, subs, found, ordered)
    return {name: found[name] for name in subs}


MOST_CYCLES = 100
"""The largest number of cycles that are looked for. Nobody removes more at once."""


def cycles(blueprint: Blueprint) -> tuple[tuple[str, ...], ...]:
    """Return cycles among SBs. Each is a path by SUB_SBS whose last SB names its first as a sub-SB.

    The result has a shortest cycle through each SB that lies on one and on no cycle before, at most
    ``MOST_CYCLES``.
    """
    subs = _within_cycles(_subs(blueprint))
    found: list[tuple[str, ...]] = []
    covered: set[str] = set()
    for name in subs:
        if name not in covered:
            cycle = _shortest_cycle(name, subs)
            covered.update(cycle)
            found.append(cycle)
            if len(found) == MOST_CYCLES:
                break
    return tuple(found)


def _within_cycles(subs: dict[str, list[str]]) -> dict[str, list[str]]:
    """Return the SBs that lie on cycles, each with its sub-SBs on the same cycles."""
    number = {name: index for index, name in enumerate(subs)}
    group = [0] * len(subs)
    size: list[int] = []
    for index, members in enumerate(strong([[number[s] for s in own] for own in subs.values()])):
        size.append(len(members))
        for member in members:
            group[member] = index
    return {
        name: [sub for sub in own if group[number[sub]] == group[number[name]]]
        for name, own in subs.items()
        if size[group[number[name]]] > 1 or name in own
    }


def _subs(blueprint: Blueprint) -> dict[str, list[str]]:
    return {
        branch.name: list(
            dict.fromkeys(sub for sub, _ in branch.header.sub_sbs if sub in blueprint.branches)
        )
        for branch in blueprint
    }


def _spread(
    start: str, subs: dict[str, list[str]], found: dict[str, int], ordered: set[str]
) -> None:
    queue = deque((start,))
    ordered.add(start)
    while queue:
        name = queue.popleft()
        for sub in subs[name]:
            if sub not in ordered:
                ordered.add(sub)
                found.setdefault(sub, found[name] + 1)
                queue.append(sub)


def _shortest_cycle(start: str, subs: dict[str, list[str]]) -> tuple[str, ...]:
    before: dict[str, str] = {}
    queue = deque((start,))
    while queue:
        name = queue.popleft()
        for sub in subs[name]:
            if sub == start:
                path = [name]
                while path[-1] != start:
                    path.append(before[path[-1]])
                return tuple(reversed(path))
            if sub not in before:
                before[sub] = name
                queue.append(sub)
    return ()
