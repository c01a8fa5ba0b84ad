"""Conditions and effects of actions whose parameters have values.

A condition is a function of a state. A state is a whole number with a bit for each atom that may
change.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.generate.pddl.domain import TOTAL, Domain, unsupported
from smsl_studio.generate.pddl.expressions import Expression
from smsl_studio.generate.pddl.types import TypedName, typed_names
from smsl_studio.stop import heed

Atom = tuple[str, ...]
"""The predicate and its arguments."""
Given = Mapping[str, str]
"""The object of each variable."""
Objects = Mapping[str, tuple[str, ...]]
MOST_PARTS = 1_000_000
"""The most parts of conditions and effects of all actions together."""


@dataclass(frozen=True, slots=True)
class Bits:
    """A condition: all bits of ``on`` are set and none of ``off``."""

    on: int
    off: int = 0

    def __call__(self, state: int) -> bool:
        return state & self.on == self.on and not state & self.off


Condition = Bits | Callable[[int], bool]


@dataclass(frozen=True, slots=True)
class Effect:
    """What is deleted and then added, where a condition holds (None: always)."""

    when: Condition | None
    add: int
    delete: int


def atom_of(
    one: Expression, domain: Domain, objects: Objects, given: Given, *, functions: bool = False
) -> Atom:
    """Return an atom, its variables replaced. ReadError if it does not fit its declaration."""
    known = domain.functions if functions else domain.predicates
    what = "function" if functions else "predicate"
    name = one.word or one.head
    if name not in known:
        near = did_you_mean(name, list(known)) if name else ""
        raise one.fault(f"there is no {what} {name!r}", near)
    declared = known[name]
    if len(one.rest) != len(declared):
        raise one.fault(f"{name} has {len(declared)} arguments, and here are {len(one.rest)}")
    found = [name]
    for part, wanted in zip(one.rest, declared, strict=True):
        value = object_of(part, objects, given)
        if part.word == value and not domain.types.fits(objects[value], wanted.types):
            kinds = " or ".join(wanted.types)
            raise part.fault(f"{value} is no {kinds}, which {name} wants here")
        found.append(value)
    return tuple(found)


_NUMBER = re.compile(r"[0-9]{1,12}(\.[0-9]{1,6})?")


def number_of(one: Expression) -> float | None:
    """Return the number that a word is, None if it is none."""
    return float(one.word) if _NUMBER.fullmatch(one.word) else None


def object_of(part: Expression, objects: Objects, given: Given) -> str:
    """Return the object that a word means."""
    word = part.word
    if word.startswith("?"):
        if word not in given:
            raise part.fault(f"there is no parameter {word}")
        return given[word]
    if word not in objects:
        raise part.fault(f"there is no object {part.shown}", did_you_mean(word, list(objects)))
    return word


class Compiler:
    """Makes functions of conditions and effects.

    ``fluent`` are the predicates that some effect changes; all others are as the beginning has
    them. The bits of atoms are given out as they are met.
    """

    def __init__(
        self,
        domain: Domain,
        objects: Objects,
        init: frozenset[Atom],
        costs: Mapping[Atom, float],
    ) -> None:
        self.domain, self.objects, self.init, self._costs = domain, objects, init, costs
        self.fluent = frozenset(_changed(domain))
        self.bits: dict[Atom, int] = {}
        self._parts = 0
        self.checks_only = False
        """While it is true, a cost that has no value is 0."""

    def bit(self, atom: Atom) -> int:
        """Return the bit of an atom."""
        return 1 << self.bits.setdefault(atom, len(self.bits))

    def condition(self, one: Expression, given: Given) -> Condition | bool:
        """Return a condition, or its truth if it does not depend on the state."""
        self._count()
        head, rest = one.head, one.rest
        if not one.parts:
            if one.word:
                raise one.fault(f"a condition is expected, but {one.shown} stands there")
            return True
        if head in ("and", "or"):
            return _joined([self.condition(part, given) for part in rest], every=head == "and")
        if head == "not":
            return _negated(self.condition(_single(one), given))
        if head == "imply":
            if len(rest) != 2:
                raise one.fault("(imply CONDITION CONDITION) is expected")
            first = _negated(self.condition(rest[0], given))
            return _joined([first, self.condition(rest[1], given)], every=False)
        if head in ("forall", "exists"):
            parts = [self.condition(rest[1], more) for more in self._quantified(one, given)]
            return _joined(parts, every=head == "forall")
        if head == "=":
            if len(rest) != 2 or rest[0].parts or rest[1].parts:
                raise unsupported(one, "a comparison of numbers")
            left, right = (object_of(part, self.objects, given) for part in rest)
            return left == right
        if head in ("<", ">", "<=", ">="):
            raise unsupported(one, "a comparison of numbers")
        if head in ("preference", "always", "sometime", "within", "at-most-once"):
            raise unsupported(one, head)
        return self._atom(atom_of(one, self.domain, self.objects, given))

    def _atom(self, atom: Atom) -> Condition | bool:
        if atom[0] not in self.fluent:
            return atom in self.init
        return Bits(self.bit(atom))

    def effects(self, one: Expression | None, given: Given) -> tuple[list[Effect], float | None]:
        """Return the effects of an action, and its cost. None if the domain knows no costs."""
        found: list[Effect] = []
        costs = [0.0]
        if one is not None:
            self._effect(one, given, None, (found, costs))
        return found, sum(costs) if TOTAL in self.domain.functions else None

    def _effect(
        self,
        one: Expression,
        given: Given,
        when: Condition | None,
        into: tuple[list[Effect], list[float]],
    ) -> None:
        self._count()
        found, costs = into
        head, rest = one.head, one.rest
        if not one.parts:
            if one.word:
                raise one.fault(f"an effect is expected, but {one.shown} stands there")
        elif head == "and":
            for part in rest:
                self._effect(part, given, when, into)
        elif head == "forall":
            for more in self._quantified(one, given):
                self._effect(rest[1], more, when, into)
        elif head == "when":
            if len(rest) != 2:
                raise one.fault("(when CONDITION EFFECT) is expected")
            own = self.condition(rest[0], given)
            if own is not False:
                both = _joined([when if when is not None else True, own], every=True)
                inner = None if isinstance(both, bool) else both
                self._effect(rest[1], given, inner, into)
        elif head == "not":
            found.append(Effect(when, 0, self._changed_bit(_single(one), given)))
        elif head == "increase":
            costs.append(self._increase(one, given, when))
        elif head in ("decrease", "assign", "scale-up", "scale-down", "oneof", "probabilistic"):
            raise unsupported(one, f"the effect {head}")
        else:
            found.append(Effect(when, self._changed_bit(one, given), 0))

    def _changed_bit(self, one: Expression, given: Given) -> int:
        return self.bit(atom_of(one, self.domain, self.objects, given))

    def _increase(self, one: Expression, given: Given, when: Condition | None) -> float:
        rest = one.rest
        if len(rest) != 2 or (rest[0].word or rest[0].head) != TOTAL:
            raise unsupported(one, "a number other than total-cost")
        if when is not None:
            raise unsupported(one, "a cost that depends on a condition")
        number = number_of(rest[1])
        if number is not None:
            return number
        if rest[1].head in ("+", "-", "*", "/"):
            raise unsupported(rest[1], "a sum of costs")
        atom = atom_of(rest[1], self.domain, self.objects, given, functions=True)
        if atom not in self._costs and self.checks_only:
            return 0.0
        if atom not in self._costs:
            shown = f"({' '.join(atom)})"
            raise rest[1].fault(f"the problem gives no value to {shown}")
        return self._costs[atom]

    def _quantified(self, one: Expression, given: Given) -> Iterator[Given]:
        rest = one.rest
        if len(rest) != 2 or rest[0].word:
            raise one.fault(f"({one.head} (?x - type) ...) is expected")
        variables = typed_names(rest[0].parts, variables=True)
        self.domain.types.check(variables)
        ranges = [self.domain.types.members(each.types, self.objects) for each in variables]
        for values in itertools.product(*ranges):
            self._count()
            names = [each.name for each in variables]
            yield {**given, **dict(zip(names, values, strict=True))}

    def conjunction(self, parts: Sequence[Expression], given: Given) -> Condition | bool:
        """Return the condition that all parts hold."""
        return _joined([self.condition(part, given) for part in parts], every=True)

    def members(self, one: TypedName) -> list[str]:
        """Return the objects that a parameter may have."""
        return self.domain.types.members(one.types, self.objects)

    def unchanging(self, part: Expression) -> bool:
        """Return whether a condition has no atom that an effect changes."""
        return not any(one.head in self.fluent for one in _inner(part))

    def variables(self, part: Expression) -> frozenset[str]:
        """Return the variables in a condition."""
        return frozenset(one.word for one in _inner(part) if one.word.startswith("?"))

    def _count(self) -> None:
        heed()
        self._parts += 1
        if self._parts > MOST_PARTS:
            raise UsageError(
                f"the actions have more than {MOST_PARTS:,} parts with all their objects",
                advice="Take fewer objects, or fewer parameters for each action.",
            )


def _changed(domain: Domain) -> Iterator[str]:
    """Give the predicates that some effect changes."""
    waiting = [one.effect for one in domain.actions if one.effect is not None]
    while waiting:
        heed()
        one = waiting.pop()
        if one.head in ("and", "not"):
            waiting += one.rest
        elif one.head in ("forall", "when"):
            waiting += one.rest[1:]
        elif one.head in domain.predicates:
            yield one.head


def _inner(part: Expression) -> Iterator[Expression]:
    waiting = [part]
    while waiting:
        heed()
        one = waiting.pop()
        yield one
        waiting += one.parts


def _single(one: Expression) -> Expression:
    if len(one.parts) != 2:
        raise one.fault("(not ...) has one part")
    return one.parts[1]


def _negated(one: Condition | bool) -> Condition | bool:
    if isinstance(one, bool):
        return not one
    if isinstance(one, Bits) and (one.on | one.off).bit_count() == 1:
        return Bits(one.off, one.on)
    return lambda state: not one(state)


def _joined(parts: Sequence[Condition | bool], *, every: bool) -> Condition | bool:
    """Return whether all parts hold (``every``), or any of them."""
    if any(one is not every for one in parts if isinstance(one, bool)):
        return not every
    left = [one for one in parts if not isinstance(one, bool)]
    if not left:
        return every
    if len(left) == 1:
        return left[0]
    if every:
        bits = [one for one in left if isinstance(one, Bits)]
        if bits:
            on = off = 0
            for one in bits:
                on, off = on | one.on, off | one.off
            left = [Bits(on, off), *(one for one in left if not isinstance(one, Bits))]
        if len(left) == 1:
            return left[0]
        return lambda state: all(one(state) for one in left)
    return lambda state: any(one(state) for one in left)
