"""The parts of a formula as they are written. Names are not looked up yet."""

from __future__ import annotations

from dataclasses import dataclass, field

Span = tuple[int, int]
"""The offsets of the begin and the end of a part of the text."""


@dataclass(frozen=True, slots=True)
class FactTerm:
    """``FACT = VALUE`` or ``FACT != VALUE``.

    A fact is named by its digit, by its plain name, or by the SB alone if that has one fact. The
    SB is empty if it is left out. ``spans`` are those of SB, fact and value; what is left out has
    an empty one.
    """

    branch: str
    digit: int | None
    name: str
    value: str
    equal: bool
    spans: tuple[Span, Span, Span] = field(default=((0, 0),) * 3, compare=False, repr=False)

    @property
    def at(self) -> int:
        """The offset of the term in the text."""
        return min((start for start, end in self.spans if end), default=0)


@dataclass(frozen=True, slots=True)
class StateTerm:
    """``SB in STATE``. ``spans`` are those of SB and state."""

    branch: str
    state: str
    spans: tuple[Span, Span] = field(default=((0, 0),) * 2, compare=False, repr=False)

    @property
    def at(self) -> int:
        """The offset of the term in the text."""
        return self.spans[0][0]


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


Term = FactTerm | StateTerm
Formula = FactTerm | StateTerm | Negation | AllOf | AnyOf
