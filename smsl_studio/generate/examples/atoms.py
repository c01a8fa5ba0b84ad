"""What a condition may be made of: comparisons of facts, as sets of examples in bits.

Bit ``i * states + s`` of a set stands for operation ``i`` of a family in state ``s``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.properties.formula_text import written_name, written_plain
from smsl_studio.generate.examples.family import Family
from smsl_studio.generate.examples.table import Values
from smsl_studio.stop import heed

_UNEQUAL_COST, _COUNT_COST, _EQUAL_COST = 1.1, 2.5, 3.0
_MOST_COUNTED = 12


@dataclass(frozen=True, slots=True)
class Literal:
    """A condition: the examples in which it holds, its text, and how much there is to read."""

    mask: int
    text: str
    cost: float
    equal: tuple[str, str] | None = None
    """The two facts, if it says that two facts are equal, or that they are not."""
    negated: bool = False


@dataclass(frozen=True)
class FamilyTerms:
    """The facts and values of a family as its rule writes them.

    ``facts`` has, for each way to write a fact, the digit in each operation of the family.
    ``values`` has, for each way to write a value, the value in each operation.
    """

    facts: Mapping[str, tuple[int, ...]]
    values: Mapping[str, tuple[str, ...]]

    def valid(self, fact: str, value: str, alphabets: Sequence[Sequence[str]]) -> bool:
        """Return whether the fact has the value in every operation."""
        pairs = zip(self.facts[fact], self.values[value], strict=True)
        return all(text in alphabets[digit] for digit, text in pairs)


def terms_of(
    family: Family, names: Sequence[str], alphabets: Sequence[Sequence[str]]
) -> FamilyTerms:
    """Return the terms of a family; ``names`` has the names of the facts."""
    size = len(family.operations)
    facts = {name: (digit,) * size for digit, name in enumerate(names)}
    places = {name: digit for digit, name in enumerate(names)}
    # The name of a fact that is only its digit says nothing about the words of operations.
    named = [name for digit, name in enumerate(names) if name != digit_name(digit)]
    for pattern, made in family.fact_terms(named).items():
        facts[pattern] = tuple(places[name] for name in made)
    every = sorted({value for alphabet in alphabets for value in alphabet})
    values = {value: (value,) * size for value in every}
    values |= family.value_terms(every)
    return FamilyTerms(facts, values)


class Atoms:
    """All literals of a family over some states."""

    def __init__(self, terms: FamilyTerms, states: Sequence[Values]) -> None:
        self.terms = terms
        self._states = states
        self.size = len(next(iter(terms.facts.values())))
        self.full = (1 << (self.size * len(states))) - 1
        self._having = _having(states)
        self.alphabets = [list(own) for own in self._having]

    def holds(self, fact: str, value: str) -> int:
        """Return the examples in which a fact has a value, both as the rule writes them."""
        found = 0
        pairs = zip(self.terms.facts[fact], self.terms.values[value], strict=True)
        for at, (digit, text) in enumerate(pairs):
            found |= self._having[digit].get(text, 0) << (at * len(self._states))
        return found

    def literals(self) -> list[Literal]:
        """Return the comparisons, each with its opposite. One that always or never holds says
        nothing."""
        found: list[Literal] = []
        for fact in self.terms.facts:
            for value in self.terms.values:
                heed()
                if self.terms.valid(fact, value, self.alphabets):
                    mask = self.holds(fact, value)
                    left, right = fact_text(fact), self.value_text(value)
                    found.append(Literal(mask, f"{left} = {right}", 1))
                    negated = Literal(self.full & ~mask, f"{left} != {right}", _UNEQUAL_COST)
                    found.append(negated)
        found += self._counts()
        found += self._equalities()
        seen: dict[int, Literal] = {}
        for one in found:
            known = seen.get(one.mask)
            if one.mask not in (0, self.full) and (known is None or one.cost < known.cost):
                seen[one.mask] = one
        return list(seen.values())

    def one_of(self, fact: str, values: Sequence[str]) -> Literal:
        """Return the literal that a fact has one of some values."""
        mask = 0
        for value in values:
            mask |= self.holds(fact, value)
        name = fact_text(fact)
        text = " or ".join(f"{name} = {self.value_text(value)}" for value in values)
        return Literal(mask, text if len(values) == 1 else f"({text})", len(values))

    def value_text(self, value: str) -> str:
        """Return a value, or its pattern, as a condition writes it."""
        made = self.terms.values[value]
        return value if all(written_name(one) == one for one in made) else written_name(value)

    def values_in(self, fact: str, examples: int) -> list[str]:
        """Return the plain values that a fact has in some examples."""
        every = {value for digit in self.terms.facts[fact] for value in self.alphabets[digit]}
        return [value for value in sorted(every) if self.holds(fact, value) & examples]

    def _counts(self) -> Iterator[Literal]:
        plain = [name for name, digits in self.terms.facts.items() if "{" not in name]
        if not 2 <= len(plain) <= _MOST_COUNTED:
            return
        for value in self.terms.values:
            facts = [one for one in plain if self.terms.valid(one, value, self.alphabets)]
            if len(facts) < 2:
                continue
            listed = ", ".join(fact_text(one) for one in facts)
            counted = f"count({listed} = {self.value_text(value)})"
            least = [self.full] + [0] * len(facts)
            for one in facts:
                heed()
                mask = self.holds(one, value)
                for number in range(len(facts), 0, -1):
                    least[number] |= least[number - 1] & mask
            for number in range(1, len(facts) + 1):
                mask = least[number]
                yield Literal(mask, f"{counted} >= {number}", _COUNT_COST)
                yield Literal(self.full & ~mask, f"{counted} < {number}", _COUNT_COST)

    def _equalities(self) -> Iterator[Literal]:
        facts = list(self.terms.facts)
        for at, one in enumerate(facts):
            for other in facts[at + 1 :]:
                heed()
                shared = [
                    value
                    for value in sorted({v for a in self.alphabets for v in a})
                    if self.terms.valid(one, value, self.alphabets)
                    and self.terms.valid(other, value, self.alphabets)
                ]
                if len(shared) < 2:
                    continue
                mask = 0
                for value in shared:
                    mask |= self.holds(one, value) & self.holds(other, value)
                text = equal_text(one, [other], shared)
                pair = (one, other)
                yield Literal(mask, f"({text})", _EQUAL_COST, pair)
                yield Literal(self.full & ~mask, f"not ({text})", _EQUAL_COST, pair, negated=True)


def equal_text(fact: str, others: Sequence[str], values: Sequence[str]) -> str:
    """Return the text that one of some facts has the same value as a fact."""
    parts = []
    for value in values:
        text = written_name(value)
        if len(others) == 1:
            same = f"{fact_text(others[0])} = {text}"
        else:
            same = f"count({', '.join(fact_text(one) for one in others)} = {text}) > 0"
        parts.append(f"{fact_text(fact)} = {text} and {same}")
    return " or ".join(parts)


def fact_text(name: str) -> str:
    """Return the name of a fact, or its pattern, as a condition writes it."""
    bare = name.replace("{", "").replace("}", "")
    return name if bare.isascii() and bare.isidentifier() and _plain(bare) else written_plain(name)


def digit_name(digit: int) -> str:
    """Return the name of a fact that has no other name."""
    return f"digit {digit}"


def _plain(name: str) -> bool:
    return written_name(name) == name and name != "count"


def _having(states: Sequence[Values]) -> list[dict[str, int]]:
    found: list[dict[str, int]] = [{} for _ in states[0]]
    for at, values in enumerate(states):
        for digit, value in enumerate(values):
            found[digit][value] = found[digit].get(value, 0) | 1 << at
    return [dict(sorted(own.items())) for own in found]
