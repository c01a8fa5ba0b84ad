"""Scene and state checks: the paper's s and C_state(s) (Eq. 5), in three-valued logic.

A fact is pointed at by ``FactKey``: the SB's name and the digit, counted from 0.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

FactKey = tuple[str, int]


@dataclass(frozen=True, slots=True)
class Reading:
    """What is known of one fact: its value, or None (unknown) with the reason.

    ``age`` is in seconds of the receiver's clock; ``sensed`` is false where nobody senses the
    fact, so that it is believed from the configuration.
    """

    value: str | None
    reason: str = ""
    age: float = 0.0
    sensed: bool = True


@dataclass(frozen=True)
class Scene:
    """The facts as sensed at one instant (the paper's *s*); nobody senses what is not in it."""

    readings: Mapping[FactKey, Reading] = field(default_factory=lambda: MappingProxyType({}))
    time: float = 0.0

    def get(self, branch: str, digit: int) -> Reading | None:
        return self.readings.get((branch, digit))


@dataclass(frozen=True, slots=True)
class Term:
    """One f_i of a state check: the fact, the value the state wants, what was read, the truth."""

    fact: FactKey
    wanted: str
    reading: str | None
    truth: bool | None
    reason: str = ""


@dataclass(frozen=True, slots=True)
class CheckResult:
    """The result of a state check: every term, and from them true, false or unknown (None)."""

    branch: str
    state: str
    terms: tuple[Term, ...]

    @property
    def truth(self) -> bool | None:
        """False where a term is false, else None where one is unknown, else True."""
        if any(term.truth is False for term in self.terms):
            return False
        return None if any(term.truth is None for term in self.terms) else True

    @property
    def holds(self) -> tuple[Term, ...]:
        return tuple(term for term in self.terms if term.truth is True)

    @property
    def misses(self) -> tuple[Term, ...]:
        return tuple(term for term in self.terms if term.truth is False)

    @property
    def unknown(self) -> tuple[Term, ...]:
        return tuple(term for term in self.terms if term.truth is None)
