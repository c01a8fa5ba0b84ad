"""Predicates decided in the plainest way: exact numbers, and at every look all of the past anew.

It shares no code with the program. A predicate is a tree of tuples, which also writes itself as
text. Times are whole milliseconds.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from random import Random
from typing import Any

Tree = tuple[Any, ...]

UNITS = {"mm": ("length", Fraction(1, 1000)), "m": ("length", Fraction(1)),
         "N": ("force", Fraction(1)), "kN": ("force", Fraction(1000)),
         "1": ("", Fraction(1)), "%": ("", Fraction(1, 100)), "degC": ("warmth", Fraction(1)),
         "s": ("time", Fraction(1)), "ms": ("time", Fraction(1, 1000))}  # fmt: skip
"""What each unit measures, and how much of the plain unit it is."""


@dataclass
class PlainSource:
    """A source: its unit, its range, and all samples that it has sent.

    ``heard`` has for each sample that arrived: when (ms), its sequence, and its numbers, or None.
    """

    unit: str
    position: bool = False
    low: Fraction | None = None
    high: Fraction | None = None
    max_age: int = 300
    heard: list[tuple[int, int, tuple[Fraction, ...] | None]] = field(default_factory=list)

    def counted(self, at: int) -> list[tuple[int, tuple[Fraction, ...] | None]]:
        """The samples until a time that no later one has overtaken, as time and numbers."""
        found, highest = [], 0
        for when, sequence, numbers in self.heard:
            if when <= at and sequence > highest:
                highest = sequence
                found.append((when, numbers if self.fits(numbers) else None))
        return found

    def fits(self, numbers: tuple[Fraction, ...] | None) -> bool:
        """Whether a sample is good."""
        if numbers is None or len(numbers) != (3 if self.position else 1):
            return False
        inside = (
            (self.low is None or one >= self.low) and (self.high is None or one <= self.high)
            for one in numbers
        )
        return all(inside)

    def value(self, at: int) -> tuple[Fraction, ...] | None:
        """What it measures at a time, in plain units."""
        counted = self.counted(at)
        if not counted or at - counted[-1][0] > self.max_age or counted[-1][1] is None:
            return None
        return tuple(one * UNITS[self.unit][1] for one in counted[-1][1])

    def good(self, at: int) -> int | None:
        """When its newest good sample came."""
        return max((when for when, one in self.counted(at) if one is not None), default=None)


@dataclass
class PlainFact:
    """A fact with its sources, the trees of its values, and the times (ms) of all looks."""

    sources: dict[str, PlainSource]
    values: dict[str, Tree]
    looks: list[int] = field(default_factory=list)

    def look(self, now: int) -> str | None:
        """The value of the fact at a new look."""
        self.looks.append(now)
        return self.value(len(self.looks) - 1)

    def value(self, at: int) -> str | None:
        """The value at a look, by its number."""
        said = self.said(at)
        if isinstance(said, str):
            return said
        if said is not None:  # none is true, and none is unknown
            for before in range(at - 1, -1, -1):
                if self.looks[at] - self.looks[before] > self.longest:
                    return None
                said = self.said(before)
                if not isinstance(said, list):
                    return said
        return None

    def said(self, at: int) -> str | list[str] | None:
        """The value that is true at a look, an empty list if none is, None if that is unknown."""
        truths = {value: self.truth(tree, at) for value, tree in self.values.items()}
        true = [value for value, truth in truths.items() if truth]
        if len(true) > 1 or None in truths.values():
            return None
        return true[0] if true else []

    @property
    def longest(self) -> int:
        """The largest age (ms) of any source."""
        return max(one.max_age for one in self.sources.values())

    def truth(self, tree: Tree, at: int) -> bool | None:
        """Whether a condition holds at a look."""
        kind, *parts = tree
        if kind == "not":
            inner = self.truth(parts[0], at)
            return None if inner is None else not inner
        if kind in ("and", "or"):
            truths = [self.truth(one, at) for one in parts[0]]
            decides = kind == "or"
            if decides in truths:
                return bool(decides)
            return None if None in truths else not decides
        if kind == "for":
            return self.lasting(parts[0], parts[1], at)
        return self.compared(parts, at)

    def lasting(self, tree: Tree, long: int, at: int) -> bool | None:
        """Whether a condition has held for a time (ms) until a look."""
        now = self.looks[at]
        truths = [self.truth(tree, one) for one in range(at + 1)]
        if truths[at] is False:
            return False
        for one in range(at):
            begin, end = self.looks[one], self.looks[one + 1]
            until = begin if end - begin > self.longest else end
            if truths[one] is False and until > now - long:
                return False
        first = at
        while first >= 0 and truths[first]:
            if self.looks[first] <= now - long:
                return True
            if first and self.looks[first] - self.looks[first - 1] > self.longest:
                return None
            first -= 1
        return None

    def compared(self, parts: list[Any], at: int) -> bool | None:
        """Whether a measure is below or above a number."""
        measure, sign, number, unit = parts
        limit = number * UNITS[unit][1]
        if measure[0] == "age" and self.sources[measure[1]].good(self.looks[at]) is None:
            waited = Fraction(self.looks[at] - self.looks[0], 1000)
            beyond = bool(waited > limit if sign in (">", "<=") else waited >= limit)
            return sign in (">", ">=") if beyond else None
        value = self.number(measure, self.looks[at])
        if value is None:
            return None
        if measure[0] == "distance":
            limit = limit * limit if limit >= 0 else Fraction(-1)
        return _in_order(value, sign, limit)

    def number(self, tree: Tree, now: int) -> Fraction | None:
        """The number of a measure in plain units; of a distance, its square."""
        kind, *parts = tree
        if kind == "name":
            found = self.sources[parts[0]].value(now)
            return None if found is None else found[0]
        if kind == "age":
            good = self.sources[parts[0]].good(now)
            return None if good is None else Fraction(now - good, 1000)
        if kind == "distance":
            one, other = (self.sources[name].value(now) for name in parts)
            if one is None or other is None:
                return None
            return sum(((a - b) ** 2 for a, b in zip(one, other, strict=True)), Fraction())
        numbers = [self.number(one, now) for one in parts[0]]
        known = [one for one in numbers if one is not None]
        if len(known) < len(numbers):
            return None
        if kind == "abs":
            return abs(known[0])
        if kind in ("min", "max"):
            return min(known) if kind == "min" else max(known)
        return known[0] + known[1] if kind == "+" else known[0] - known[1]


def _in_order(value: Fraction, sign: str, limit: Fraction) -> bool:
    if value == limit:
        return sign in ("<=", ">=")
    return (value < limit) == (sign in ("<", "<="))


def written(tree: Tree) -> str:
    """A predicate as text."""
    kind, *parts = tree
    if kind == "name":
        return str(parts[0])
    if kind in ("age", "distance"):
        return f"{kind}({', '.join(parts)})"
    if kind in ("abs", "min", "max"):
        return f"{kind}({', '.join(map(written, parts[0]))})"
    if kind in ("+", "-"):
        left, right = parts[0]
        inner = f"({written(right)})" if right[0] in ("+", "-") else written(right)
        return f"{written(left)} {kind} {inner}"
    if kind == "compare":
        measure, sign, number, unit = parts
        said = f"{float(number)!r}" if unit == "1" else f"{float(number)!r} {unit}"
        return f"{written(measure)} {sign} {said}"
    if kind == "not":
        return f"not {_bracketed(parts[0])}"
    if kind == "for":
        inner = written(parts[0]) if parts[0][0] == "not" else _bracketed(parts[0])
        return f"{inner} for {parts[1] / 1000!r} s"
    return f" {kind} ".join(written(one) if one[0] not in ("and", "or") else f"({written(one)})"
                            for one in parts[0])  # fmt: skip


def _bracketed(tree: Tree) -> str:
    return written(tree) if tree[0] == "compare" else f"({written(tree)})"


def random_fact(chance: Random) -> PlainFact:
    """A fact of one to four sources and two or three values."""
    kind = chance.choice(("length", "length", "force", "", "warmth"))
    units = [unit for unit, (what, _) in UNITS.items() if what == kind]
    sources = {}
    for name in "abcd"[: chance.randint(1, 4)]:
        source = sources[name] = PlainSource(chance.choice(units))
        source.position = kind == "length" and chance.random() < 0.3
        source.max_age = chance.choice((100, 300, 300, 500))
        if chance.random() < 0.3:
            source.low, source.high = Fraction(-6), Fraction(6)
    if chance.random() < 0.5:
        tree = _measure(chance, sources, 2)
        low = _comparison(chance, sources, tree, "<")
        high = ("compare", tree, ">", low[3] + chance.choice((0, 1, 2)), low[4])
        values = {"0": low, "1": high}
        for value, tree in values.items():
            if chance.random() < 0.3:
                values[value] = ("for", tree, chance.choice((50, 100, 200, 400)))
    else:
        values = {v: _condition(chance, sources, 2) for v in "012"[: chance.choice((1, 2, 2, 3))]}
    return PlainFact(sources, values)


def _condition(chance: Random, sources: dict[str, PlainSource], depth: int) -> Tree:
    kind = chance.choice(("compare", "compare", "not", "and", "or", "for")) if depth else "compare"
    if kind == "compare":
        return _comparison(chance, sources, _measure(chance, sources, 2))
    if kind == "not":
        return "not", _condition(chance, sources, depth - 1)
    if kind == "for":
        return "for", _condition(chance, sources, depth - 1), chance.choice((50, 100, 200, 400))
    parts = [_condition(chance, sources, depth - 1) for _ in range(chance.randint(2, 3))]
    return kind, parts


def _comparison(
    chance: Random, sources: dict[str, PlainSource], tree: Tree, sign: str = ""
) -> Tree:
    """A comparison that no rounding decides: of measures in one unit it may be with an equal
    number, of others only with numbers that none of them can have."""
    sign = sign or chance.choice(("<", "<=", ">", ">="))
    if tree[0] == "age":
        return "compare", tree, sign, Fraction(2 * chance.randint(0, 700) + 1, 2), "ms"
    names = _names(tree)
    units = {sources[name].unit for name in names}
    if len(units) == 1 and tree[0] != "distance":
        return "compare", tree, sign, Fraction(chance.randint(-40, 40), 8), units.pop()
    unit = chance.choice(sorted(units))
    return "compare", tree, sign, Fraction(2 * chance.randint(-200, 200) + 1, 128), unit


def _names(tree: Tree) -> list[str]:
    if tree[0] in ("name", "age", "distance"):
        return list(tree[1:])
    return [name for one in tree[1] for name in _names(one)]


def _measure(chance: Random, sources: dict[str, PlainSource], depth: int) -> Tree:
    plain = [name for name, one in sources.items() if not one.position]
    places = [name for name, one in sources.items() if one.position]
    if depth == 2 and chance.random() < 0.15:
        return "age", chance.choice(sorted(sources))
    if places and (not plain or chance.random() < 0.3):
        return "distance", chance.choice(places), chance.choice(places)
    kind = chance.choice(("name", "name", "abs", "min", "max", "+", "-")) if depth else "name"
    if kind == "name":
        return "name", chance.choice(plain)
    many = {"abs": 1, "+": 2, "-": 2}.get(kind) or chance.randint(1, 3)
    inner = [_inner(chance, plain, depth - 1) for _ in range(many)]
    return kind, inner


def _inner(chance: Random, plain: list[str], depth: int) -> Tree:
    kind = chance.choice(("name", "name", "abs", "+", "-")) if depth else "name"
    if kind == "name":
        return "name", chance.choice(plain)
    many = 1 if kind == "abs" else 2
    return kind, [_inner(chance, plain, depth - 1) for _ in range(many)]
