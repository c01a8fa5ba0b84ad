"""The predicates by which a plugin decides a fact, where the blueprint writes none (paper, Eq. 5).

They read the measuring sensors of the same plugin, all at one instant. So they have no ``for`` and
no ``age``, and no value stays between two bounds.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from smsl_studio.blueprint.predicates import FactSense, sense_of
from smsl_studio.blueprint.predicates.predicate import names_of, thresholds_of
from smsl_studio.blueprint.predicates.predicate_text import read_predicate
from smsl_studio.blueprint.predicates.terms import (
    AgeTerm,
    Clause,
    Dwell,
    Every,
    Opposite,
    Some,
)
from smsl_studio.errors import FormulaError, PluginError
from smsl_studio.library.pattern import read_pattern
from smsl_studio.library.sensor_entry import NO_WORDS, SensorEntry
from smsl_studio.library.signature import Signature
from smsl_studio.library.terms import conditions_of, proper_name, seconds, words_of_values


@dataclass(frozen=True, slots=True)
class Measure:
    """A function that measures, called as ``function(world, **arguments)``."""

    function: Callable[..., Any]
    arguments: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class FactDefault:
    """The default predicates of one fact. ``measures`` are in the order of the sources of
    ``sense``. ``otherwise`` is the value if every predicate is false, empty for no valid reading.
    """

    sense: FactSense
    measures: tuple[Measure, ...]
    otherwise: str = ""


def default_of(
    predicate: Mapping[str, str],
    otherwise: str,
    texts: Mapping[str, str],
    entries: Sequence[SensorEntry],
) -> FactDefault:
    """Return the default predicates of the fact for which these texts stand in place of fields.

    ``entries`` are the sensors of the plugin. PluginError if a predicate cannot be read, or names
    something that no sensor measures.
    """
    filled = {value: _filled(text, texts) for value, text in predicate.items()}
    units: dict[str, str] = {}
    measures: dict[str, Measure] = {}
    for value, text in filled.items():
        try:
            clause = read_predicate(text)
        except FormulaError as error:
            raise PluginError(
                f"the predicate of {value}: {error.sentence}", advice=error.advice
            ) from None
        if any(isinstance(one, Dwell) for one in _parts(clause)):
            raise PluginError(f"the predicate of {value} has a for", advice=_INSTANT)
        for threshold in thresholds_of(clause):
            for term in names_of(threshold.part):
                if isinstance(term, AgeTerm):
                    raise PluginError(f"the predicate of {value} has an age", advice=_INSTANT)
                if term.name not in units:
                    units[term.name], measures[term.name] = _measure(term.name, entries)
    sense = sense_of({"sources": units, "predicate": filled})
    assert sense is not None
    if sense.fault is not None:
        raise PluginError(sense.fault.sentence, advice=sense.fault.advice)
    return FactDefault(sense, tuple(measures[one.name] for one in sense.sources), otherwise)


_INSTANT = "A plugin decides at one instant. Write it in a blueprint."


def default_entry(
    sensors: Sequence[SensorEntry],
    names: tuple[str, str],
    decision: tuple[Mapping[str, str], str],
    terms: Mapping[str, Any],
) -> SensorEntry:
    """Return the entry of a sensor whose value predicates decide. ``names`` are its name and its
    fact, ``decision`` the predicates and the value otherwise, ``terms`` its other terms.

    PluginError if a name or a term does not fit, or if a predicate cannot be read.
    """
    name, fact = proper_name(names[0], "a sensor"), proper_name(names[1], "a fact")
    predicate, otherwise = conditions_of(decision[0]), decision[1]
    odd = next((term for term in terms if term not in ("period", "max_age", "words")), None)
    if odd is not None:
        raise PluginError(f"the predicates of a fact have no {odd!r}")
    if otherwise:
        proper_name(otherwise, "a value")
    measuring = [one for one in sensors if one.unit]
    types = {key: kind for one in measuring for key, kind in one.signature.types.items()}
    pattern, where = read_pattern(name, types), read_pattern(fact, types)
    if set(where.parameters) != set(pattern.parameters):
        raise PluginError(f"{name!r} and {fact!r} do not name the same parameters")
    own = {key: types.get(key, str) for key in pattern.parameters}
    default_of(predicate, otherwise, {k: "1" if v is int else "a" for k, v in own.items()}, sensors)
    return SensorEntry(
        _undecided,
        pattern,
        where,
        Signature(own, frozenset(own), False),
        seconds(terms.get("period", 0.02), "period"),
        seconds(terms.get("max_age", 0.3), "max_age"),
        words_of_values(terms.get("words", NO_WORDS)),
        "",
        predicate,
        otherwise,
    )


def _undecided(subject: Any, **arguments: Any) -> None:
    """Stand in place of a function. Nobody calls it, because predicates decide."""


def _filled(text: str, texts: Mapping[str, str]) -> str:
    for name, value in texts.items():
        text = text.replace(f"{{{name}}}", value)
    return text


def _parts(clause: Clause) -> Iterator[Clause]:
    yield clause
    match clause:
        case Dwell(part) | Opposite(part):
            yield from _parts(part)
        case Every(parts) | Some(parts):
            for part in parts:
                yield from _parts(part)


def _measure(name: str, entries: Sequence[SensorEntry]) -> tuple[str, Measure]:
    """Return the unit and the function of what a predicate names."""
    for entry in entries:
        texts = entry.pattern.match(name) if entry.unit else None
        if texts is not None:
            return entry.unit, Measure(entry.function, entry.signature.converted(texts))
    raise PluginError(f"no sensor measures {name!r}", advice="Register it first, with a unit.")
