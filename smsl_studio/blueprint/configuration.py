"""Configuration: the active state of every SB, and the conditions for it.

The invariant (paper, Eq. 6): a digit with a sub-SB is on if and only if the sub-SB is in its
ACTIVATING state. Flags are computed from a configuration and never stored.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import cached_property
from heapq import heappop, heappush
from typing import TYPE_CHECKING

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import RunRefused

if TYPE_CHECKING:
    from smsl_studio.blueprint.check import FactKey

Configuration = Mapping[str, str]


class Hierarchy:
    """The base SBs and sub-SBs of a blueprint, computed once. RunRefused for a cycle of SUB_SBS.

    ``order`` has every SB, bases before their sub-SBs, else in file order. A sub-SB that does not
    exist, or a digit that no state has, is left out, and inspection reports it (R07).
    """

    def __init__(self, blueprint: Blueprint) -> None:
        self.blueprint = blueprint
        self.subs: dict[str, tuple[tuple[int, str], ...]] = {}
        self.bases: dict[str, list[tuple[str, int]]] = {name: [] for name in blueprint.branches}
        for branch in blueprint:
            found = [
                (digit, sub)
                for digit, sub in sorted(branch.subs.items())
                if sub in blueprint.branches and 0 <= digit < branch.num_facts
            ]
            self.subs[branch.name] = tuple(found)
            for digit, sub in found:
                self.bases[sub].append((branch.name, digit))
        self.roots = tuple(name for name in blueprint.branches if not self.bases[name])
        self.order = self._bases_first()
        self._trees: dict[str, tuple[str, ...]] = {}

    def _bases_first(self) -> tuple[str, ...]:
        """Return the SBs in an order in which each follows its bases, otherwise in file order."""
        names = tuple(self.blueprint.branches)
        number = {name: index for index, name in enumerate(names)}
        waiting = {name: len(bases) for name, bases in self.bases.items()}
        free = [number[name] for name in self.roots]
        order: list[str] = []
        while free:
            name = names[heappop(free)]
            order.append(name)
            for _, sub in self.subs[name]:
                waiting[sub] -= 1
                if not waiting[sub]:
                    heappush(free, number[sub])
        if len(order) < len(names):
            circle = [name for name, count in waiting.items() if count]
            more = f" and {len(circle) - _SHOWN:,} more" if len(circle) > _SHOWN else ""
            raise RunRefused(
                f"the sub-SBs go round in a circle: {', '.join(circle[:_SHOWN])}{more}",
                advice="Detach one of them.",
            )
        return tuple(order)

    def tree(self, branch: str) -> tuple[str, ...]:
        """Return the SB and everything below it, bases before their sub-SBs."""
        if branch not in self._trees:
            found = _spread(branch, lambda name: (sub for _, sub in self.subs[name]))
            self._trees[branch] = tuple(sorted(found, key=self._place.__getitem__))
        return self._trees[branch]

    def roots_of(self, branch: str) -> tuple[str, ...]:
        """Return the roots above an SB in file order. A root is its own root."""
        above = _spread(branch, lambda name: (base for base, _ in self.bases[name]))
        return tuple(sorted(above & self._roots, key=self._place.__getitem__))

    @cached_property
    def _place(self) -> Mapping[str, int]:
        return {name: index for index, name in enumerate(self.order)}

    @cached_property
    def _roots(self) -> frozenset[str]:
        return frozenset(self.roots)


_SHOWN = 12
"""The largest number of SBs of a cycle that are named."""


def _spread(start: str, near: Callable[[str], Iterable[str]]) -> set[str]:
    """Return everything that ``near`` leads to from an SB, with the SB itself."""
    found, waiting = {start}, [start]
    while waiting:
        for name in near(waiting.pop()):
            if name not in found:
                found.add(name)
                waiting.append(name)
    return found


def start_configuration(hierarchy: Hierarchy, given: Mapping[str, str]) -> dict[str, str]:
    """Return the configuration in which a run starts (clause 3). RunRefused says why it cannot.

    Bases come first. A root starts in the given state or in INITIAL. A sub-SB starts in ACTIVATING
    if its digit is on, else in INITIAL. A given state of a sub-SB counts if it agrees with the
    bases.
    """
    found: dict[str, str] = {}
    for name in hierarchy.order:
        branch = hierarchy.blueprint[name]
        wanted = given.get(name)
        bases = hierarchy.bases[name]
        if bases and branch.initial == branch.activating:
            raise RunRefused(
                f"{name} is a sub-SB and its INITIAL is its ACTIVATING, {branch.initial}",
                advice="Choose another INITIAL or ACTIVATING, so that the fact can change.",
            )
        if bases:
            start = branch.activating if _is_on(hierarchy, found, name) else branch.initial
            if wanted is not None and (wanted == branch.activating) == (start == branch.activating):
                start = wanted
            elif wanted is not None:
                raise RunRefused(
                    f"the start {name}/{wanted} disagrees with {_bases_said(found, bases)}",
                    advice=f"Start {name} in {start}, or its base elsewhere.",
                )
        else:
            start = branch.initial if wanted is None else wanted
        if start not in branch.table:
            raise RunRefused(f"{name} has no state {start!r} to start in")
        found[name] = start
    return found


def _is_on(hierarchy: Hierarchy, found: Configuration, sub: str) -> bool:
    bases = hierarchy.bases[sub]
    votes = {hierarchy.blueprint[base].is_on(found[base], digit) for base, digit in bases}
    if len(votes) == 2:
        raise RunRefused(
            f"the bases of {sub} disagree about it: {_bases_said(found, bases)}",
            advice="Start them where the fact has one value.",
        )
    return votes == {True}


def _bases_said(found: Configuration, bases: Iterable[tuple[str, int]]) -> str:
    return ", ".join(f"{base}/{found[base]} (digit {digit})" for base, digit in bases)


def disagreements(hierarchy: Hierarchy, configuration: Configuration) -> tuple[FactKey, ...]:
    """Return the digits that break the invariant: on without the sub-SB in ACTIVATING, or off with
    it.
    """
    return tuple(
        (base, digit)
        for base in hierarchy.order
        for digit, sub in hierarchy.subs[base]
        if hierarchy.blueprint[base].is_on(configuration[base], digit)
        != (configuration[sub] == hierarchy.blueprint[sub].activating)
    )


def standing(hierarchy: Hierarchy, branch: str, state: str) -> dict[str, str]:
    """Return ``branch`` in ``state``, and everything below it as at a start.

    ``subs: load`` leaves a sub-SB and everything below it in these states (clauses 5 and 14).
    """
    found = {branch: state}
    for name in hierarchy.tree(branch):
        for digit, sub in hierarchy.subs[name]:
            below = hierarchy.blueprint[sub]
            on = hierarchy.blueprint[name].is_on(found[name], digit)
            found[sub] = below.activating if on else below.initial
    return found


def flags(blueprint: Blueprint, configuration: Configuration) -> dict[FactKey, str]:
    """Return the value of every fact in a configuration, which the dispatcher believes."""
    return {
        (name, digit): value
        for name, state in configuration.items()
        for digit, value in enumerate(blueprint[name].facts(state))
    }
