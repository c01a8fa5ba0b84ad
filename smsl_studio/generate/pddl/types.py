"""Typed names of PDDL, such as ``a b - block``, and which type is a kind of which."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from smsl_studio.errors import did_you_mean
from smsl_studio.generate.pddl.expressions import Expression
from smsl_studio.stop import heed

OBJECT = "object"
_NAME = re.compile(r"[a-z0-9_][a-z0-9_-]*")
_VARIABLE = re.compile(r"\?[a-z0-9_][a-z0-9_-]*")


class TypedName(NamedTuple):
    """A name with the types it may have: one, or those of ``either``."""

    name: str
    types: tuple[str, ...]
    at: Expression


class TypeTree:
    """The types of a domain. Every type is a kind of ``object``."""

    def __init__(self, told: Sequence[TypedName]) -> None:
        self._parents: dict[str, tuple[str, ...]] = {OBJECT: ()}
        for one in told:
            if one.name == OBJECT:
                continue
            if one.name in self._parents:
                raise one.at.fault(f"the type {one.name!r} stands twice")
            self._parents[one.name] = one.types
        for one in told:
            for parent in one.types:
                # A type that is only named as a parent is one, too.
                self._parents.setdefault(parent, (OBJECT,))
        self._above = {name: frozenset({name, OBJECT}) for name in self._parents}
        for one in told:
            heed()
            self._above[one.name] = self._all_above(one)

    def _all_above(self, told: TypedName) -> frozenset[str]:
        found: set[str] = {told.name, OBJECT}
        waiting = list(self._parents.get(told.name, ()))
        while waiting:
            heed()
            one = waiting.pop()
            if one == told.name and one != OBJECT:
                raise told.at.fault(
                    f"the type {one!r} is a kind of itself",
                    "Take one of the types out of the circle.",
                )
            if one not in found:
                found.add(one)
                waiting += self._parents.get(one, ())
        return frozenset(found)

    def check(self, names: Iterable[TypedName]) -> None:
        """Raise ReadError if a name has a type that there is not."""
        for one in names:
            for kind in one.types:
                if kind not in self._parents:
                    near = did_you_mean(kind, list(self._parents))
                    raise one.at.fault(f"there is no type {kind!r} (of {one.name})", near)

    def fits(self, types: Iterable[str], wanted: Iterable[str]) -> bool:
        """Return whether a thing of one of these types is of one of the wanted types."""
        return any(kind in self._above[own] for own in types for kind in wanted)

    def members(self, wanted: Sequence[str], objects: Mapping[str, tuple[str, ...]]) -> list[str]:
        """Return the objects of some types, in their order."""
        return [name for name, types in objects.items() if self.fits(types, wanted)]


def typed_names(parts: Sequence[Expression], *, variables: bool) -> list[TypedName]:
    """Return the names of a list. ReadError if it is none."""
    found: list[TypedName] = []
    waiting: list[Expression] = []
    rest = iter(parts)
    for one in rest:
        heed()
        if one.word != "-":
            waiting.append(one)
            continue
        kind = next(rest, None)
        if kind is None or not waiting:
            raise one.fault("a type is expected behind '-', and names before it")
        found += [_typed(each, _types(kind), variables) for each in waiting]
        waiting = []
    found += [_typed(each, (OBJECT,), variables) for each in waiting]
    return found


def _typed(one: Expression, types: tuple[str, ...], variables: bool) -> TypedName:
    form = _VARIABLE if variables else _NAME
    if not form.fullmatch(one.word):
        wanted = "a variable such as ?x" if variables else "a name"
        raise one.fault(f"{wanted} is expected, but {one.shown} stands there")
    return TypedName(one.word, types, one)


def _types(kind: Expression) -> tuple[str, ...]:
    if kind.word:
        return (name_of(kind),)
    if kind.head != "either" or len(kind.parts) < 2:
        raise kind.fault("a type, or (either ...), is expected")
    return tuple(name_of(one) for one in kind.rest)


def name_of(one: Expression) -> str:
    """Return the name that an expression is. ReadError if it is none."""
    if not _NAME.fullmatch(one.word):
        raise one.fault(f"a name is expected, but {one.shown} stands there")
    return one.word
