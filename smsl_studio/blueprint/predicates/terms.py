"""The parts of a predicate, as they are read from its text."""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.blueprint.predicates.units import Unit


@dataclass(frozen=True, slots=True)
class SourceTerm:
    """The newest number of a source. ``at`` is its offset in the text."""

    name: str
    at: int = 0


@dataclass(frozen=True, slots=True)
class AgeTerm:
    """The time (s) since the last good sample of a source."""

    name: str
    at: int = 0


@dataclass(frozen=True, slots=True)
class DistanceTerm:
    """The distance between the positions that two sources measure."""

    first: SourceTerm
    second: SourceTerm


@dataclass(frozen=True, slots=True)
class AbsTerm:
    """The absolute value of an expression."""

    part: Expression


@dataclass(frozen=True, slots=True)
class ExtremeTerm:
    """The smallest or, if ``largest``, the largest of several expressions."""

    parts: tuple[Expression, ...]
    largest: bool


@dataclass(frozen=True, slots=True)
class SumTerm:
    """An expression plus or, if ``minus``, minus another one."""

    left: Expression
    right: Expression
    minus: bool


Expression = SourceTerm | AgeTerm | DistanceTerm | AbsTerm | ExtremeTerm | SumTerm


@dataclass(frozen=True, slots=True)
class Threshold:
    """An expression compared with a number in a unit. ``sign`` is one of < <= > >=.

    ``number`` is as written. ``at`` is the offset of the number in the text.
    """

    part: Expression
    sign: str
    number: str
    unit: Unit
    at: int = 0


@dataclass(frozen=True, slots=True)
class Dwell:
    """A condition that must hold for a time (s) without a break."""

    part: Clause
    seconds: float


@dataclass(frozen=True, slots=True)
class Opposite:
    """A condition that must not hold."""

    part: Clause


@dataclass(frozen=True, slots=True)
class Every:
    """Conditions that must all hold."""

    parts: tuple[Clause, ...]


@dataclass(frozen=True, slots=True)
class Some:
    """Conditions of which one must hold."""

    parts: tuple[Clause, ...]


Clause = Threshold | Dwell | Opposite | Every | Some
