"""Facts: the digits in the name of a state, of any width and alphabet."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import compress, count, repeat
from operator import ne
from typing import NamedTuple


def fact_string(name: str, num_facts: int | None) -> str:
    """Return the part of a state's name with the facts.

    It is the rest after ``State_`` or ``State``. Otherwise it is the text after the last ``_``, or
    else the last NUM_FACTS characters.
    """
    for prefix in ("State_", "State"):
        if name.startswith(prefix):
            return name[len(prefix) :]
    if "_" in name:
        return name.rpartition("_")[2]
    return name[-num_facts:] if num_facts else name


def fact_strings(names: Iterable[str], num_facts: int | None) -> list[str]:
    """The fact string of each name; most names begin alike, and take no call."""
    return [name[6:] if name[:6] == "State_" else fact_string(name, num_facts) for name in names]


def changed_digits(before: Sequence[str], after: Sequence[str]) -> tuple[int, ...]:
    """Return the digits in which the facts of two states of one SB differ."""
    return () if before == after else tuple(compress(count(), map(ne, before, after)))


class FactShape(NamedTuple):
    """How the names of an SB's states show their facts.

    ``width`` is the number of characters of one fact. ``opaque`` says that the names cannot be
    split into facts, so each state has one fact: its own name. ``misfits`` are the states whose
    fact string does not fit (rule R05). ``written`` is NUM_FACTS.
    """

    num_facts: int
    width: int
    opaque: bool = False
    misfits: tuple[str, ...] = ()
    written: int | None = None

    def values(self, state: str) -> tuple[str, ...]:
        """Return the fact values in a state's name, digit 0 first."""
        if self.opaque:
            return (state,)
        text = fact_string(state, self.written)
        if self.width == 1:
            return tuple(text)
        return tuple(text[i : i + self.width] for i in range(0, len(text), self.width))

    def alphabet(self, states: Iterable[str]) -> tuple[tuple[str, ...], ...]:
        """The values each digit takes in these states, sorted; empty where there are none."""
        if self.opaque:
            names = tuple(sorted(set(states)))
            return (names,) if names else ()
        # One text of all states, cut by digit and not by state: there may be very many.
        text, step = "".join(fact_strings(states, self.written)), self.num_facts * self.width
        if not text:
            return ()
        cut = [text[place::step] for place in range(step)]
        if self.width > 1:
            digits = (cut[at : at + self.width] for at in range(0, step, self.width))
            return tuple(tuple(sorted(map("".join, set(zip(*d, strict=True))))) for d in digits)
        return tuple(tuple(sorted(set(digit))) for digit in cut)


def shape_of(states: Iterable[str], num_facts: int | None) -> FactShape:
    """Return the shape that fits the names. It is opaque if none fits."""
    names = list(states)
    lengths = list(map(len, fact_strings(names, num_facts)))
    counts = Counter(lengths)
    common = max(counts, key=lambda n: (counts[n], n), default=0)
    misfits = tuple(compress(names, map(ne, lengths, repeat(common))))
    if num_facts is None:
        if misfits or common == 0:
            return FactShape(1, 0, opaque=True, misfits=misfits or tuple(names))
        return FactShape(common, 1)
    if num_facts < 1:
        return FactShape(1, 0, opaque=True, misfits=tuple(names), written=num_facts)
    if common == 0 or common % num_facts:
        return FactShape(1, 0, True, tuple(names), num_facts)
    if misfits:
        return FactShape(1, 0, True, misfits, num_facts)
    return FactShape(num_facts, common // num_facts, written=num_facts)
