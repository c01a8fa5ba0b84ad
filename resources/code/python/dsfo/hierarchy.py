"""Base SBs and sub-SBs, and the configurations in which they agree (clauses 1 and 3).

The rule under all others: a digit that a sub-SB expands is on exactly while the sub-SB is in its
ACTIVATING state.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from heapq import heappop, heappush

from .elements import Blueprint, Configuration, FactKey
from .errors import RunRefused


class Hierarchy:
    """Who expands whom. ``order`` has every SB after its bases, else in the order of the file."""

    def __init__(self, blueprint: Blueprint) -> None:
        self.blueprint = blueprint
        self.bases: dict[str, list[FactKey]] = {name: [] for name in blueprint.branches}
        self.subs: dict[str, list[tuple[int, str]]] = {}
        for branch in blueprint:
            digits = [(digit, flag.sub) for digit, flag in enumerate(branch.flags) if flag.sub]
            self.subs[branch.name] = digits
            for digit, sub in digits:
                self.bases[sub].append((branch.name, digit))
        self.roots = tuple(name for name, bases in self.bases.items() if not bases)
        self.order = self._bases_first()
        self.place = {name: index for index, name in enumerate(self.order)}
        self._trees: dict[str, tuple[str, ...]] = {}

    def _bases_first(self) -> tuple[str, ...]:
        names = tuple(self.blueprint.branches)
        number = {name: index for index, name in enumerate(names)}
        waiting = {name: len(bases) for name, bases in self.bases.items()}
        free, order = [number[name] for name in self.roots], list[str]()
        while free:
            name = names[heappop(free)]
            order.append(name)
            for _, sub in self.subs[name]:
                waiting[sub] -= 1
                if not waiting[sub]:
                    heappush(free, number[sub])
        return tuple(order)

    def tree(self, branch: str) -> tuple[str, ...]:
        """Return an SB and everything below it, bases first."""
        if branch not in self._trees:
            found = _spread(branch, lambda name: [sub for _, sub in self.subs[name]])
            self._trees[branch] = tuple(sorted(found, key=self.place.__getitem__))
        return self._trees[branch]

    def roots_of(self, branch: str) -> list[str]:
        """Return the roots above an SB. A root is its own root."""
        above = _spread(branch, lambda name: [base for base, _ in self.bases[name]])
        return [name for name in self.order if name in above and not self.bases[name]]

    def is_active(self, sub: str, state: str) -> bool:
        """Return whether a state is the ACTIVATING state of a sub-SB."""
        return state == self.blueprint[sub].activating

    def rest(self, sub: str, on: bool) -> str:
        """Return where a base puts a sub-SB: ACTIVATING if its digit is on, else INITIAL."""
        branch = self.blueprint[sub]
        return branch.activating if on else branch.initial


def _spread(start: str, near: Callable[[str], Iterable[str]]) -> set[str]:
    found, waiting = {start}, [start]
    while waiting:
        for name in near(waiting.pop()):
            if name not in found:
                found.add(name)
                waiting.append(name)
    return found


def start_configuration(hierarchy: Hierarchy, given: Configuration) -> dict[str, str]:
    """Return where every SB stands at the start: bases first (clause 3). RunRefused if the given
    states disagree.
    """
    found: dict[str, str] = {}
    for name in hierarchy.order:
        branch, wanted = hierarchy.blueprint[name], given.get(name)
        bases = hierarchy.bases[name]
        if not bases:
            found[name] = branch.initial if wanted is None else wanted
            continue
        start = hierarchy.rest(name, _digit_is_on(hierarchy, found, name))
        if wanted is not None:
            if hierarchy.is_active(name, wanted) != hierarchy.is_active(name, start):
                raise RunRefused(
                    f"the start {name}/{wanted} disagrees with {_bases_said(found, bases)}",
                    f"Start {name} in {start}, or its base elsewhere.",
                )
            start = wanted
        found[name] = start
    return found


def _digit_is_on(hierarchy: Hierarchy, found: Configuration, sub: str) -> bool:
    bases = hierarchy.bases[sub]
    votes = {hierarchy.blueprint[base].is_on(found[base], digit) for base, digit in bases}
    if len(votes) == 2:
        raise RunRefused(
            f"the bases of {sub} disagree about it: {_bases_said(found, bases)}",
            "Start them where the fact has one value.",
        )
    return votes == {True}


def _bases_said(found: Configuration, bases: Sequence[FactKey]) -> str:
    return ", ".join(f"{base}/{found[base]} (digit {digit})" for base, digit in bases)


def disagreements(hierarchy: Hierarchy, configuration: Configuration) -> list[FactKey]:
    """Return the digits that are on without their sub-SB in ACTIVATING, or off with it."""
    return [
        (base, digit)
        for base in hierarchy.order
        for digit, sub in hierarchy.subs[base]
        if hierarchy.blueprint[base].is_on(configuration[base], digit)
        != hierarchy.is_active(sub, configuration[sub])
    ]


def standing(hierarchy: Hierarchy, branch: str, state: str) -> dict[str, str]:
    """Return an SB in a state, and everything below it as at a start (``subs: load``)."""
    found = {branch: state}
    for name in hierarchy.tree(branch):
        for digit, sub in hierarchy.subs[name]:
            found[sub] = hierarchy.rest(sub, hierarchy.blueprint[name].is_on(found[name], digit))
    return found
