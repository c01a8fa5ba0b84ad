"""Who does, senses, inspects and supervises: human, shared or automatic."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from operator import attrgetter, methodcaller

from .elements import (
    AUTOMATIC,
    HUMAN,
    LEVELS,
    SHARED,
    Blueprint,
    Edge,
    FactKey,
    address,
    escape,
    fact_text,
    parts,
    split_fact,
)
from .errors import UsageError, did_you_mean

DEFAULTS = {"inspection": AUTOMATIC, "supervision": SHARED}
_OF_ACTOR = {"human": HUMAN, "shared": SHARED}


class Levels:
    """The level of each element. ``before`` has what a script sets before the start: it counts
    before what the blueprint declares.
    """

    def __init__(self, blueprint: Blueprint, before: Mapping[str, str]) -> None:
        self._blueprint = blueprint
        self._said = (before, blueprint.levels)
        self.inspection = self._of("inspection") or DEFAULTS["inspection"]
        self.supervision = self._of("supervision") or DEFAULTS["supervision"]
        keys = (key for said in self._said for key in said if "/" in key)
        named = {parts(key)[0] for key in keys}
        self.people_do = {
            branch.name
            for branch in blueprint
            if branch.name in named
            or any(one.actor in _OF_ACTOR or one.confirm for one in branch.operations.values())
        }
        """The SBs in which people may carry out or confirm operations."""

    def operation(self, edge: Edge) -> str:
        """Return who carries out an edge."""
        named = f"{escape(edge.branch)}/{escape(edge.name)}"
        own = (edge.address,) if is_digit(self._blueprint, edge.branch, edge.name) else (
            edge.address, named
        )  # fmt: skip
        return self._of(*own) or _OF_ACTOR.get(edge.terms.actor, AUTOMATIC)

    def fact(self, fact: FactKey) -> str:
        """Return who tells a fact."""
        usual = HUMAN if self._blueprint.flag(fact).told_by_people else AUTOMATIC
        return self._of(fact_text(fact)) or usual

    def by_person(self, edge: Edge) -> bool:
        """Return whether a person carries out an edge instead of its function."""
        return edge.acts and edge.branch in self.people_do and self.operation(edge) == HUMAN

    def less_human(self) -> Iterator[str]:
        """Yield each element that is more automatic than the blueprint declares, in words."""
        before, _ = self._said
        declared = Levels(self._blueprint, {})
        for text, own in self._elements(before):
            was, now = own(declared), own(self)
            if LEVELS.index(now) > LEVELS.index(was):
                yield f"{text} is {now} and not {was}"

    def _elements(self, keys: Iterable[str]) -> Iterator[tuple[str, Callable[[Levels], str]]]:
        """Yield what these keys name: each operation of a name is one."""
        for key in keys:
            name, *more = parts(key)
            if key in DEFAULTS:
                yield key, attrgetter(key)
            elif len(more) == 1 and is_digit(self._blueprint, name, more[0]):
                yield key, methodcaller("fact", (name, int(more[0])))
            else:
                for edge in self._named(name, more):
                    yield edge.address, methodcaller("operation", edge)

    def _named(self, branch: str, names: Sequence[str]) -> Iterator[Edge]:
        own = self._blueprint[branch]
        for state, one in own.states.items():
            for name, target in one.operations.items():
                if names in ([name], [state, name]):
                    yield Edge(branch, state, name, target, own.operation(state, name))

    def _of(self, *keys: str) -> str:
        return next((said[key] for said in self._said for key in keys if key in said), "")


def is_digit(blueprint: Blueprint, branch: str, name: str) -> bool:
    """Return whether ``SB/name`` names a fact. It then names no operation."""
    fact = split_fact(f"{escape(branch)}/{name}")
    return fact is not None and fact[1] < len(blueprint[branch].flags) and str(fact[1]) == name


def must_have_a_level(blueprint: Blueprint, key: str, level: str) -> None:
    """Raise UsageError if nothing of this name can have this level."""
    if level not in LEVELS:
        near = did_you_mean(level, LEVELS) or f"Choose one of {', '.join(LEVELS)}."
        raise UsageError(f"{level!r} is no level of {key}", near)
    names = parts(key)
    branch = blueprint.branches.get(names[0])
    if key in DEFAULTS:
        return
    if branch is not None and len(names) == 2 and is_digit(blueprint, names[0], names[1]):
        if not branch.flags[int(names[1])].sub:
            return
        sub = branch.flags[int(names[1])].sub
        raise UsageError(f"{key} has no level of its own: {sub} expands it")
    edges = [
        (state, name)
        for state, one in (branch.states.items() if branch else ())
        for name in one.operations
    ]
    operations = {name for _, name in edges}
    if not ((len(names) == 2 and names[1] in operations) or names[1:] in edges):
        known = [address(names[0], *edge) for edge in edges]
        raise UsageError(
            f"{key!r} has no level: it is no operation and no fact",
            did_you_mean(key, [*DEFAULTS, *blueprint.branches, *known]),
        )
