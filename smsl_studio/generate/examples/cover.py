"""The shortest condition that holds in some examples and not in others.

Two forms are tried: literals and excluded pairs that all hold ("a = 0 and not (b = 1 and c = 2)"),
and alternatives ("a = 0 and b = 1 or c = 2"). Both are covers, found greedily.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from smsl_studio.generate.examples.atoms import Atoms, Literal, equal_text
from smsl_studio.stop import heed

_MOST_TERMS = 40
_MOST_JOINED = {1: 100_000, 2: 200, 3: 40}
_MOST_PAIRED = 160


@dataclass(frozen=True)
class Clause:
    """A part of a condition: all of these literals, or (``excluded``) not all of them."""

    literals: tuple[Literal, ...]
    excluded: bool = False

    @property
    def cost(self) -> float:
        """How much there is to read."""
        return sum(one.cost for one in self.literals) + (0.5 if len(self.literals) > 1 else 0)

    @property
    def mask(self) -> int:
        """The examples in which all literals hold."""
        mask = self.literals[0].mask
        for one in self.literals[1:]:
            mask &= one.mask
        return mask


@dataclass(frozen=True)
class Formula:
    """``every`` of these clauses, and ``some`` of those (any, if there are none)."""

    every: tuple[Clause, ...] = ()
    some: tuple[Clause, ...] = ()

    @property
    def cost(self) -> float:
        """How much there is to read."""
        return sum(one.cost for one in (*self.every, *self.some))


def condition_of(
    atoms: Atoms, literals: Sequence[Literal], wanted: int, other: int
) -> Formula | None:
    """Return a formula that holds in all of ``wanted`` and in none of ``other``.

    None if the literals cannot tell them apart, or only with very many parts.
    """
    if not other:
        return Formula()
    units = _units(atoms, literals, wanted, other)
    chosen, left = _covering([Clause((one,)) for one in units], other, atoms.full)
    found: list[Formula] = []
    if not left:
        return Formula(tuple(chosen))
    pairs = _excluded(literals, wanted, left)
    if pairs is not None:
        found.append(Formula((*chosen, *pairs)))
    some = _alternatives(literals, wanted, left)
    if some is not None:
        found.append(Formula(tuple(chosen), some))
    plain = _alternatives(literals, wanted, other)
    if plain is not None:
        found.append(Formula((), plain))
    return min(found, key=lambda one: one.cost, default=None)


def _units(atoms: Atoms, literals: Sequence[Literal], wanted: int, other: int) -> list[Literal]:
    """Return the literals that hold in all wanted examples and exclude some others."""
    found = [one for one in literals if not wanted & ~one.mask and other & ~one.mask]
    for fact in atoms.terms.facts:
        values = atoms.values_in(fact, wanted)
        told = all(atoms.terms.valid(fact, one, atoms.alphabets) for one in values)
        if len(values) > 1 and told:
            one = atoms.one_of(fact, values)
            if other & ~one.mask:
                found.append(one)
    return found


def _covering(clauses: Sequence[Clause], other: int, full: int) -> tuple[list[Clause], int]:
    """Choose clauses that exclude as many of ``other`` as they can. Return the rest, too."""
    cuts: dict[int, Clause] = {}
    for one in clauses:
        cut = other & (one.mask if one.excluded else full & ~one.mask)
        known = cuts.get(cut)
        if cut and (known is None or one.cost < known.cost):
            cuts[cut] = one
    reach = 0
    for cut in cuts:
        reach |= cut
    left = other & ~reach
    few = _fewest(cuts, reach)
    if few is not None:
        return few, left
    chosen: list[int] = []
    rest = reach
    while rest and len(chosen) < _MOST_TERMS:
        heed()
        best = max(cuts, key=lambda cut: ((cut & rest).bit_count() / cuts[cut].cost, -cut))
        chosen.append(best)
        rest &= ~best
    return [cuts[cut] for cut in _needed(chosen, cuts)], left | rest


def _fewest(cuts: dict[int, Clause], reach: int) -> list[Clause] | None:
    """Return the cheapest one, two or three clauses that exclude all that can be excluded."""
    best: tuple[float, list[Clause]] | None = None
    for count in (1, 2, 3):
        if len(cuts) > _MOST_JOINED[count]:
            break
        for some in combinations(cuts, count):
            mask = 0
            for cut in some:
                mask |= cut
            if mask == reach:
                clauses = [cuts[cut] for cut in some]
                cost = sum(one.cost for one in clauses)
                if best is None or cost < best[0]:
                    best = cost, clauses
        heed()
    return None if best is None else best[1]


def _needed(chosen: Sequence[int], cuts: dict[int, Clause]) -> list[int]:
    """Leave out what the others exclude as well, the dearest first."""
    kept = list(chosen)
    for cut in sorted(chosen, key=lambda one: -cuts[one].cost):
        rest = 0
        for one in kept:
            if one != cut:
                rest |= one
        if not cut & ~rest:
            kept.remove(cut)
    return kept


def _excluded(literals: Sequence[Literal], wanted: int, other: int) -> list[Clause] | None:
    """Return excluded pairs, and more where pairs do not do, that exclude all of ``other``."""
    useful = [one for one in literals if one.mask & other][:_MOST_PAIRED]
    pairs: list[Clause] = []
    for at, one in enumerate(useful):
        heed()
        here, there = one.mask & other, one.mask & wanted
        for second in useful[at + 1 :]:
            if here & second.mask and not there & second.mask:
                pairs.append(Clause((one, second), excluded=True))
    full = (1 << max(wanted.bit_length(), other.bit_length())) - 1
    chosen, left = _covering(pairs, other, full)
    while left and len(chosen) < _MOST_TERMS:
        term = _term(literals, left, wanted)
        if term is None:
            return None
        chosen.append(Clause(term.literals, excluded=True))
        left &= ~term.mask
    return chosen if len(chosen) <= _MOST_TERMS and not left else None


def _alternatives(
    literals: Sequence[Literal], wanted: int, other: int
) -> tuple[Clause, ...] | None:
    """Return terms of which one holds in each wanted example, and none in the others."""
    found: list[Clause] = []
    rest = wanted
    while rest and len(found) < _MOST_TERMS:
        term = _term(literals, rest, other)
        if term is None:
            return None
        found.append(term)
        rest &= ~term.mask
    if rest:
        return None
    masks = {one.mask & wanted: one for one in found}
    return tuple(masks[mask] for mask in _needed(list(masks), masks))


def _term(literals: Sequence[Literal], wanted: int, other: int) -> Clause | None:
    """Return literals that all hold in many wanted examples, one at least, and in no other."""
    best: Clause | None = None
    score = -1.0
    for start in _starts(literals, wanted):
        term = _grown(literals, start, wanted, other)
        if term is not None:
            own = (term.mask & wanted).bit_count() / (term.cost + 1)
            if own > score:
                best, score = term, own
    return best


def _starts(literals: Sequence[Literal], wanted: int) -> list[int]:
    """Return some examples to begin with: the first, the last, one in the middle."""
    first = wanted & -wanted
    last = 1 << (wanted.bit_length() - 1)
    return list(dict.fromkeys((first, last)))


def _grown(literals: Sequence[Literal], seed: int, wanted: int, other: int) -> Clause | None:
    """Return literals that hold in ``seed``, added until no other example is left."""
    useful = [one for one in literals if one.mask & seed]
    chosen: list[Literal] = []
    kept, left = wanted, other
    while left:
        heed()
        best, score = None, 0.0
        for one in useful:
            gone = (left & ~one.mask).bit_count()
            if not gone:
                continue
            lost = (kept & ~one.mask).bit_count()
            own = (gone / left.bit_count() - 0.7 * lost / kept.bit_count() + 1) / one.cost**0.5
            if own > score:
                best, score = one, own
        if best is None:
            return None
        chosen.append(best)
        kept &= best.mask
        left &= ~(left & ~best.mask)
    for one in sorted(chosen, key=lambda literal: -literal.cost):
        rest = other
        for second in chosen:
            if second is not one:
                rest &= second.mask
        if not rest and len(chosen) > 1:
            chosen.remove(one)
    return Clause(tuple(chosen))


def formula_text(formula: Formula, atoms: Atoms) -> str:
    """Return a formula as a rule writes it. Empty if it always holds."""
    parts = _every_texts(formula.every, atoms)
    terms = [" and ".join(_inner(one) for one in clause.literals) for clause in formula.some]
    if terms:
        parts.append(terms[0] if len(terms) == 1 else f"({' or '.join(terms)})")
    text = " and ".join(parts)
    if len(parts) == 1 and len(terms) > 1:
        return text[1:-1]
    return text


def _every_texts(clauses: Sequence[Clause], atoms: Atoms) -> list[str]:
    """Return the text of each clause. Several facts that are not equal to one are one text."""
    parts: list[str] = []
    unequal: dict[str, list[str]] = {}
    pairs = [c.literals[0].equal for c in clauses if c.literals[0].negated and len(c.literals) == 1]
    often: dict[str, int] = {}
    for pair in pairs:
        for fact in pair or ():
            often[fact] = often.get(fact, 0) + 1
    for clause in clauses:
        first = clause.literals[0]
        if len(clause.literals) == 1 and first.negated and first.equal is not None:
            one, other = sorted(first.equal, key=lambda fact: -often[fact])
            unequal.setdefault(one, []).append(other)
        elif clause.excluded:
            parts.append(f"not ({' and '.join(_inner(one) for one in clause.literals)})")
        else:
            parts.append(first.text)
    for fact, others in unequal.items():
        shared = [
            value
            for value in sorted({v for own in atoms.alphabets for v in own})
            if all(atoms.terms.valid(one, value, atoms.alphabets) for one in (fact, *others))
        ]
        pairs_of = [(one, _shared(atoms, fact, one)) for one in others]
        if all(own == shared for _, own in pairs_of):
            parts.append(f"not ({equal_text(fact, others, shared)})")
        else:
            parts += [f"not ({equal_text(fact, [one], own)})" for one, own in pairs_of]
    return parts


def _shared(atoms: Atoms, fact: str, other: str) -> list[str]:
    return [
        value
        for value in sorted({v for own in atoms.alphabets for v in own})
        if all(atoms.terms.valid(one, value, atoms.alphabets) for one in (fact, other))
    ]


def _inner(one: Literal) -> str:
    return one.text
