"""Units of measure: the SI with its prefixes, and the units that a clinic uses beside it.

The table is small, because it must load at once. An angle and a temperature on the Celsius scale
are kinds of their own, so that no turn fits a share and no Celsius fits a Kelvin.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from math import pi

from smsl_studio.errors import FormulaError, did_you_mean

Kind = tuple[tuple[str, int], ...]
"""The powers of base units, sorted by their names. A number without a unit has none."""

LONGEST = 40
"""The largest length of a unit, in characters."""
_HIGHEST = 9

_PREFIXES: Mapping[str, Fraction] = {
    symbol: Fraction(10) ** power
    for symbol, power in (
        ("p", -12), ("n", -9), ("u", -6), ("µ", -6), ("μ", -6), ("m", -3), ("c", -2), ("d", -1),
        ("da", 1), ("h", 2), ("k", 3), ("M", 6), ("G", 9), ("T", 12),
    )
}  # fmt: skip

_PLAIN = "m g s A K mol cd rad Hz N Pa J W V C F ohm Ω S T Wb H L l bar"
"""The units that may have a prefix."""

_AS: Mapping[str, tuple[Fraction, str]] = {
    "g": (Fraction(1, 1000), "kg"),
    "Hz": (Fraction(1), "s-1"),
    "N": (Fraction(1), "kg m s-2"),
    "Pa": (Fraction(1), "kg m-1 s-2"),
    "J": (Fraction(1), "kg m2 s-2"),
    "W": (Fraction(1), "kg m2 s-3"),
    "V": (Fraction(1), "kg m2 s-3 A-1"),
    "C": (Fraction(1), "s A"),
    "F": (Fraction(1), "kg-1 m-2 s4 A2"),
    "ohm": (Fraction(1), "kg m2 s-3 A-2"),
    "Ω": (Fraction(1), "kg m2 s-3 A-2"),
    "S": (Fraction(1), "kg-1 m-2 s3 A2"),
    "T": (Fraction(1), "kg s-2 A-1"),
    "Wb": (Fraction(1), "kg m2 s-2 A-1"),
    "H": (Fraction(1), "kg m2 s-2 A-2"),
    "L": (Fraction(1, 1000), "m3"),
    "l": (Fraction(1, 1000), "m3"),
    "bar": (Fraction(100_000), "kg m-1 s-2"),
    "min": (Fraction(60), "s"),
    "h": (Fraction(3600), "s"),
    "d": (Fraction(86_400), "s"),
    "deg": (Fraction(pi) / 180, "rad"),
    "°": (Fraction(pi) / 180, "rad"),
    "degC": (Fraction(1), "degC"),
    "°C": (Fraction(1), "degC"),
    "mmHg": (Fraction(133_322_387_415, 1_000_000_000), "kg m-1 s-2"),
    "rpm": (Fraction(1, 60), "s-1"),
    "bpm": (Fraction(1, 60), "s-1"),
    "%": (Fraction(1, 100), ""),
    "1": (Fraction(1), ""),
}

_FACTOR = re.compile(r"(?P<symbol>[A-Za-zµμΩ°%]+|1)(?:\^?(?P<power>-?[1-9])|(?P<high>[²³]))?")


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit as it is written, its ``factor`` to base units of the SI, and its kind.

    Two units fit each other if their kinds are equal.
    """

    text: str
    factor: Fraction = field(repr=False)
    kind: Kind = field(repr=False)

    def fits(self, other: Unit) -> bool:
        """Whether a value in this unit can be compared with a value in another."""
        return self.kind == other.kind

    def to(self, other: Unit) -> Fraction:
        """Return the number by which a value in this unit becomes one in another that fits."""
        return self.factor / other.factor


def symbols() -> Iterator[str]:
    """Yield the units that are offered when somebody writes one, the usual ones first."""
    yield from ("mm", "m", "N", "s", "deg", "degC", "1", "%", "mmHg", "mV", "mA", "kPa", "ml")
    yield from ("cm", "um", "ms", "min", "rad", "mm/s", "m/s", "N*m", "g", "kg", "Hz", "bpm", "rpm")


@lru_cache(maxsize=1024)
def read_unit(text: str) -> Unit:
    """Return the unit that a text says, such as ``mm``, ``N*m`` or ``m/s^2``.

    FormulaError if it is none.
    """
    if len(text) > LONGEST:
        raise FormulaError(f"a unit of {len(text):,} characters is too long", 0, _ADVICE)
    factor, powers, sign, at = Fraction(1), dict[str, int](), 1, 0
    while True:
        match = _FACTOR.match(text, at)
        known = _known(match["symbol"]) if match is not None else None
        if match is None or known is None:
            near = did_you_mean(text, _ALL) or _ADVICE
            raise FormulaError(f"{text!r} is no unit", 0, near)
        high = {"²": 2, "³": 3}.get(match["high"] or "", 1)
        power = sign * int(match["power"] or high)
        factor *= known[0] ** power
        for base, times in known[1]:
            powers[base] = powers.get(base, 0) + times * power
        at = match.end()
        if at == len(text):
            break
        if text[at] not in "*·/":
            raise FormulaError(f"{text!r} is no unit", 0, _ADVICE)
        sign, at = (-1 if text[at] == "/" else 1), at + 1
    if any(abs(power) > _HIGHEST for power in powers.values()):
        raise FormulaError(f"{text!r} is no unit that anybody measures", 0, _ADVICE)
    return Unit(text, factor, tuple(sorted((base, n) for base, n in powers.items() if n)))


def _known(symbol: str) -> tuple[Fraction, Kind] | None:
    """Return the factor and the kind of one symbol, with or without a prefix."""
    own = _base(symbol)
    if own is not None:
        return own
    for length in (1, 2):
        prefix, rest = _PREFIXES.get(symbol[:length]), symbol[length:]
        if prefix is not None and rest in _PREFIXABLE:
            found = _base(rest)
            assert found is not None
            return prefix * found[0], found[1]
    return None


def _base(symbol: str) -> tuple[Fraction, Kind] | None:
    factor, bases = _AS.get(symbol, (Fraction(1), symbol))
    if symbol not in _AS and symbol not in _PREFIXABLE:
        return None
    powers = (re.fullmatch(r"([a-zA-Z]+)(-?\d*)", base) for base in bases.split())
    return factor, tuple((one[1], int(one[2] or 1)) for one in powers if one is not None)


_PREFIXABLE = frozenset(_PLAIN.split())
_ADVICE = "Units are those of the SI, such as mm, N, deg, degC, m/s or %. 1 is a plain number."
_ALL = tuple(dict.fromkeys((*symbols(), *_PREFIXABLE, *_AS)))
NUMBER, SECOND = read_unit("1"), read_unit("s")
"""The units of counted things, and of ages."""
