"""The age of a reading compared with its largest valid age, as bars and words."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil

from smsl_studio.blueprint.check import FactKey, Reading
from smsl_studio.monitor.facts import SourceState

BARS = 4
HAIR = 1e-6
"""The tolerance of times (s), because they are sums of ticks."""
SLOW = 2
"""With so few bars or fewer, the limit is also told in words."""


def limit_of(
    sources: Sequence[SourceState], fact: FactKey, value: str | None, age: float
) -> float | None:
    """Return the largest valid age (s) of the reading that a fact rests on. None if there is no
    limit.

    It is the shortest limit of the sources with this value and age. If no source has this age, as
    with a fact that only people tell, all sources with this value count.
    """
    behind = [one for one in sources if one.fact == fact and one.said.value == value]
    oldest = [one for one in behind if abs(one.said.age - age) < HAIR] or behind
    return min((one.limit for one in oldest if one.limit is not None), default=None)


def bars(age: float | None, limit: float | None) -> int:
    """Return how much of its valid time a reading has left, in bars from 1 to 4.

    0 means that the age is not known, as in a recording. Without a limit all bars are shown.
    """
    if age is None:
        return 0
    if limit is None:
        return BARS
    return min(max(ceil(BARS * (1 - age / limit)), 1), BARS)


def slow_words(age: float | None, limit: float | None) -> str:
    """Return the words for a reading that has used up half of its valid time, otherwise the empty
    text.
    """
    if age is None or limit is None or bars(age, limit) > SLOW:
        return ""
    return f", limit {age_words(limit)}"


def age_of_nothing(reading: Reading) -> float | None:
    """Return the age (s) of a reading without a value. None if there never was one."""
    return reading.age or None


def age_of(age: float, limit: float | None) -> str:
    """Return an age with its limit, such as ``12 ms old, at most 300 ms``."""
    most = "" if limit is None else f", at most {age_words(limit)}"
    return f"{age_words(age)} old{most}"


def age_words(seconds: float) -> str:
    """Return an age in words: in ms below one second, else in s."""
    return f"{seconds * 1000:.0f} ms" if seconds < 0.9995 else f"{seconds:.1f} s"
