"""How old a reading is against how old it may be: what the bars of quality show."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil

from smsl_studio.blueprint.check import FactKey, Reading
from smsl_studio.monitor.facts import SourceState

BARS = 4
HAIR = 1e-6
"""Seconds that two sums of ticks may differ by."""
SLOW = 2
"""With so few bars left the limit is said in words as well."""


def limit_of(
    sources: Sequence[SourceState], fact: FactKey, value: str | None, age: float
) -> float | None:
    """How long (s) the source whose reading is that old is evidence; None: no time is set.

    Of several the shortest. Sources that stand by the value do not all count, as with a fact that
    only people answer.
    """
    behind = [one for one in sources if one.fact == fact and one.said.value == value]
    oldest = [one for one in behind if abs(one.said.age - age) < HAIR] or behind
    return min((one.limit for one in oldest if one.limit is not None), default=None)


def bars(age: float | None, limit: float | None) -> int:
    """Of four, how much of its time a reading has left; one at least while it is evidence.

    None where its age is not known, as in a recording; all where no time is set.
    """
    if age is None:
        return 0
    if limit is None:
        return BARS
    return min(max(ceil(BARS * (1 - age / limit)), 1), BARS)


def slow_words(age: float | None, limit: float | None) -> str:
    """What is added to a row whose reading has used up half of its time."""
    if age is None or limit is None or bars(age, limit) > SLOW:
        return ""
    return f", limit {age_words(limit)}"


def age_of_nothing(reading: Reading) -> float | None:
    """How old what is no value any more is; None where nothing was ever said."""
    return reading.age or None


def age_of(age: float, limit: float | None) -> str:
    """An age beside its limit: 12 ms old, at most 300 ms."""
    most = "" if limit is None else f", at most {age_words(limit)}"
    return f"{age_words(age)} old{most}"


def age_words(seconds: float) -> str:
    """An age for people: ms below a second, then s."""
    return f"{seconds * 1000:.0f} ms" if seconds < 0.9995 else f"{seconds:.1f} s"
