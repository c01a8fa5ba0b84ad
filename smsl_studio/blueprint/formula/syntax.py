"""The parts of a formula as they are written. Names are not looked up yet."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class FactTerm:
    """``FACT = VALUE`` or ``FACT != VALUE``.

    A fact is named by its digit, by its plain name, or by the SB alone if that has one fact. The
    SB is empty if it is left out. ``at`` is the offset of the term in the text.
    """

    branch: str
    digit: int | None
    name: str
    value: str
    equal: bool
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class StateTerm:
    """``SB in STATE``."""

    branch: str
    state: str
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class Negation:
    """``not F``."""

    part: Formula


@dataclass(frozen=True, slots=True)
class AllOf:
    """``F and G``, of two or more parts."""

    parts: tuple[Formula, ...]


@dataclass(frozen=True, slots=True)
class AnyOf:
    """``F or G``, of two or more parts."""

    parts: tuple[Formula, ...]


Formula = FactTerm | StateTerm | Negation | AllOf | AnyOf
