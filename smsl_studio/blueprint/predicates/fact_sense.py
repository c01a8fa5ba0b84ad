"""How one fact is sensed: ``sources``, ``range`` and ``predicate`` of its entry in ``_facts``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set
from dataclasses import dataclass, field
from math import inf, isfinite
from typing import Any

from smsl_studio.blueprint.predicates.predicate import (
    ValuePredicate,
    check_units,
    names_of,
    numbers_of,
    positions_of,
    thresholds_of,
)
from smsl_studio.blueprint.predicates.predicate_text import read_predicate
from smsl_studio.blueprint.predicates.terms import AgeTerm
from smsl_studio.blueprint.predicates.units import Unit, read_unit
from smsl_studio.errors import FormulaError

Json = Any
LOG_RATE, HIGHEST = 10.0, 100.0
"""How often (Hz) a log keeps what a source measures: where nothing is written, and at most."""
MOST = 64
"""The largest number of sources, and of predicates, of one fact."""


@dataclass(frozen=True, slots=True)
class SenseFault:
    """Why a key of a fact's entry cannot be used. ``path`` stands below the entry.

    A ``grave`` fault leaves the fact unknown in every run; any other is only useless.
    """

    path: tuple[str, ...]
    sentence: str
    advice: str = ""
    grave: bool = True


@dataclass(frozen=True, slots=True)
class SourceSpec:
    """One source of a fact: its unit, its range in this unit, and whether it measures a position
    of three numbers."""

    name: str
    unit: Unit
    low: float = -inf
    high: float = inf
    position: bool = False
    valued: bool = True
    """Whether a predicate uses its numbers, and not only its age."""


@dataclass(frozen=True, slots=True)
class FactSense:
    """The sources of a fact, and the predicates that make a value of them.

    With a grave fault there is nothing that decides, and the fact is unknown.
    """

    sources: tuple[SourceSpec, ...]
    predicates: tuple[ValuePredicate, ...]
    faults: tuple[SenseFault, ...] = field(default=(), compare=False)
    log_rate: float = LOG_RATE
    """How often (Hz) the log of a run keeps the measures while the value stays."""

    @property
    def fault(self) -> SenseFault | None:
        """The first grave fault, None if there is none."""
        return next((one for one in self.faults if one.grave), None)

    @property
    def units(self) -> Mapping[str, Unit]:
        """The unit of each source, by its name."""
        return {one.name: one.unit for one in self.sources}


def sense_of(raw: Json) -> FactSense | None:
    """Return how a fact is sensed, from its entry in ``_facts`` as it was read.

    None if it has no predicates. A ``predicate`` that is a text is for people, and no predicate.
    """
    if not isinstance(raw, Mapping):
        return None
    written = raw.get("predicate")
    if isinstance(written, str | None):
        return _useless(raw)
    if not isinstance(written, Mapping):
        wrong = SenseFault(("predicate",), "it is no map of values to predicates", _ADVICE)
        return FactSense((), (), (wrong,))
    faults: list[SenseFault] = []
    units = _units(raw.get("sources"), faults)
    ranges = _ranges(raw.get("range"), units, faults)
    named = raw.get("sources")
    unread = named.keys() - units.keys() if isinstance(named, Mapping) else frozenset[str]()
    predicates = tuple(_predicates(written, units, unread, faults))
    places = {name for one in predicates for name in positions_of(one.clause)}
    valued = {name for one in predicates for name in numbers_of(one.clause)}
    for name in sorted(places & valued):
        words = f"{name} is used as a number and as a position"
        faults.append(SenseFault(("predicate",), words, "A source measures one of the two."))
    used = places | valued | {term.name for one in predicates for term in _ages(one)}
    for name in units:
        if name not in used and not faults:
            words = f"no predicate uses the source {name}"
            faults.append(SenseFault(("sources", name), words, "Take it away, or use it.", False))
    specs = tuple(
        SourceSpec(name, unit, *ranges.get(name, _ANY), name in places, name in places | valued)
        for name, unit in units.items()
        if name in used
    )
    return FactSense(specs, predicates, tuple(faults), _log_rate(raw.get("log_rate")))


_ANY = (-inf, inf)
_ADVICE = 'Write {"0": "force < 1 N", "1": "force > 2 N"}.'


def _useless(raw: Mapping[str, Json]) -> FactSense | None:
    """Return None, or only faults if there are sources that no predicate reads."""
    keys = [key for key in ("sources", "range") if raw.get(key)]
    if not keys:
        return None
    words = "no predicate says which value they mean"
    advice = "Write predicate as a map of values: " + _ADVICE.removeprefix("Write ")
    return FactSense((), (), tuple(SenseFault((key,), words, advice) for key in keys))


def _units(raw: Json, faults: list[SenseFault]) -> dict[str, Unit]:
    found: dict[str, Unit] = {}
    if not isinstance(raw, Mapping) or not raw:
        words = "there are no sources that the predicate could read"
        faults.append(SenseFault(("predicate",), words, 'Write "sources": {"force": "N"}.'))
        return found
    if len(raw) > MOST:
        words = f"it has {len(raw):,} sources, more than {MOST}"
        faults.append(SenseFault(("sources",), words, "Let one source make one number of several."))
        return found
    for name, text in raw.items():
        if not name:
            faults.append(SenseFault(("sources", name), "a source has no name", "Give it a name."))
            continue
        if not isinstance(text, str):
            words = f"the unit of {name} is no text"
            faults.append(SenseFault(("sources", name), words, 'Such as "N", or "1" for a count.'))
            continue
        try:
            found[name] = read_unit(text)
        except FormulaError as error:
            words = error.sentence.partition(": ")[2]
            faults.append(
                SenseFault(("sources", name), f"the unit of {name}: {words}", error.advice)
            )
    return found


def _ranges(
    raw: Json, units: Mapping[str, Unit], faults: list[SenseFault]
) -> dict[str, tuple[float, float]]:
    found: dict[str, tuple[float, float]] = {}
    if raw is None:
        return found
    if not isinstance(raw, Mapping):
        faults.append(SenseFault(("range",), "it is no map of sources", _RANGE))
        return found
    for name, pair in raw.items():
        if name not in units:
            words = f"{name!r} is no source of this fact"
            faults.append(SenseFault(("range", name), words, "Name a source, or take it away."))
        elif not _is_range(pair):
            words = f"the range of {name} is no pair of numbers, the lower first"
            faults.append(SenseFault(("range", name), words, _RANGE))
        else:
            found[name] = float(pair[0]), float(pair[1])
    return found


_RANGE = 'Write {"force": [0, 50]}, in the unit of the source.'


def _is_range(pair: Json) -> bool:
    if not isinstance(pair, list | tuple) or len(pair) != 2:
        return False
    numbers = all(isinstance(one, int | float) and type(one) is not bool for one in pair)
    return numbers and all(map(isfinite, pair)) and pair[0] <= pair[1]


def _log_rate(raw: Json) -> float:
    """Return the rate of the log. What does not fit is told with the notes, and does not count."""
    number = isinstance(raw, int | float) and type(raw) is not bool
    return float(raw) if number and 0 < raw <= HIGHEST else LOG_RATE


def _predicates(
    written: Mapping[str, Json],
    units: Mapping[str, Unit],
    unread: Set[str],
    faults: list[SenseFault],
) -> Iterator[ValuePredicate]:
    """Yield the predicates that fit. ``unread`` are sources whose faults are told already."""
    if not written:
        faults.append(SenseFault(("predicate",), "it says no value", _ADVICE))
    if len(written) > MOST:
        words = f"it says {len(written):,} values, more than {MOST}"
        faults.append(SenseFault(("predicate",), words, "Make a fact of fewer values of it."))
        return
    for value, text in written.items():
        path = ("predicate", value)
        if not isinstance(text, str):
            faults.append(SenseFault(path, f"the predicate of {value} is no text", _ADVICE))
            continue
        try:
            clause = read_predicate(text)
            used = {one.name for th in thresholds_of(clause) for one in names_of(th.part)}
            if units and used.isdisjoint(unread):
                check_units(clause, units)
        except FormulaError as error:
            words = f"the predicate of {value} cannot be read: {error.sentence}"
            faults.append(SenseFault(path, words, error.advice))
            continue
        yield ValuePredicate(value, text, clause)


def _ages(one: ValuePredicate) -> Iterator[AgeTerm]:
    for threshold in thresholds_of(one.clause):
        for term in names_of(threshold.part):
            if isinstance(term, AgeTerm):
                yield term
